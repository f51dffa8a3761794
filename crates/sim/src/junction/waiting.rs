//! What drivers hold of conflict zones, and claim of them.

use laneweave_network::ZoneIndex;
use serde::{Deserialize, Serialize};

use crate::state::lane::VehicleId;

/// A side of a zone that a vehicle may pass.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct ZoneReservation {
    pub(crate) zone: ZoneIndex,
    pub(crate) side: u8,
    /// Where the front comes in the way [m].
    pub(crate) enter: f64,
    /// Where it is no longer: the rear is out, or the lanes have become one [m].
    pub(crate) leave: f64,
}

/// A driver who waits because of others. Those out of patience come before all others, then who has waited longer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(crate) struct WaitingPriority {
    pub(crate) is_patient: bool,
    pub(crate) since: u32,
    pub(crate) id: VehicleId,
    pub(crate) is_long: bool,
}

/// The turn that somebody who waits claims on a side of a zone.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Turn {
    pub(crate) priority: WaitingPriority,
    /// Time until it can be there: those who have reservations hold it up, and it has to drive there [s].
    pub(crate) begins: f64,
}
