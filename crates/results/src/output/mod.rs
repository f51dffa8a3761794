//! The output of a run: tables, figures, a report and a summary. An [`Output`] makes each of them; it reads the world
//! and never writes it.
//!
//! A new output is a file here, a line in `outputs.rs`, and its name in [`crate::folder::RESULTS`].
//!
//! Outputs stand where the world is and keep plain numbers: `frame.rs` copies of vehicles, `traffic.rs` counts by
//! lanelet, trips and lane changes that ended. They hand these over in batches to writer threads
//! (`writer_threads.rs`), whose writers make one file each: `trajectories.rs` and the other tables, `sumo/` XML in the
//! formats of SUMO.

mod batch;
mod commands;
mod folder;
mod frame;
mod incidents;
mod lane_changes;
mod lanelets;
mod log;
mod names;
mod outputs;
#[cfg(feature = "reports")]
mod report;
mod samples;
mod sound;
mod sumo;
mod traffic;
mod trajectories;
mod trip;
mod trips;
mod writer_threads;

use std::path::PathBuf;

use laneweave_scenario::Fault;
use laneweave_sim::World;

pub use crate::outcome::{
    About, FirstIncident, HeldFor, Inputs, Provenance, Queue, Queues, ShortTrips, Summary, TripMeans,
    command_line,
};
#[cfg(feature = "reports")]
pub use crate::report::{Crowd, Driving, Reasons, Record, StyleDriving, TripTimes};
pub use crate::seen::{Boxes, Traces};
pub use crate::whole_file::{all_whole, json, write_whole};
pub use outputs::outputs;

/// An output of a run: it observes the world, and most outputs write files. One without a state needs `observe` only.
pub trait Output {
    /// Observes the world after a measured step.
    ///
    /// # Errors
    /// If its data cannot be written.
    fn observe(&mut self, world: &World) -> Result<(), Fault>;

    /// Observes the world after a step of the warm-up. By default it does not.
    ///
    /// # Errors
    /// If its data cannot be written.
    fn warm_up(&mut self, _world: &World) -> Result<(), Fault> {
        Ok(())
    }

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
