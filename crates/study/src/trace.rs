//! Observations of a vehicle: samples, and its lane changes.

use serde::{Deserialize, Serialize};

/// A vehicle at one instant.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sample {
    /// Time [s].
    pub time_s: f64,
    /// Position along the lane or road [m].
    pub position_m: f64,
    /// Speed [m/s].
    pub speed_mps: f64,
}

/// Place and time of a vehicle's lane change.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mark {
    /// Time [s].
    pub time_s: f64,
    /// Position along the lane or road [m].
    pub position_m: f64,
}
