//! Zone reservations and waiting priorities.

use laneweave_network::ZoneIndex;
use serde::{Deserialize, Serialize};

use crate::state::lane::VehicleId;

/// A side of a zone that a vehicle may pass.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct ZoneReservation {
    pub(crate) zone: ZoneIndex,
    pub(crate) side: u8,
    /// Where its front enters the zone [m].
    pub(crate) enter: f64,
    /// Where it no longer occupies the zone: its rear has left, or the lanes have merged [m].
    pub(crate) leave: f64,
}

/// A driver who waits because of other vehicles. Impatient drivers come first, then those who have waited longer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(crate) struct WaitingPriority {
    pub(crate) is_patient: bool,
    pub(crate) since: u32,
    pub(crate) id: VehicleId,
    pub(crate) is_long: bool,
}

/// The turn that a waiting driver requests on a side of a zone.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct WaitingTurn {
    pub(crate) priority: WaitingPriority,
    /// Time until its vehicle can be there: vehicles with reservations delay it, and it has to drive there [s].
    pub(crate) begins: f64,
    /// It waits to enter a roundabout.
    pub(crate) enters: bool,
    /// Its vehicle waits within a zone.
    pub(crate) is_within: bool,
}
