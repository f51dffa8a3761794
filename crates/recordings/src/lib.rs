//! Recorded traffic: read, cleaned and matched to the map, with its lane changes.
//!
//! A file becomes a [`Recording`] ([`open`], [`table::read`], [`commonroad::read`]). [`clean()`] corrects impossible
//! data. [`Matched`] gives the lanelet of each vehicle, and the vehicles in a frame. [`lane_changes`] finds the lane
//! changes, [`extents`] their begin and end. A [`Replay`] shows each frame as its drivers see it.

mod changes;
mod clean;
pub mod commonroad;
pub mod datasets;
mod drivers;
mod error;
mod evidence;
mod file;
pub mod interaction;
mod join;
mod lanes;
mod matching;
mod moves;
mod observe;
#[cfg(feature = "parquet")]
mod parquet;
mod problems;
mod purpose;
mod recording;
mod replay;
mod resample;
mod sideways;
mod smooth;
pub mod table;
mod turning_shares;

pub use changes::{LaneChange, RecordedChangeKind, lane_changes};
pub use clean::{CleaningReport, Example, Finding, clean};
pub use drivers::{Assumed, allowed};
pub use error::RecordingError;
pub use evidence::{Evidence, Exposure};
pub use file::open;
pub use join::{JoinError, Joined, join};
pub use matching::{Matched, Place, Present};
pub use observe::{Drone, Interruptions, Watch};
pub use recording::{Recording, RoadUser, State, Track};
pub use replay::{Frame, Replay, ReplayError};
pub use resample::resampled;
pub use sideways::{Extent, extents};
pub use turning_shares::TurningShares;
