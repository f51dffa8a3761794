//! On- and off-ramps beside a motorway.

use std::fmt;

/// Length of an acceleration or deceleration lane [m].
const LANE: f64 = 250.0;
/// Length of a ramp along the road [m].
pub(super) const LENGTH: f64 = 200.0;
/// Distance from the road's edge to the end of a ramp [m].
const OFFSET: f64 = 15.0;
/// Speed limit on ramps [km/h].
pub(super) const SPEED_LIMIT: f64 = 80.0;

/// A ramp, and the lane beside the road that continues it or that it continues.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ramp {
    pub(super) direction: Direction,
    /// Where its acceleration or deceleration lane begins and ends [m].
    pub(super) lane: [f64; 2],
}

/// Whether a ramp leads onto the road or off it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Direction {
    On,
    Off,
}

impl Ramp {
    /// A ramp that meets the road, or leaves it, at a station [m], with a lane of the usual length.
    pub(super) fn usual(direction: Direction, at: f64) -> Ramp {
        let lane = match direction {
            Direction::On => [at, at + LANE],
            Direction::Off => [at - LANE, at],
        };
        Ramp { direction, lane }
    }

    /// Where it meets the road, or leaves it [m].
    pub(super) fn at(&self) -> f64 {
        match self.direction {
            Direction::On => self.lane[0],
            Direction::Off => self.lane[1],
        }
    }

    /// Where the ramp with its lane begins and ends [m].
    pub(super) fn extent(&self) -> [f64; 2] {
        let [from, to] = self.lane;
        match self.direction {
            Direction::On => [from - LENGTH, to],
            Direction::Off => [from, to + LENGTH],
        }
    }

    /// Station of its point at `fraction` of its length, in the direction of travel, and the distance of the point
    /// from the road's edge [m]: a parabola, parallel to the road where it meets it.
    pub(super) fn point(&self, fraction: f64) -> (f64, f64) {
        let away = match self.direction {
            Direction::On => 1.0 - fraction,
            Direction::Off => fraction,
        };
        let start = match self.direction {
            Direction::On => self.at() - LENGTH,
            Direction::Off => self.at(),
        };
        (start + LENGTH * fraction, OFFSET * away * away)
    }
}

impl fmt::Display for Ramp {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = match self.direction {
            Direction::On => "on-ramp",
            Direction::Off => "off-ramp",
        };
        write!(f, "{name} at {} m", self.at())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ramp_meets_the_road_at_its_edge_and_parallel_to_it() {
        let [on, off] = [Direction::On, Direction::Off].map(|it| Ramp::usual(it, 1000.0));
        assert_eq!((on.point(0.0), on.point(1.0)), ((800.0, 15.0), (1000.0, 0.0)));
        assert_eq!((off.point(0.0), off.point(1.0)), ((1000.0, 0.0), (1200.0, 15.0)));
        let (station, beside) = on.point(0.999);
        assert!(beside / (1000.0 - station) < 1e-3);
    }
}
