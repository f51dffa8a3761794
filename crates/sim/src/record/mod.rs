//! What is recorded: events, trips, counts and incidents.
//!
//! * `log.rs` the part `Log`; `events.rs` what happened in a step; `lane_changes.rs` changes under way
//! * `trips.rs` what is kept of every trip until it ends; `trip_log.rs` whole trips and `lanelet_aggregates.rs` their
//!   sums on every lanelet, where somebody asks for them
//! * `counters.rs`, `counts.rs` and `desire_situations.rs` counts; `overlap.rs` and `incidents.rs` vehicles that touch

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
