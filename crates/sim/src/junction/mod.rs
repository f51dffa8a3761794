//! Reservations of conflict zones, and what the traffic lights show.

pub(crate) mod actuated_signals;
pub(crate) mod need;
pub(crate) mod offsets;
pub(crate) mod reservations;
pub(crate) mod roundabouts;
pub(crate) mod signals;
pub(crate) mod state;
pub(crate) mod storage_section;
pub(crate) mod waiting_priority;
