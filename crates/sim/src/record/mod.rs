//! What is recorded: events, trips, counts and incidents.

pub(crate) mod counters;
pub(crate) mod counts;
pub(crate) mod desire_situations;
pub(crate) mod events;
pub(crate) mod incidents;
pub(crate) mod lane_changes;
pub(crate) mod lanelet_aggregates;
pub(crate) mod log;
pub(crate) mod numbering;
pub(crate) mod overlap;
pub(crate) mod trip_log;
pub(crate) mod trips;
