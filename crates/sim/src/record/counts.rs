//! What the whole world does, counted.

use serde::{Deserialize, Serialize};

use crate::record::incidents::Incident;

/// Counts of what the whole world, not a lane, does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Counts {
    /// Vehicles that entered.
    pub entered: u64,
    /// Vehicles that left.
    pub left: u64,
    /// Lane changes between lanes of equal worth for the route.
    pub discretionary_changes: u64,
    /// Lane changes for the route, or off it.
    pub route_changes: u64,
    /// Time on the map of those that left [s].
    pub trip_time: f64,
    /// Times that those that left came to a halt.
    pub stops: u64,
    /// Of those that left, those who had somewhere to go.
    pub planned: u64,
    /// What their trips took beyond the time on a free road, at the speeds that they desired, of the way that they had
    /// before them when they entered [s].
    pub delay: f64,
    /// The first incident, if there was any.
    pub first_incident: Option<Incident>,
}
