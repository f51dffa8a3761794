//! External vehicles: a user drives them in the traffic of simulated drivers.

mod abuse;
mod closed_lanes;
mod commands;
mod courtesy;
mod cut_off;
mod identity;
mod lanes;
mod parameters;
mod poses;
mod recorded;
mod standing;
mod struck;
pub(crate) mod worlds;
mod yielding;
