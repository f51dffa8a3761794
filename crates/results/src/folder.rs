//! The folder of results: one program at a time writes into it, and all its files belong to one run.

use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

use laneweave_scenario::Fault;

/// Every file name of the results of a run, in the order of removal: a run without a summary has not ended.
pub const RESULTS: &[&str] = &[
    "summary.json",
    CHECKPOINT,
    PAGES,
    "trajectories.parquet",
    "trajectories.csv",
    "lane_changes.parquet",
    "lane_changes.csv",
    "incidents.parquet",
    "incidents.csv",
    "commands.parquet",
    "commands.csv",
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
    REPLAY,
    REPLAY_REPORT,
    DRAWS,
];
/// The folder in it for the differences between twins.
pub const BRANCH: &str = "branch";
/// Every name of a table there.
pub const DIFFERENCES: [&str; 4] =
    ["differences.parquet", "differences.csv", "instants.parquet", "instants.csv"];
/// The names of a checkpoint, and of the log of pages.
pub(crate) const CHECKPOINT: &str = "checkpoint";
pub(crate) const PAGES: &str = "checkpoint.pages";
/// The name of the table of commands, without its extension.
pub(crate) const COMMANDS: &str = "commands";
/// The name of a report.
pub const REPORT: &str = "report.html";

/// The name of what replications with draws of the parameters show.
pub const DRAWS: &str = "draws.json";

/// The names of what a replay adds: how well its drivers match the recording.
pub const REPLAY: &str = "replay.json";
/// As a page.
pub const REPLAY_REPORT: &str = "replay.html";

/// The name of what a fit found.
pub const FIT: &str = "fit.json";
/// As a page.
pub const FIT_REPORT: &str = "fit.html";

/// A folder that no other laneweave process can claim while this value lives; on systems that do not lock folders
/// they can.
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

    /// The path of the folder.
    pub fn dir(&self) -> &Path {
        &self.dir
    }

    /// Removes the files with these `names`, and their unfinished versions, from the folder.
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

    /// Removes the [differences](DIFFERENCES) that former twins left in the folder, and their report.
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

    /// Waits until these `files` of the folder, and their names, are on disk, so that they survive a loss of power.
    ///
    /// # Errors
    /// If the system cannot do this.
    pub fn settle(&self, files: &[PathBuf]) -> Result<(), Fault> {
        for path in files {
            let settled = File::options().append(true).open(path).and_then(|it| it.sync_all());
            settled.map_err(|error| Fault::refused(path, "written", &error))?;
        }
        // Some systems cannot do this for folders.
        let _ = self.folder.as_ref().map(File::sync_all);
        Ok(())
    }
}

/// Removes the file at `path`, if it exists.
fn remove(path: &Path) -> Result<(), Fault> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(Fault::refused(path, "removed", &error)),
        _ => Ok(()),
    }
}
