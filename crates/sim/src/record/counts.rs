//! Counts of the whole world.

use serde::{Deserialize, Serialize};

use crate::record::incidents::Incident;

/// Counts of the whole world, not of single lanes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Counts {
    /// Vehicles that entered.
    pub entered: u64,
    /// Vehicles among them that a user put on the road.
    pub inserted: u64,
    /// Vehicles that a user took off the road.
    pub removed: u64,
    /// Vehicles that completed their trips.
    pub left: u64,
    /// Discretionary lane changes: between lanes that are equally good for the route.
    pub discretionary_changes: u64,
    /// Route-driven lane changes: for the route, or away from it.
    pub route_changes: u64,
    /// Lane changes to the slow side for the law alone.
    pub keeping_changes: u64,
    /// Time on the map of the completed trips [s].
    pub trip_time: f64,
    /// Halts during the completed trips.
    pub stops: u64,
    /// Completed trips that had a destination.
    pub planned: u64,
    /// Delay of these trips: their time beyond that on a free road, at the speeds that the drivers desired, on the
    /// routes that they had when they entered [s].
    pub delay: f64,
    /// The first incident, if there was any.
    pub first_incident: Option<Incident>,
}
