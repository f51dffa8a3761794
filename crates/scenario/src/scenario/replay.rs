//! A recording in a scenario.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A replay: recorded vehicles drive as they were recorded, and some of them become drivers who react. Without a demand
/// in the scenario nobody else drives.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Replay {
    /// The files of the recording, which continue one another, relative to the scenario file. Time 0 is its first
    /// frame.
    pub recording: Vec<PathBuf>,
    /// The file (.toml) that names the columns of the tables, relative to the scenario file; default: the columns of a
    /// dataset that is known.
    pub columns: Option<PathBuf>,
    /// Share of the vehicles that become drivers, 0 to 1. Which ones follows from their ids in the recording.
    pub reactive_share: f64,
    /// The ids of the vehicles that become drivers, in place of a share.
    pub reactive_ids: Vec<i64>,
    /// Time from which on they are drivers [s]; those who come later are drivers as soon as they are in a lane.
    pub reactive_from_s: f64,
}

impl Replay {
    /// Whether there is a recording.
    pub fn is_asked(&self) -> bool {
        !self.recording.is_empty()
    }
}
