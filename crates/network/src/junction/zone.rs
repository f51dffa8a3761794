//! Conflict zones: where two chains cross, merge, or run beside each other on a conflict area, or come so close in a
//! bend that a long vehicle needs both.

use serde::{Deserialize, Serialize};

use crate::chain::ChainIndex;

/// A zone's place in [`super::Junctions::zones`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct ZoneIndex(pub u32);

impl ZoneIndex {
    /// The place as an index.
    #[inline]
    pub fn at(self) -> usize {
        self.0 as usize
    }
}

/// A stretch of one chain and a stretch of another on which vehicles would touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Zone {
    /// Its kind.
    pub kind: ZoneKind,
    /// Which vehicles would touch there.
    pub touch: Touch,
    /// The two stretches.
    pub sides: [Reach; 2],
    /// The side with priority.
    pub precedence: Precedence,
}

/// Kinds of zones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ZoneKind {
    /// The chains cross or touch.
    Crossing,
    /// They lead into one lane, or in one direction over the same area: the second vehicle follows the first.
    /// Stations along each side's chain, or beyond its end, from which on they are one, or at which a vehicle has
    /// left the area that they share [m].
    Merging([f64; 2]),
}

/// Which vehicles touch where two chains come close to each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Touch {
    /// Any two.
    Any,
    /// Any two of which at least one is long.
    OneLong,
    /// Two long ones.
    BothLong,
}

impl Touch {
    /// Whether it concerns a vehicle that `is_long` or not.
    #[inline]
    pub fn concerns(self, is_long: bool) -> bool {
        is_long || self != Touch::BothLong
    }

    /// Whether two vehicles touch that `are_long` or not.
    #[inline]
    pub fn is_of(self, are_long: [bool; 2]) -> bool {
        match self {
            Touch::Any => true,
            Touch::OneLong => are_long.contains(&true),
            Touch::BothLong => are_long == [true; 2],
        }
    }
}

/// A stretch of a chain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    /// The chain.
    pub chain: ChainIndex,
    /// First station at which a vehicle's front is in the way [m].
    pub start: f64,
    /// Station that its rear has to have passed to be out of the way [m].
    pub end: f64,
}

/// Priority where both could go.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precedence {
    /// The vehicle that came first.
    #[default]
    Arrival,
    /// The side with this number, 0 or 1; the other gives way.
    Side(u8),
    /// The vehicle from the right, on the side with this number, unless the other has waited long.
    FromTheRight(u8),
}
