//! What watches a run.

use std::path::PathBuf;

use laneweave_scenario::Fault;
use laneweave_sim::World;

use crate::outcome::Summary;

/// Something that watches a run; most leave files. One that keeps nothing from step to step needs `observe` only.
pub trait Observer {
    /// Sees the world after a step.
    ///
    /// # Errors
    /// If what it sees cannot be written.
    fn observe(&mut self, world: &World) -> Result<(), Fault>;

    /// What it keeps in memory, as bytes; what it has collected for the files it hands over first. By default nothing.
    ///
    /// # Errors
    /// If what is handed over cannot be written.
    fn save(&mut self, _world: &World) -> Result<Vec<u8>, Fault> {
        Ok(Vec::new())
    }

    /// Goes on from what it kept.
    ///
    /// # Errors
    /// If it is not what it kept.
    fn restore(&mut self, _saved: &[u8]) -> Result<(), Fault> {
        Ok(())
    }

    /// Completes its files after a run that amounts to `summary`, and names them. By default it leaves none.
    ///
    /// # Errors
    /// If a file cannot be written.
    fn finish(self: Box<Self>, _world: &World, _summary: &Summary) -> Result<Vec<PathBuf>, Fault> {
        Ok(Vec::new())
    }
}
