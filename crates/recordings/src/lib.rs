//! Recorded traffic: read, cleaned and matched to the map, with its lane changes.
//!
//! A file becomes a [`Recording`] ([`open`], [`table::read`], [`commonroad::read`]). [`clean()`] corrects impossible
//! data. [`Matched`] gives the lanelet of each vehicle, and the vehicles in a frame. [`lane_changes`] finds the lane
//! changes, [`extents`] their begin and end, [`cut_ins`] who was near behind. Nothing here knows the simulator.

mod changes;
mod clean;
pub mod commonroad;
mod cut_ins;
pub mod datasets;
mod error;
mod file;
mod gaps;
pub mod interaction;
mod join;
mod lanes;
mod matching;
mod moves;
#[cfg(feature = "parquet")]
mod parquet;
mod presence;
mod problems;
mod purpose;
mod recording;
mod resample;
mod sideways;
pub mod smooth;
pub mod table;

pub use changes::{LaneChange, RecordedChangeKind, lane_changes};
pub use clean::{CleaningReport, Example, Finding, clean};
pub use cut_ins::{CutIn, cut_ins};
pub use error::RecordingError;
pub use file::open;
pub use join::{JoinError, Joined, Series, join, series};
pub use lanes::{Foot, foot};
pub use matching::{Matched, Place, Present};
pub use recording::{Recording, RoadUser, State, Track};
pub use resample::resampled;
pub use sideways::{Extent, extents, last_before};
