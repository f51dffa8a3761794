//! Drawing the rows and ramps of a motorway. Lines count from the outer edge of the slow lane towards the
//! fast side.

use laneweave_maps::drawing::{Crossing, Drawing, Edge, Surroundings};
use laneweave_network::Point;

use super::Motorway;
use super::plan::Plan;
use super::ramp::{self, Direction, Ramp};
use crate::canvas::Canvas;

/// A motorway under construction.
pub(super) struct Sketch<'a> {
    motorway: &'a Motorway,
    plan: &'a Plan,
    columns: Vec<Column>,
    canvas: Canvas,
}

/// The points of one station: one on each line from `outer` to the fast edge.
struct Column {
    outer: i32,
    points: Vec<u32>,
}

impl Column {
    fn point(&self, line: i32) -> u32 {
        self.points[(line - self.outer) as usize]
    }
}

impl<'a> Sketch<'a> {
    /// The points of all stations.
    pub(super) fn new(motorway: &'a Motorway, plan: &'a Plan) -> Sketch<'a> {
        let mut sketch = Sketch { motorway, plan, columns: Vec::new(), canvas: Canvas::new() };
        for (station, x) in plan.stations.iter().enumerate() {
            let rows = station.saturating_sub(1)..(station + 1).min(plan.rows());
            let outer = rows.map(|row| plan.outer_line(row)).min().unwrap_or(0);
            let lines = outer..=sketch.fast_line();
            let points =
                lines.map(|line| sketch.point(*x, f64::from(line) * motorway.lane_width_m)).collect();
            sketch.columns.push(Column { outer, points });
        }
        sketch
    }

    /// Draws the lanelets between two stations.
    pub(super) fn row(&mut self, row: usize) {
        let (outer, fast) = (self.plan.outer_line(row), self.fast_line());
        let mut border = |line| {
            let points = vec![self.columns[row].point(line), self.columns[row + 1].point(line)];
            let is_edge = line == outer || line == fast;
            self.canvas.line(points, if is_edge { Crossing::NEVER } else { Crossing::BOTH_WAYS })
        };
        let borders: Vec<u32> = (outer..=fast).map(&mut border).collect();
        for sides in borders.windows(2) {
            self.lane(sides[0], sides[1], self.motorway.speed_limit_kmh);
        }
    }

    /// Draws the lanelets of a ramp; its acceleration or deceleration lane is part of the rows.
    pub(super) fn ramp(&mut self, ramp: &Ramp) {
        /// Segments of a ramp's borders.
        const SEGMENTS: f64 = 10.0;
        let pieces = (ramp::LENGTH / self.motorway.lanelet_length_m).round().max(1.0);
        let segments = (SEGMENTS / pieces).ceil() as usize;
        let pieces = pieces as usize;
        let station = self.plan.station(ramp.at());
        let edge = self.plan.slow_line(station);
        let outer = self.ramp_line(ramp, station, edge - 1, pieces * segments);
        let inner = self.ramp_line(ramp, station, edge, pieces * segments);
        let limit = self.motorway.speed_limit_kmh.min(ramp::SPEED_LIMIT);
        for piece in 0..pieces {
            let points = piece * segments..=(piece + 1) * segments;
            let slow_side = self.canvas.line(outer[points.clone()].to_vec(), Crossing::NEVER);
            let fast_side = self.canvas.line(inner[points].to_vec(), Crossing::NEVER);
            self.lane(slow_side, fast_side, limit);
        }
    }

    /// Points of a ramp's border in the direction of travel; it shares a point with `line` at `station`.
    fn ramp_line(&mut self, ramp: &Ramp, station: usize, line: i32, segments: usize) -> Vec<u32> {
        let shared = match ramp.direction {
            Direction::On => segments,
            Direction::Off => 0,
        };
        let edge = f64::from(line) * self.motorway.lane_width_m;
        (0..=segments)
            .map(|i| {
                if i == shared {
                    return self.columns[station].point(line);
                }
                let (x, beside) = ramp.point(i as f64 / segments as f64);
                self.point(x, edge - beside)
            })
            .collect()
    }

    /// The line at the edge of the fast lane.
    fn fast_line(&self) -> i32 {
        self.motorway.lanes as i32
    }

    /// Adds a point `y` to the fast side of the road's outer edge.
    fn point(&mut self, x: f64, y: f64) -> u32 {
        self.canvas.point(Point::new(x, y, 0.0))
    }

    fn lane(&mut self, slow_side: u32, fast_side: u32, limit_kmh: f64) {
        let [left, right] = [fast_side, slow_side].map(|border| Edge { border, reversed: false });
        self.canvas.lane([left, right], Surroundings::Motorway, limit_kmh);
    }

    /// The finished drawing.
    pub(super) fn finish(self) -> Drawing {
        self.canvas.finish(self.motorway.driving_side)
    }
}
