//! A trip from its origin to its end.

use laneweave_network::Position;
use laneweave_sim::TripRecord;
use serde::{Deserialize, Serialize};

/// A trip that ended, or that continues when the run ends.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Trip {
    pub(super) record: TripRecord,
    /// Distance driven [m].
    pub(super) way: f64,
    /// Its end, if it ended.
    pub(super) end: Option<End>,
}

/// The end of a trip.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct End {
    /// Time [s].
    pub(super) time: f64,
    /// Time on the map [s].
    pub(super) duration: f64,
    /// Place of its front bumper, at most at the end of the road.
    pub(super) at: Position,
    /// Speed [m/s].
    pub(super) speed: f64,
}

impl Trip {
    /// Delay beyond the time on a free road [s], if it had a distance to drive and ended.
    pub(super) fn delay(&self) -> Option<f64> {
        Some(self.end?.duration - self.record.free_time?)
    }

    /// Time that its vehicle waited to enter [s]; 0 if it arrived within the step in which it entered.
    pub(super) fn waiting(&self) -> f64 {
        (self.record.entered - self.record.arrived).max(0.0)
    }
}
