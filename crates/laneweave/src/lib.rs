//! laneweave: a traffic simulator; its drivers change lanes for human reasons. This is the library of the command
//! with the same name.
//!
//! A [`scenario`] names a map, [`style`]s and a demand. It is prepared into a world. A [`simulation`] steps through
//! the world while [`output`]s observe it.

pub mod branch;
pub mod check;
pub mod compare;
pub mod run;

#[cfg(feature = "reports")]
pub use laneweave_results::report;
pub use laneweave_results::{checkpoint, folder, output, record};
pub use laneweave_scenario::{Bottleneck, Capacity, Cause, Fault, Source, did_you_mean, scenario, style};

pub use laneweave_explain as explain;
pub use laneweave_maps as maps;
pub use laneweave_models as models;
pub use laneweave_network as network;
pub use laneweave_recordings as recordings;
pub use laneweave_sim as sim;
pub use laneweave_study as study;
