//! What a replay adds to the results of its run: how well its drivers match the recording.

use std::path::{Path, PathBuf};

use laneweave_results::folder::{REPLAY, REPLAY_REPORT};
use laneweave_results::output::{json, write_whole};
use laneweave_scenario::Fault;

use super::{ReplayReport, Replayed, page};

impl Replayed {
    /// Writes the report on these `recordings`, which tells the `command`, into the folder `dir`, and returns it with
    /// the path of its page; nothing if the run was interrupted.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn write(
        &self,
        dir: &Path,
        recordings: &[PathBuf],
        command: &str,
    ) -> Result<Option<(&ReplayReport, PathBuf)>, Fault> {
        let Some(report) = &self.report else { return Ok(None) };
        write_whole(&dir.join(REPLAY), &json(report)?)?;
        let names: Vec<String> = recordings.iter().map(|it| it.display().to_string()).collect();
        let path = dir.join(REPLAY_REPORT);
        write_whole(&path, &page(report, &self.network, &names.join(", "), command).to_html())?;
        Ok(Some((report, path)))
    }
}
