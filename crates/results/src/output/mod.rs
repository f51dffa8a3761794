//! The output of a run: tables, figures, a report and a summary. An observer makes each of them; it reads the world
//! and never writes it.
//!
//! A new output is a file here, a line in `observers.rs`, and its name in [`crate::folder::RESULTS`].

mod batch;
mod folder;
mod frame;
mod incidents;
mod lane_changes;
mod lanelets;
mod log;
mod names;
mod observers;
#[cfg(feature = "reports")]
mod report;
mod samples;
mod sumo;
mod traffic;
mod trajectories;
mod trip;
mod trips;
mod writer_threads;

pub use crate::observer::Observer;
pub use crate::outcome::{
    About, FirstIncident, HeldFor, Inputs, Provenance, Queue, Queues, ShortTrips, Summary, TripMeans,
    command_line,
};
#[cfg(feature = "reports")]
pub use crate::report::{Crowd, Driving, Reasons, Record, StyleDriving, TripTimes};
pub use crate::seen::{Boxes, Traces};
pub use crate::whole_file::write_whole;
pub use observers::observers;
