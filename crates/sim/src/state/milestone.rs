//! Milestones of lane changes.

use laneweave_network::Position;

use crate::state::lane::VehicleId;

/// A milestone of a lane change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Milestone {
    /// Which vehicle.
    pub(crate) id: VehicleId,
    /// The slot of its record.
    pub(crate) record: u32,
    /// What was reached.
    pub(crate) what: Reached,
    /// Position of the front bumper of its main entry.
    pub(crate) at: Position,
    /// The same of its shadow.
    pub(crate) shadow: Option<Position>,
    /// Speed [m/s].
    pub(crate) speed: f64,
}

/// What a lane change reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Reached {
    /// The desire ended without a change.
    Nothing,
    /// The centre crossed the line.
    Crossing,
    /// The change is complete.
    End,
    /// The vehicle is back in the old lane.
    Return,
}
