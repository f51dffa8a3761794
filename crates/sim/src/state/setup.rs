//! The setup of a world, and where vehicles are placed in it.

use laneweave_network::ChainIndex;

use crate::state::goal::Destination;
use crate::state::vehicle::Class;

/// The setup of a world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setup {
    /// Length of a step [s].
    pub step: f64,
    /// Seed of all random numbers.
    pub seed: u64,
    /// Number of threads.
    pub threads: usize,
}

/// A vehicle as it is placed on the road.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Its chain.
    pub chain: ChainIndex,
    /// Front bumper along it [m].
    pub x: f64,
    /// Speed [m/s].
    pub speed: f64,
    /// Class.
    pub class: Class,
    /// Index of its driver in the table of driver parameters.
    pub parameters: u32,
    /// Its destination.
    pub destination: Destination,
}
