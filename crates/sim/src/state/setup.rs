//! How a world is to run, and what is put into it.

use laneweave_network::ChainIndex;

use crate::state::goal::Destination;
use crate::state::vehicle::Class;

/// How a world is to run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setup {
    /// Length of a step [s].
    pub step: f64,
    /// Seed of all draws.
    pub seed: u64,
    /// Number of threads.
    pub threads: usize,
}

/// A vehicle as it is put on the road.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NewVehicle {
    /// The chain.
    pub chain: ChainIndex,
    /// Front bumper along it [m].
    pub x: f64,
    /// Speed [m/s].
    pub speed: f64,
    /// Class.
    pub class: Class,
    /// Its driver's place in the table of driver parameters.
    pub parameters: u32,
    /// Where it goes.
    pub destination: Destination,
}
