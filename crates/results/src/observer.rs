//! Observers of a run.

use std::path::PathBuf;

use laneweave_scenario::Fault;
use laneweave_sim::World;

use crate::outcome::Summary;

/// An observer of a run; most of them write files. One without a state needs `observe` only.
pub trait Observer {
    /// Observes the world after a step.
    ///
    /// # Errors
    /// If its data cannot be written.
    fn observe(&mut self, world: &World) -> Result<(), Fault>;

    /// Its state as bytes, for a checkpoint. Before, it sends the data that it has collected to its files. By default
    /// it is empty.
    ///
    /// # Errors
    /// If the data cannot be written.
    fn save(&mut self, _world: &World) -> Result<Vec<u8>, Fault> {
        Ok(Vec::new())
    }

    /// Restores its state.
    ///
    /// # Errors
    /// If the bytes are not such a state.
    fn restore(&mut self, _saved: &[u8]) -> Result<(), Fault> {
        Ok(())
    }

    /// Completes its files after a run with this `summary`, and returns their names. By default there are none.
    ///
    /// # Errors
    /// If a file cannot be written.
    fn finish(self: Box<Self>, _world: &World, _summary: &Summary) -> Result<Vec<PathBuf>, Fault> {
        Ok(Vec::new())
    }
}
