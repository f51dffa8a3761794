//! A trip from its origin to its end.

use laneweave_network::Position;
use laneweave_sim::TripRecord;
use serde::{Deserialize, Serialize};

/// A trip that ended, or goes on when the run ends.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Trip {
    /// Its record.
    pub(super) record: TripRecord,
    /// The way that was driven [m].
    pub(super) way: f64,
    /// How it ended, if it did.
    pub(super) end: Option<End>,
}

/// The end of a trip.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct End {
    /// When [s].
    pub(super) time: f64,
    /// After so long on the map [s].
    pub(super) duration: f64,
    /// Where: its front bumper, which is at most at the end of the road.
    pub(super) at: Position,
    /// At which speed [m/s].
    pub(super) speed: f64,
}

impl Trip {
    /// What it took beyond the time on a free road [s], if it went anywhere and ended.
    pub(super) fn delay(&self) -> Option<f64> {
        Some(self.end?.duration - self.record.free_time?)
    }

    /// Time that its vehicle waited to enter [s]. It came within the step in which it could enter first.
    pub(super) fn waiting(&self) -> f64 {
        (self.record.entered - self.record.arrived).max(0.0)
    }
}
