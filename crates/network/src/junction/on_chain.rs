//! What drivers meet on a chain.

use super::light::LightIndex;
use super::zone::{Touch, ZoneIndex};

/// What drivers meet on one chain, in the order of stations. Fields that they read in every step come first in
/// memory.
#[derive(Clone, Debug, PartialEq)]
#[repr(C, align(32))]
pub struct OnChain {
    /// First and last place [m].
    pub(crate) extent: [f64; 2],
    /// From the chain's end to the next place on any route [m].
    pub(crate) beyond: f64,
    /// All crossings and stops; of two at the same station the place to stop comes first.
    pub places: Vec<Place>,
    /// Places to stop.
    pub stops: Vec<Stop>,
    /// Conflict zones.
    pub crossings: Vec<Crossing>,
}

/// A place where drivers may have to stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// The line, or the beginning of the zone [m].
    pub station: f64,
    /// Its kind.
    pub what: PlaceKind,
}

/// The kind of a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PlaceKind {
    /// A place to stop.
    Sign(Sign),
    /// A conflict zone.
    Zone {
        /// Its side.
        crossing: Crossing,
        /// Which vehicles would touch there.
        touch: Touch,
        /// Where it ends [m].
        end: f64,
        /// Station from which on the lanes are one, if they become one [m].
        merge: Option<f64>,
    },
}

/// A side of a zone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// The zone.
    pub zone: ZoneIndex,
    /// Which of its sides, 0 or 1.
    pub side: u8,
}

/// A place to stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// The front must not pass this station [m].
    pub station: f64,
    /// The reason to stop.
    pub sign: Sign,
}

/// The reason to stop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    /// A light.
    Light(LightIndex),
    /// A stop sign, of all ways or not: every driver stops once.
    Stop,
    /// A line: drivers stop if they have to give way.
    Line,
}

impl OnChain {
    pub(crate) const EMPTY: OnChain = OnChain {
        crossings: Vec::new(),
        stops: Vec::new(),
        places: Vec::new(),
        extent: [f64::INFINITY, f64::NEG_INFINITY],
        beyond: f64::INFINITY,
    };
}
