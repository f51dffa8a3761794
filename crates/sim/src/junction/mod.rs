//! Reservations of conflict zones, and what the traffic lights show.
//!
//! A vehicle drives through a conflict zone only with a reservation. Reservations of one zone keep the order in which
//! they were granted: at a crossing the later vehicle waits for the earlier one, at a merge it follows. Where vehicles
//! would touch, and who has priority, is found once for a network, in `junction` of `laneweave_network`.
//!
//! * `state.rs` the part `JunctionState`; `reservations.rs` the order in each zone; `waiting_priority.rs` who waits,
//!   and since when; `need.rs` what a driver needs
//! * `storage_section.rs` where vehicles stand beyond zones; `roundabouts.rs` loops that keep some of that space free
//! * `signals.rs`, `actuated_signals.rs` and `offsets.rs` lights

pub(crate) mod actuated_signals;
pub(crate) mod need;
pub(crate) mod offsets;
pub(crate) mod reservations;
pub(crate) mod roundabouts;
pub(crate) mod signals;
pub(crate) mod state;
pub(crate) mod storage_section;
pub(crate) mod waiting_priority;
