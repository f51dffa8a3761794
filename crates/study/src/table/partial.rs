//! A file that is either complete or not there.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

/// A file under a provisional name; removed when dropped before it is complete.
#[derive(Debug)]
pub struct PartialFile {
    target: PathBuf,
    partial: PathBuf,
}

impl PartialFile {
    /// Opens `NAME.partial` beside `target`.
    ///
    /// # Errors
    /// If it cannot be created.
    pub fn create(target: &Path) -> io::Result<(PartialFile, File)> {
        let mut partial = target.as_os_str().to_owned();
        partial.push(".partial");
        let partial = PathBuf::from(partial);
        let file = File::create(&partial)?;
        Ok((PartialFile { target: target.to_owned(), partial }, file))
    }

    /// The path the file will have.
    pub fn target(&self) -> &Path {
        &self.target
    }

    /// Gives the file its final name.
    ///
    /// # Errors
    /// If it cannot be renamed.
    pub fn complete(self) -> io::Result<()> {
        fs::rename(&self.partial, &self.target)
    }
}

impl Drop for PartialFile {
    fn drop(&mut self) {
        // A complete file is already renamed. A drop cannot report another error.
        let _ = fs::remove_file(&self.partial);
    }
}
