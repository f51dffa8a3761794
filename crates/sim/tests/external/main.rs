//! External vehicles: a user drives them in the traffic of simulated drivers.

mod abuse;
mod commands;
#[path = "../roads/drivers.rs"]
mod drivers;
mod identity;
mod lanes;
mod poses;
mod struck;
mod worlds;
mod yielding;
