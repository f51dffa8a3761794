//! What a target reads from a file.

use std::path::PathBuf;

/// A file of this process with these bytes.
///
/// # Panics
/// If it cannot be written.
pub fn holding(bytes: &[u8]) -> PathBuf {
    let path = std::env::temp_dir().join(format!("laneweave_fuzz_{}", std::process::id()));
    std::fs::write(&path, bytes).expect("there is room");
    path
}
