//! Drivers: they perceive, decide and accelerate, and write the results into a plan.

pub(crate) mod accelerate;
pub(crate) mod attention;
pub(crate) mod beliefs;
pub(crate) mod choice;
pub(crate) mod consider;
pub(crate) mod decide;
pub(crate) mod drive;
pub(crate) mod gap;
pub(crate) mod intention;
pub(crate) mod lane_end;
pub(crate) mod last_place;
pub(crate) mod leave;
pub(crate) mod me;
pub(crate) mod merge;
pub(crate) mod obey;
pub(crate) mod perceive;
pub(crate) mod plan;
pub(crate) mod request_reservation;
pub(crate) mod stopping;
pub(crate) mod stuck;
pub(crate) mod turn;
pub(crate) mod two_lanes;
pub(crate) mod window;
pub(crate) mod wish;
