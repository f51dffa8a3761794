//! The folder of results: one program writes into it at a time, and what lies in it is of one run.

use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

use laneweave_scenario::Fault;

/// Every name that a run gives to a file of results, in the order in which they are to go: without its summary no run
/// has ended.
pub const RESULTS: [&str; 21] = [
    "summary.json",
    CHECKPOINT,
    PAGES,
    "trajectories.parquet",
    "trajectories.csv",
    "lane_changes.parquet",
    "lane_changes.csv",
    "incidents.parquet",
    "incidents.csv",
    "trips.parquet",
    "trips.csv",
    "lanelets.parquet",
    "lanelets.csv",
    "flows.parquet",
    "flows.csv",
    "fcd.xml",
    "tripinfo.xml",
    "lanechanges.xml",
    REPORT,
    "lane_change_rate.svg",
    "time_space.svg",
];
/// The folder in it for what twins of the run differ in.
pub const BRANCH: &str = "branch";
/// Every name of a table there.
pub const DIFFERENCES: [&str; 4] =
    ["differences.parquet", "differences.csv", "instants.parquet", "instants.csv"];
/// The name of a run as it stands, and of what was written so far.
pub(crate) const CHECKPOINT: &str = "checkpoint";
pub(crate) const PAGES: &str = "checkpoint.pages";
/// The name of a report.
pub const REPORT: &str = "report.html";

/// A folder into which no other laneweave writes as long as this lives; where the system does not lock folders, others
/// do.
#[derive(Debug)]
pub struct Claim {
    dir: PathBuf,
    /// The folder, locked.
    folder: Option<File>,
}

impl Claim {
    /// Makes the folder at `dir`, if it is not there, and claims it.
    ///
    /// # Errors
    /// If it cannot be made, or another program has claimed it.
    pub fn on(dir: &Path) -> Result<Claim, Fault> {
        fs::create_dir_all(dir)
            .map_err(|error| Fault::refused(dir, "created as the results folder", &error))?;
        let claim = |folder| Claim { dir: dir.to_owned(), folder };
        let Ok(folder) = File::open(dir) else { return Ok(claim(None)) };
        match folder.try_lock() {
            Ok(()) => Ok(claim(Some(folder))),
            Err(TryLockError::WouldBlock) => {
                let what = "another laneweave process is writing its results into this folder";
                Err(Fault::new(dir.display(), what, "wait until it has ended, or choose another folder"))
            }
            Err(TryLockError::Error(_)) => Ok(claim(None)),
        }
    }

    /// Where the folder is.
    pub fn dir(&self) -> &Path {
        &self.dir
    }

    /// Removes the files of these `names` from the folder, and what of them was only begun.
    ///
    /// # Errors
    /// If one is there and cannot be removed.
    pub fn clear(&self, names: &[&str]) -> Result<(), Fault> {
        for name in names {
            remove(&self.dir.join(name))?;
            remove(&self.dir.join(format!("{name}.partial")))?;
        }
        Ok(())
    }

    /// Removes the [differences](DIFFERENCES) that former twins left in the folder, and their report, if they left any.
    ///
    /// # Errors
    /// If one is there and cannot be removed.
    pub fn clear_differences(&self) -> Result<(), Fault> {
        if !DIFFERENCES.iter().any(|it| self.dir.join(it).exists()) {
            return Ok(());
        }
        self.clear(&[REPORT])?;
        self.clear(&DIFFERENCES)
    }

    /// Returns when these `files` of the folder, and their names, are where not even a loss of power takes them.
    ///
    /// # Errors
    /// If the system cannot have them there.
    pub fn settle(&self, files: &[PathBuf]) -> Result<(), Fault> {
        for path in files {
            let settled = File::options().append(true).open(path).and_then(|it| it.sync_all());
            settled.map_err(|error| Fault::refused(path, "written", &error))?;
        }
        // Not every system lets folders be asked for it.
        let _ = self.folder.as_ref().map(File::sync_all);
        Ok(())
    }
}

/// Removes the file at `path`, if it is there.
fn remove(path: &Path) -> Result<(), Fault> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(Fault::refused(path, "removed", &error)),
        _ => Ok(()),
    }
}
