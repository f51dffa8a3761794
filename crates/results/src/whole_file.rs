//! Files that are complete or not there.

use std::io::{self, Write};
use std::path::Path;

use laneweave_scenario::Fault;
use laneweave_study::PartialFile;

/// Writes a file that is complete or not there at all.
///
/// # Errors
/// If it cannot be written.
pub fn write_whole(path: &Path, content: &(impl AsRef<[u8]> + ?Sized)) -> Result<(), Fault> {
    let write = || -> io::Result<()> {
        let (partial, mut file) = PartialFile::create(path)?;
        file.write_all(content.as_ref())?;
        partial.complete()
    };
    write().map_err(|error| Fault::refused(path, "written", &error))
}
