//! The state as plain data: vehicles, lanes, time and random numbers.
//!
//! * `traffic.rs` all lanes and the clock; `lane.rs` the entries of a lane; `lane_change.rs` and `phase.rs` what only
//!   lane changes need; `previous_lanes.rs` the chains that a vehicle's rear may still be on; `busy_lanes.rs` which
//!   lanes have vehicles
//! * `vehicle.rs` classes and bodies; `goal.rs` where a driver goes; `driver_parameters.rs` the sets of driver
//!   parameters, and what users changed in them; `random.rs` random numbers
//! * `command.rs`, `commands.rs`, `control.rs` and `externals.rs` what users do

pub(crate) mod busy_lanes;
pub(crate) mod clock;
pub(crate) mod command;
pub(crate) mod commands;
pub(crate) mod control;
pub(crate) mod driver_parameters;
pub(crate) mod externals;
pub(crate) mod gamma;
pub(crate) mod goal;
pub(crate) mod lane;
pub(crate) mod lane_change;
pub(crate) mod milestone;
pub(crate) mod moment;
pub(crate) mod normal;
pub(crate) mod phase;
pub(crate) mod prefetch;
pub(crate) mod previous_lanes;
pub(crate) mod push_tight;
pub(crate) mod random;
pub(crate) mod setup;
#[cfg(test)]
pub(crate) mod some_style;
pub(crate) mod standstill;
pub(crate) mod traffic;
pub(crate) mod vehicle;
