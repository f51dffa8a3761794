//! What is remembered: events, trips, counts and incidents.

pub(crate) mod counts;
pub(crate) mod events;
pub(crate) mod incidents;
pub(crate) mod journal;
pub(crate) mod ledger;
pub(crate) mod log;
pub(crate) mod overlap;
pub(crate) mod records;
pub(crate) mod signs;
pub(crate) mod tally;
pub(crate) mod trips;
