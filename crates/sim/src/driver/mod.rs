//! Drivers: they perceive, decide and accelerate, and write the results into a plan.
//!
//! * `perceive.rs` turns an instant into the plain data of the models; `attention.rs` whether a driver is concentrated
//! * `turn.rs`, `consider.rs`, `choice.rs` and `decide.rs` lane changes; `gap.rs` the gap beside, and why it is not
//!   accepted; `misperception.rs` the errors with which a driver sees others; `window.rs` and `last_place.rs` short
//!   stretches on which lanes may be changed
//! * `drive.rs`, `accelerate.rs`, `fall_in.rs`, `two_lanes.rs`, `merge.rs`, `stopping.rs` and `lane_end.rs` the next
//!   motion; `steering.rs` how slow drivers move sideways
//! * `request_reservation.rs` junctions; `stuck.rs` who stands for nothing
//! * `beliefs.rs` and `leave.rs` how drivers take guidance; `other_goal.rs` when they give their destination up
//! * `obey.rs` external vehicles; `plan.rs` what a step writes down; `intention.rs` and `wish.rs` what is read of it

pub(crate) mod accelerate;
pub(crate) mod attention;
pub(crate) mod beliefs;
pub(crate) mod choice;
pub(crate) mod consider;
pub(crate) mod decide;
pub(crate) mod drive;
pub(crate) mod fall_in;
pub(crate) mod gap;
pub(crate) mod intention;
pub(crate) mod lane_end;
pub(crate) mod last_place;
pub(crate) mod leave;
pub(crate) mod me;
pub(crate) mod merge;
pub(crate) mod misperception;
pub(crate) mod obey;
pub(crate) mod other_goal;
pub(crate) mod perceive;
pub(crate) mod plan;
pub(crate) mod request_reservation;
pub(crate) mod steering;
pub(crate) mod stopping;
pub(crate) mod stuck;
pub(crate) mod turn;
pub(crate) mod two_lanes;
pub(crate) mod window;
pub(crate) mod wish;
