//! What a run of a sweep leaves.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process;
use std::time::{SystemTime, UNIX_EPOCH};

use laneweave::Simulation;
use laneweave_scenario::Fault;
use serde::{Deserialize, Serialize};

use crate::compare::{MEASURES, Measure, Outcome, measure};

/// What is measured in addition to the measures of comparisons.
const MORE: [Measure; 6] = [
    measure("entered", "vehicles that entered", 0, |it| Some(it.entered)),
    measure("veh_km", "distance driven [veh-km]", 1, |it| Some(it.veh_km)),
    measure("collisions", "collisions", 0, |it| Some(it.collisions)),
    measure("overlaps", "overlaps", 0, |it| Some(it.overlaps)),
    measure("hard_brakings", "hard brakings [1/100 veh-km]", 2, |it| Some(100.0 * it.hard_brakings)),
    measure("lost", "drivers without a route to a destination", 0, |it| Some(it.lost)),
];

/// All that is measured in a run of a sweep.
pub fn measures() -> impl Iterator<Item = &'static Measure> + Clone {
    MEASURES.iter().chain(&MORE)
}

/// The row of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Row {
    /// The key of the run.
    pub(super) key: String,
    /// The [`measures`] in their order.
    pub(super) measured: Vec<Option<f64>>,
    /// Hash of all vehicles' states at the end, 16 hexadecimal digits.
    pub(super) state_hash: String,
}

impl Row {
    /// Runs `simulation` to its end.
    pub(super) fn of(key: &str, simulation: &mut Simulation) -> Row {
        let (outcome, _) = Outcome::of(simulation);
        let state_hash = format!("{:016x}", simulation.state_hash());
        Row { key: key.to_owned(), measured: measures().map(|it| (it.of)(&outcome)).collect(), state_hash }
    }

    /// The row in the file at `path`; `None` if there is none, or if the file is damaged: the run has to be done again.
    pub(super) fn read(path: &Path) -> Option<Row> {
        let text = fs::read(path).ok()?;
        let row: Row = serde_json::from_slice(&text).ok()?;
        Some(row).filter(|it| it.measured.len() == measures().count())
    }

    /// Writes the row into the file at `path`, whole or not at all. Several programs may write the same row.
    ///
    /// # Errors
    /// If it cannot be written.
    pub(super) fn write(&self, path: &Path) -> Result<(), Fault> {
        let text = serde_json::to_string(self).map_err(|error| Fault::bug(path.display(), error))?;
        match write_shared(path, &text) {
            Err(_) if Row::read(path).as_ref() == Some(self) => Ok(()),
            written => written,
        }
    }
}

/// Writes a file of a folder that several programs share, whole or not at all. All of them write the same.
///
/// # Errors
/// If it cannot be written.
pub(super) fn write_shared(path: &Path, text: &str) -> Result<(), Fault> {
    let own = own_name(path);
    let write = || -> io::Result<()> {
        let mut file = fs::File::create_new(&own)?;
        file.write_all(text.as_bytes())?;
        file.sync_data()?;
        fs::rename(&own, path)
    };
    write().map_err(|error| Fault::refused(path, "written", &error))
}

/// The path under which this program writes what will be at `path`: no other program has it.
pub(super) fn own_name(path: &Path) -> PathBuf {
    let now = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |it| it.as_nanos());
    path.with_extension(format!("{}-{now}.{PARTIAL}", process::id()))
}

/// The extension of files that are not whole.
pub(super) const PARTIAL: &str = "partial";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_is_read_as_it_was_written_and_a_damaged_one_is_none() {
        let folder = std::env::temp_dir().join(format!("laneweave-row-{}", process::id()));
        fs::create_dir_all(&folder).expect("a folder");
        let path = folder.join("a.json");
        let mut measured: Vec<Option<f64>> = measures().map(|_| Some(0.1 + 0.2)).collect();
        measured[1] = None;
        let row = Row { key: "a".into(), measured, state_hash: "0".into() };
        row.write(&path).expect("it is written");
        row.write(&path).expect("it is written again");
        assert_eq!(Row::read(&path), Some(row));
        let text = fs::read(&path).expect("it is there");
        fs::write(&path, &text[..text.len() / 2]).expect("it is written");
        assert_eq!(Row::read(&path), None);
        assert_eq!(fs::read_dir(&folder).expect("a folder").count(), 1);
        fs::remove_dir_all(&folder).expect("it is there");
    }
}
