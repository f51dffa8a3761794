//! Recorded traffic read from the files of data sets, as plain data in the metric frame of a map.

pub mod commonroad;
mod error;
mod recording;

pub use error::RecordingError;
pub use recording::{Recording, RoadUser, State, Track};
