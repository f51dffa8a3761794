//! Phases and kinds of lane changes.

use serde::{Deserialize, Serialize};

/// The phase of a driver's lane change.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[repr(u8)]
pub enum Phase {
    /// It keeps its lane.
    Cruises,
    /// It waits for a gap.
    Wants,
    /// It changes lanes.
    Changes,
    /// It returns to the old lane.
    Aborts,
}

impl Phase {
    /// The names of all phases in tables, in their order.
    pub const NAMES: [&'static str; 4] = ["cruises", "wants", "changes", "aborts"];

    /// Its name in tables.
    pub fn name(self) -> &'static str {
        Phase::NAMES[self as usize]
    }

    /// Whether the vehicle is between two lanes, with an entry in both.
    #[inline]
    pub fn is_between_lanes(self) -> bool {
        matches!(self, Phase::Changes | Phase::Aborts)
    }
}

/// The kind of a lane change.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[repr(u8)]
pub enum LaneChangeKind {
    /// Discretionary: between lanes that lead to the same place, for more than the law.
    Discretionary,
    /// Route-driven: for the route, or away from it.
    Route,
    /// Keeping: to the slow side, only because the law wants drivers there.
    Keeping,
}

impl LaneChangeKind {
    /// All of them, in their order.
    pub const ALL: [LaneChangeKind; 3] =
        [LaneChangeKind::Discretionary, LaneChangeKind::Route, LaneChangeKind::Keeping];

    /// Its name in tables.
    pub fn name(self) -> &'static str {
        ["discretionary", "route", "keeping"][self as usize]
    }
}
