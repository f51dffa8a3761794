//! Checkpoints: the state of a run and of its outputs in a file. An interrupted run continues from there, and ends
//! with the same results.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use laneweave_scenario::Fault;
use laneweave_study::PartialFile;
use serde::{Deserialize, Serialize};
use xxhash_rust::xxh3::xxh3_64;

use crate::folder::{CHECKPOINT, PAGES};
use crate::outcome::{Queues, ShortTrips};
use crate::pack::{pack, unpack};

/// The state of a run.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Checkpoint {
    /// Hash of everything on which the run depends.
    pub fingerprint: String,
    /// Hash of [the settings of the output](crate::record::output_settings).
    pub output_settings: String,
    /// Simulated time at which measuring began [s].
    pub measured_from_s: f64,
    /// Number of measured steps.
    pub measured_steps: u32,
    /// The world, and what the script of the scenario has done.
    pub world: Vec<u8>,
    /// The queues at the entrances so far.
    pub queues: Queues,
    /// The trips within one lanelet so far.
    pub short_trips: ShortTrips,
    /// The state of each output.
    pub outputs: Vec<Vec<u8>>,
}

/// Where and how often a run writes checkpoints.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Keeper {
    /// The file.
    pub path: PathBuf,
    /// Number of measured steps between two checkpoints.
    pub every: u32,
    /// See [`Checkpoint::fingerprint`].
    pub fingerprint: String,
    /// See [`Checkpoint::output_settings`].
    pub output_settings: String,
}

/// The name of the checkpoint file in the folder of results.
pub const FILE: &str = CHECKPOINT;
/// The name of the log of written pages.
pub const LOG: &str = PAGES;
/// The names of both.
pub const FILES: [&str; 2] = [FILE, LOG];
/// Bytes of the hash at the end of the file.
const HASH: usize = 8;

impl Checkpoint {
    /// Writes the file at `path` and replaces a former one; the file is complete or not there.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), Fault> {
        let mut bytes = pack(self)?;
        bytes.extend(xxh3_64(&bytes).to_le_bytes());
        let write = || -> io::Result<()> {
            let (partial, mut file) = PartialFile::create(path)?;
            file.write_all(&bytes)?;
            file.sync_data()?;
            partial.complete()
        };
        write().map_err(|error| Fault::refused(path, "written", &error))
    }

    /// The checkpoint at `path`, if there is one.
    ///
    /// # Errors
    /// If it cannot be read, or is not complete.
    pub fn read(path: &Path) -> Result<Option<Checkpoint>, Fault> {
        let bytes = match fs::read(path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            read => read.map_err(|error| Fault::refused(path, "read", &error))?,
        };
        let whole =
            bytes.split_last_chunk::<HASH>().filter(|(body, hash)| xxh3_64(body).to_le_bytes() == **hash);
        let Some((body, _)) = whole else {
            let remedy = "run again from the beginning, without --resume";
            return Err(Fault::new(path.display(), "the checkpoint is damaged", remedy));
        };
        unpack(body).map(Some)
    }
}
