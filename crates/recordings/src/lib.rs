//! Recorded traffic: read, cleaned, matched to the map, and its lane changes found.
//!
//! A file becomes a [`Recording`] ([`interaction::read`], [`commonroad::read`]); [`clean()`] mends what no road user
//! can have done; [`Matched`] says in which lanelet each vehicle is, and who is there in a frame; [`lane_changes`]
//! finds who changes, [`extents`] from when to when; a [`Replay`] shows each frame as its drivers see it.

mod changes;
mod clean;
pub mod commonroad;
mod drivers;
mod error;
pub mod interaction;
mod joints;
mod lanes;
mod matching;
mod moves;
mod problems;
mod purpose;
mod recording;
mod replay;
mod sideways;
mod smooth;

pub use changes::{Kind, LaneChange, lane_changes};
pub use clean::{CleaningReport, Example, Finding, clean};
pub use drivers::Assumed;
pub use error::RecordingError;
pub use matching::{Matched, Place, Present};
pub use recording::{Recording, RoadUser, State, Track};
pub use replay::{Frame, Replay, ReplayError};
pub use sideways::{Extent, extents};
