//! Which cells around a vehicle are occupied.

use laneweave::network::{Point, Pose, Rectangle};
use laneweave::sim::Vehicle;
use laneweave::{Fault, Simulation};
use serde::{Deserialize, Serialize};

use super::Part;
use super::vehicles::Frame;
use crate::task::wrong;

/// A grid of cells in the frame of the lane. Its first channel is 1 where a vehicle covers the centre of a cell; its
/// second channel is there how much faster than the ego the vehicle is, by 40 m/s; its third one is 1 where the centre
/// of the cell is on a lane.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Grid {
    /// From so far ahead to so far behind [m].
    pub ahead_m: f64,
    /// So far behind [m].
    pub behind_m: f64,
    /// So far to the left and to the right [m].
    pub beside_m: f64,
    /// Length and width of a cell [m].
    pub cell_m: [f64; 2],
}

impl Default for Grid {
    fn default() -> Grid {
        Grid { ahead_m: 100.0, behind_m: 50.0, beside_m: 9.0, cell_m: [2.5, 1.0] }
    }
}

impl Grid {
    /// Number of channels.
    const CHANNELS: usize = 3;

    /// Numbers of cells along the lane and across.
    fn cells(&self) -> [usize; 2] {
        let [length, width] = self.cell_m;
        [(self.ahead_m + self.behind_m) / length, 2.0 * self.beside_m / width].map(|it| it.round() as usize)
    }

    pub(super) fn part(&self) -> Part {
        let [along, across] = self.cells();
        Part::new("grid", &[Grid::CHANNELS, along, across], &[])
    }

    /// # Errors
    /// If a number is not in its range.
    pub(super) fn check(&self) -> Result<(), Fault> {
        /// Furthest place that is seen [m].
        const FARTHEST: f64 = 300.0;
        let far = [self.ahead_m, self.behind_m, self.beside_m];
        if far.iter().any(|it| !(0.0..=FARTHEST).contains(it)) {
            return Err(wrong("observation.grid", "an extent out of range", "choose 0 to 300 m"));
        }
        if self.cell_m.iter().any(|it| !(0.25..=20.0).contains(it)) || self.cells().contains(&0) {
            let remedy = "choose 0.25 to 20 m, and no more than the grid has";
            return Err(wrong("observation.grid.cell_m", "cells out of range", remedy));
        }
        Ok(())
    }

    /// The centre of a cell: so far ahead and to the left [m]. The first cell is the hindmost, and the rightmost.
    fn centre(&self, [along, across]: [usize; 2]) -> [f64; 2] {
        let [length, width] = self.cell_m;
        [(along as f64 + 0.5) * length - self.behind_m, (across as f64 + 0.5) * width - self.beside_m]
    }

    /// The cells along an axis whose centres are within `from` to `to` [m].
    fn within(from: f64, to: f64, begin: f64, cell: f64, count: usize) -> std::ops::Range<usize> {
        let place = |it: f64| ((it - begin) / cell - 0.5).ceil().clamp(0.0, count as f64) as usize;
        place(from)..place(to)
    }

    pub(super) fn write(&self, simulation: &Simulation, ego: &Vehicle, frame: &Frame, numbers: &mut [f32]) {
        let [along, across] = self.cells();
        let (vehicles, rest) = numbers.split_at_mut(along * across);
        let (faster, lanes) = rest.split_at_mut(along * across);
        for other in simulation.views().filter(|it| it.id() != ego.id()) {
            let (pose, [length, width]) = (other.pose(), other.size());
            let [x, y] = frame.local(pose.at.x, pose.at.y);
            let pose = Pose { at: Point::new(x, y, 0.0), heading: frame.turn(pose.heading) };
            self.cover(&Rectangle { pose, length, width }, |cell| {
                vehicles[cell] = 1.0;
                faster[cell] = frame.faster(other.speed());
            });
        }
        self.cover_lanes(simulation, frame, |cell| lanes[cell] = 1.0);
    }

    /// Calls `mark` with the number of each cell whose centre is on the lanelets.
    fn cover_lanes(&self, simulation: &Simulation, frame: &Frame, mut mark: impl FnMut(usize)) {
        let reach = self.ahead_m.max(self.behind_m).hypot(self.beside_m);
        for lanelet in &simulation.network().lanelets {
            let mut station = 0.0;
            for piece in lanelet.centre.points().windows(2) {
                let [from, to] = [&piece[0], &piece[1]].map(|it| frame.local(it.x, it.y));
                let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
                let (length, heading) = (dx.hypot(dy), dy.atan2(dx));
                let width = lanelet.width(station + 0.5 * length);
                station += length;
                let [x, y] = [0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1])];
                if x.hypot(y) > reach + length {
                    continue;
                }
                let pose = Pose { at: Point::new(x, y, 0.0), heading };
                self.cover(&Rectangle { pose, length, width }, &mut mark);
            }
        }
    }

    /// Calls `mark` with the number of each cell whose centre is in the rectangle.
    fn cover(&self, body: &Rectangle, mut mark: impl FnMut(usize)) {
        let [along, across] = self.cells();
        let corners = body.corners();
        let [low, high] = [f64::min, f64::max].map(|better| {
            [corners.iter().map(|it| it.x).reduce(better), corners.iter().map(|it| it.y).reduce(better)]
                .map(|it| it.unwrap_or(f64::NAN))
        });
        let (sine, cosine) = body.pose.heading.sin_cos();
        for row in Grid::within(low[0], high[0], -self.behind_m, self.cell_m[0], along) {
            for column in Grid::within(low[1], high[1], -self.beside_m, self.cell_m[1], across) {
                let [x, y] = self.centre([row, column]);
                let [dx, dy] = [x - body.pose.at.x, y - body.pose.at.y];
                let [ahead, left] = [dx * cosine + dy * sine, dy * cosine - dx * sine];
                if ahead.abs() <= 0.5 * body.length && left.abs() <= 0.5 * body.width {
                    mark(row * across + column);
                }
            }
        }
    }
}
