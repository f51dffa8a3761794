//! A file that leads a browser to the page: the address has a token, which must not stand among the arguments of a
//! process, where everybody on this machine can read it.

use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::Token;

/// A file that only this user can read, for as long as this is there.
pub struct Doorway(PathBuf);

impl Doorway {
    /// A file that leads to `address`.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn to(address: &str) -> io::Result<Doorway> {
        let path = std::env::temp_dir().join(format!("laneweave-view-{}.html", Token::new()));
        let mut options = OpenOptions::new();
        #[cfg(unix)]
        std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
        let mut file = options.write(true).create_new(true).open(&path)?;
        let doorway = Doorway(path);
        write!(
            file,
            "<!DOCTYPE html><meta charset=\"utf-8\"><meta name=\"referrer\" content=\"no-referrer\">\
             <meta http-equiv=\"refresh\" content=\"0; url={address}\"><title>laneweave</title>"
        )?;
        Ok(doorway)
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.0
    }
}

impl Drop for Doorway {
    fn drop(&mut self) {
        // Somebody else may have cleaned up.
        let _ = fs::remove_file(&self.0);
    }
}
