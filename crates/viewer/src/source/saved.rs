//! The scenario with what was done by hand, in a folder of its own.

use std::fs;
use std::path::{Path, PathBuf};

use laneweave::record;
use laneweave::scenario::{Origin, Scenario};
use laneweave::sim::Commanded;
use laneweave::study::{Format, TableWriter};
use laneweave::{COMMAND_COLUMNS, Fault, Written};
use serde::Serialize;

/// Where a scenario was saved.
#[derive(Clone, Debug, Serialize)]
pub struct Saved {
    /// The folder.
    pub folder: PathBuf,
    /// The scenario in it.
    pub scenario: PathBuf,
}

/// Writes `scenario` with these commands into a new folder inside `dir`, so that a run of it repeats all that was
/// done up to `until_s` [s].
pub(super) fn save(
    dir: &Path,
    (scenario, origin): (&Scenario, &Origin),
    commands: &[Commanded],
    until_s: f64,
) -> Result<Saved, Fault> {
    let folder = new_folder(dir)?;
    let path = folder.join("commands.csv");
    let unwritten = |error: &dyn std::fmt::Display| {
        Fault::new(path.display(), error.to_string(), "choose another folder with --save")
    };
    let mut table =
        TableWriter::create(&path, Format::Csv, &COMMAND_COLUMNS).map_err(|error| unwritten(&error))?;
    for command in commands {
        table.row(&Written::of(command, scenario.run.step_s).cells()).map_err(|error| unwritten(&error))?;
    }
    table.finish().map_err(|error| unwritten(&error))?;
    let mut saved = Scenario { commands: Some(path.clone()), external: Vec::new(), ..scenario.clone() };
    saved.run.duration_s = (until_s - saved.run.warmup_s).max(saved.run.step_s);
    saved.output.dir = folder.join("out");
    record::keep(&saved, origin, &folder, "laneweave view: what was done by hand")?;
    Ok(Saved { scenario: folder.join(record::SCENARIO), folder })
}

/// Makes a folder that was not there.
fn new_folder(dir: &Path) -> Result<PathBuf, Fault> {
    fs::create_dir_all(dir).map_err(|error| Fault::refused(dir, "made", &error))?;
    for number in 1_u32.. {
        let folder = dir.join(number.to_string());
        match fs::create_dir(&folder) {
            Ok(()) => return Ok(folder),
            Err(error) if error.kind() == std::io::ErrorKind::AlreadyExists => {}
            Err(error) => return Err(Fault::refused(&folder, "made", &error)),
        }
    }
    Err(Fault::new(dir.display(), "it has too many folders", "choose another folder with --save"))
}
