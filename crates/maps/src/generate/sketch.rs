//! Drawing the rows and ramps of a motorway. Lines count from the outer edge of the slow lane towards the
//! fast side.

use laneweave_network::{DrivingSide, Point};

use super::Motorway;
use super::plan::Plan;
use super::ramp::{self, Direction, Ramp};
use crate::drawing::{Border, Crossing, Drawing, Edge, Lane};

/// A motorway that is being drawn.
pub(super) struct Sketch<'a> {
    motorway: &'a Motorway,
    plan: &'a Plan,
    columns: Vec<Column>,
    pub(super) drawing: Drawing,
}

/// The points of one station: one on each line from `outer` to the fast edge.
struct Column {
    outer: i32,
    first: u32,
}

impl Column {
    fn point(&self, line: i32) -> u32 {
        self.first + (line - self.outer) as u32
    }
}

impl<'a> Sketch<'a> {
    /// The points of all stations.
    pub(super) fn new(motorway: &'a Motorway, plan: &'a Plan) -> Sketch<'a> {
        let drawing = Drawing {
            points: Vec::new(),
            borders: Vec::new(),
            lanes: Vec::new(),
            rules: Vec::new(),
            driving_side: motorway.driving_side,
        };
        let mut sketch = Sketch { motorway, plan, columns: Vec::new(), drawing };
        for (station, x) in plan.stations.iter().enumerate() {
            let rows = station.saturating_sub(1)..(station + 1).min(plan.rows());
            let outer = rows.map(|row| plan.outer_line(row)).min().unwrap_or(0);
            let first = sketch.drawing.points.len() as u32;
            for line in outer..=sketch.fast_line() {
                sketch.point(*x, f64::from(line) * motorway.lane_width_m);
            }
            sketch.columns.push(Column { outer, first });
        }
        sketch
    }

    /// Draws the lanelets between two stations.
    pub(super) fn row(&mut self, row: usize) {
        let (outer, fast) = (self.plan.outer_line(row), self.fast_line());
        let first = self.drawing.borders.len() as u32;
        for line in outer..=fast {
            let points = vec![self.columns[row].point(line), self.columns[row + 1].point(line)];
            let is_edge = line == outer || line == fast;
            self.border(points, if is_edge { Crossing::NEVER } else { Crossing::BOTH_WAYS });
        }
        for slow_side in first..first + (fast - outer) as u32 {
            self.lane(slow_side, slow_side + 1, self.motorway.speed_limit_kmh);
        }
    }

    /// Draws the lanelets of a ramp; its acceleration or deceleration lane is part of the rows.
    pub(super) fn ramp(&mut self, ramp: &Ramp) {
        /// Segments of a ramp's borders.
        const SEGMENTS: f64 = 10.0;
        let pieces = (ramp::LENGTH / self.motorway.lanelet_length_m).round().max(1.0);
        let segments = (SEGMENTS / pieces).ceil() as usize;
        let pieces = pieces as usize;
        let station = self.plan.station(ramp.at);
        let edge = self.plan.slow_line(station);
        let outer = self.ramp_line(ramp, station, edge - 1, pieces * segments);
        let inner = self.ramp_line(ramp, station, edge, pieces * segments);
        let limit = self.motorway.speed_limit_kmh.min(ramp::SPEED_LIMIT);
        for piece in 0..pieces {
            let points = piece * segments..=(piece + 1) * segments;
            let slow_side = self.border(outer[points.clone()].to_vec(), Crossing::NEVER);
            let fast_side = self.border(inner[points].to_vec(), Crossing::NEVER);
            self.lane(slow_side, fast_side, limit);
        }
    }

    /// Points of a ramp's border in the direction of travel, which shares a point with `line` at `station`.
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

    /// Adds a point `y` to the fast side of the road's outer edge, to the millimetre.
    fn point(&mut self, x: f64, y: f64) -> u32 {
        let rounded = |metres: f64| (metres * 1000.0).round() / 1000.0;
        let y = match self.motorway.driving_side {
            DrivingSide::Right => rounded(y),
            DrivingSide::Left => -rounded(y),
        };
        self.drawing.points.push(Point::new(rounded(x), y, 0.0));
        self.drawing.points.len() as u32 - 1
    }

    fn border(&mut self, points: Vec<u32>, crossing: Crossing) -> u32 {
        self.drawing.borders.push(Border { points, crossing });
        self.drawing.borders.len() as u32 - 1
    }

    fn lane(&mut self, slow_side: u32, fast_side: u32, limit_kmh: f64) {
        let [slow_side, fast_side] = [slow_side, fast_side].map(|border| Edge { border, reversed: false });
        let (left, right) = match self.motorway.driving_side {
            DrivingSide::Right => (fast_side, slow_side),
            DrivingSide::Left => (slow_side, fast_side),
        };
        let id = self.drawing.lanes.len() as i64 + 1;
        self.drawing.lanes.push(Lane { id, line: None, left, right, is_two_way: false, limit_kmh });
    }
}
