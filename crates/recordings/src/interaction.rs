//! Track files of the INTERACTION dataset (Zhan et al., 2019): CSV, one row for a road user in a frame.
//!
//! The columns track_id, frame_id, timestamp_ms, agent_type, x, y, vx, vy are required. psi_rad, length and width may
//! be missing or empty, as they are for pedestrians and cyclists. Columns are identified by name; rows may be in any
//! order.

mod write;

use laneweave_maps::Problem;

use crate::datasets::Dataset;
use crate::error::RecordingError;
use crate::recording::Recording;
use crate::table::{self, Known};
pub use write::write;

/// Reads a track file. Rows that cannot be used are left out and listed as problems.
///
/// # Errors
/// If a required column is missing, no row is left, or the times do not belong to frames at equal distances.
pub fn read(bytes: &[u8]) -> Result<(Recording, Vec<Problem>), RecordingError> {
    table::read(bytes, &Dataset::Interaction.layout(), &Known::default())
}
