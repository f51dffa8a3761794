//! The four directions in which streets lead.

use std::f64::consts::FRAC_PI_2;

/// A direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Compass {
    East,
    North,
    West,
    South,
}

/// A movement at a junction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Turn {
    Left,
    Straight,
    Right,
    Back,
}

impl Compass {
    /// All of them, counter-clockwise.
    pub(super) const ALL: [Compass; 4] = [Compass::East, Compass::North, Compass::West, Compass::South];

    /// Counter-clockwise from east [rad].
    pub(super) fn heading(self) -> f64 {
        f64::from(self as u8) * FRAC_PI_2
    }

    /// East and north of a step of one metre [m].
    pub(super) fn step(self) -> (f64, f64) {
        match self {
            Compass::East => (1.0, 0.0),
            Compass::North => (0.0, 1.0),
            Compass::West => (-1.0, 0.0),
            Compass::South => (0.0, -1.0),
        }
    }

    /// The opposite direction.
    pub(super) fn opposite(self) -> Compass {
        Compass::ALL[(self as usize + 2) % 4]
    }

    /// Whether it runs east and west.
    pub(super) fn is_along_east(self) -> bool {
        matches!(self, Compass::East | Compass::West)
    }

    /// The movement of a vehicle that came in this direction and leaves in `other`.
    pub(super) fn turn(self, other: Compass) -> Turn {
        [Turn::Straight, Turn::Left, Turn::Back, Turn::Right][(other as usize + 4 - self as usize) % 4]
    }
}
