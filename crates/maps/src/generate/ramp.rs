//! On- and off-ramps beside a motorway.

use std::fmt;

/// Length of an acceleration or deceleration lane [m].
const LANE: f64 = 250.0;
/// Length of a ramp along the road [m].
pub(super) const LENGTH: f64 = 200.0;
/// How far the end of a ramp lies beside the road's edge [m].
const OFFSET: f64 = 15.0;
/// Speed limit on ramps [km/h].
pub(super) const SPEED_LIMIT: f64 = 80.0;

/// A ramp that meets the road at `at` [m].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ramp {
    pub(super) direction: Direction,
    pub(super) at: f64,
}

/// Whether a ramp leads onto the road or off it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Direction {
    On,
    Off,
}

impl Ramp {
    /// Where its acceleration or deceleration lane begins and ends [m].
    pub(super) fn lane(&self) -> (f64, f64) {
        match self.direction {
            Direction::On => (self.at, self.at + LANE),
            Direction::Off => (self.at - LANE, self.at),
        }
    }

    /// Where all of it begins and ends [m].
    pub(super) fn extent(&self) -> (f64, f64) {
        match self.direction {
            Direction::On => (self.at - LENGTH, self.at + LANE),
            Direction::Off => (self.at - LANE, self.at + LENGTH),
        }
    }

    /// Station of its point at `fraction` of the way, in the direction of travel, and how far that lies
    /// beside the road's edge [m]: a parabola, parallel to the road where it meets it.
    pub(super) fn point(&self, fraction: f64) -> (f64, f64) {
        let away = match self.direction {
            Direction::On => 1.0 - fraction,
            Direction::Off => fraction,
        };
        let (start, _) = match self.direction {
            Direction::On => self.extent(),
            Direction::Off => (self.at, self.at + LENGTH),
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
        write!(f, "{name} at {} m", self.at)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ramp_meets_the_road_at_its_edge_and_parallel_to_it() {
        let on = Ramp { direction: Direction::On, at: 1000.0 };
        let off = Ramp { direction: Direction::Off, at: 1000.0 };
        assert_eq!((on.point(0.0), on.point(1.0)), ((800.0, 15.0), (1000.0, 0.0)));
        assert_eq!((off.point(0.0), off.point(1.0)), ((1000.0, 0.0), (1200.0, 15.0)));
        let (station, beside) = on.point(0.999);
        assert!(beside / (1000.0 - station) < 1e-3);
    }
}
