//! Questions about a world. They change nothing.
//!
//! * `account.rs` what a driver makes of its lanes and is about to do, told by the decision itself
//! * `standing.rs` why a vehicle stands; `wait_cycle.rs` who waits for whom in a circle
//! * `queues.rs` who waits to enter, and why

pub(crate) mod account;
pub(crate) mod queues;
pub(crate) mod standing;
pub(crate) mod wait_cycle;
