//! laneweave: traffic whose drivers change lanes for human reasons. The library behind the command of this name.
//!
//! A [`scenario`] names a map, [`style`]s and a demand; prepared, it is a world that a [`simulation`] steps through
//! while [`output`]s observe it.

pub mod branch;
mod capacity;
pub mod check;
pub mod checkpoint;
pub mod compare;
pub mod explain;
mod fault;
pub mod folder;
pub mod output;
pub mod record;
pub mod report;
pub mod scenario;
pub mod simulation;
mod source;
pub mod style;
mod units;

pub use capacity::{Bottleneck, Capacity};
pub use fault::{Cause, Fault, did_you_mean};
pub use source::Source;

pub use laneweave_maps as maps;
pub use laneweave_models as models;
pub use laneweave_network as network;
pub use laneweave_recordings as recordings;
pub use laneweave_sim as sim;
pub use laneweave_study as study;
