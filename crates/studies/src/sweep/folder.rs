//! The folder of a sweep: its plan, the rows of the runs that are done, and at the end its tables.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::PathBuf;

use laneweave_results::output::json;
use laneweave_results::record::SCENARIO;
use laneweave_scenario::{Fault, FaultKind, Source};
use serde::{Deserialize, Serialize};

use super::row::{PARTIAL, Row, write_shared};

/// The names of the description of a sweep, and of the folder of its rows.
const SWEEP: &str = "sweep.json";
const ROWS: &str = "rows";

/// The description of a sweep, from which any program can go on with it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Description {
    /// The version of the program.
    pub(super) version: String,
    /// The whole path of the plan, from which its relative paths begin.
    pub(super) plan: PathBuf,
    /// Its text.
    pub(super) text: String,
    /// The files on which the runs depend, with their hashes.
    pub(super) files: BTreeMap<PathBuf, u64>,
    /// The seeds of each variant.
    pub(super) seeds: Vec<u64>,
    /// The fingerprint of each variant with the first seed.
    pub(super) variants: Vec<String>,
}

impl Description {
    /// The plan.
    pub(super) fn source(&self) -> Source {
        Source { path: self.plan.clone(), text: self.text.clone() }
    }
}

/// The folder of a sweep.
#[derive(Clone, Debug)]
pub(super) struct Folder(pub(super) PathBuf);

impl Folder {
    /// The description of the sweep in it, if it has one.
    ///
    /// # Errors
    /// If it cannot be read.
    pub(super) fn description(&self) -> Result<Option<Description>, Fault> {
        let path = self.0.join(SWEEP);
        let text = match fs::read_to_string(&path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            read => read.map_err(|error| Fault::refused(&path, "read", &error))?,
        };
        let read = serde_json::from_str(&text);
        read.map(Some).map_err(|error| {
            let remedy = "choose another folder; or delete this file, and the sweep begins anew";
            Fault::new(path.display(), error, remedy).of_kind(FaultKind::Syntax)
        })
    }

    /// Begins the sweep of `description`, or goes on with it.
    ///
    /// # Errors
    /// If the folder has another sweep, or another result; or if it cannot be written.
    pub(super) fn begin(&self, description: &Description) -> Result<(), Fault> {
        if let Some(begun) = self.description()? {
            return self.is_same(&begun, description);
        }
        if self.0.join(SCENARIO).exists() {
            let what =
                "this folder contains a scenario; the results of a run of it would be mixed with the sweep";
            return Err(Fault::new(self.0.display(), what, "choose another folder"));
        }
        let rows = self.0.join(ROWS);
        fs::create_dir_all(&rows).map_err(|error| Fault::refused(&rows, "created", &error))?;
        write_shared(&self.0.join(SWEEP), &json(description)?)
    }

    /// Refuses a sweep that is not the one that was begun here.
    fn is_same(&self, begun: &Description, asked: &Description) -> Result<(), Fault> {
        if (&begun.variants, &begun.seeds) == (&asked.variants, &asked.seeds) {
            return Ok(());
        }
        let fault = |what: String, remedy: &str| {
            Err(Fault::new(self.0.display(), what, remedy).of_kind(FaultKind::State))
        };
        let other = "choose another folder, or delete this one";
        if begun.version != asked.version {
            let Description { version, .. } = begun;
            return fault(format!("this sweep was begun by laneweave {version}"), other);
        }
        let changed =
            asked.files.iter().find(|(path, hash)| begun.files.get(*path).is_some_and(|it| it != *hash));
        match changed {
            Some((path, _)) => {
                let what = format!("{} has changed since this sweep was begun", path.display());
                fault(what, "undo the change, or begin in another folder")
            }
            None => {
                fault(format!("this folder has the sweep of another plan, {}", begun.plan.display()), other)
            }
        }
    }

    /// The path of the row of the run with this key.
    pub(super) fn row(&self, key: &str) -> PathBuf {
        self.0.join(ROWS).join(key).with_extension("json")
    }

    /// The rows that are there, by their keys.
    ///
    /// # Errors
    /// If the folder cannot be read.
    pub(super) fn rows(&self) -> Result<BTreeMap<String, Row>, Fault> {
        let is_row = |it: &PathBuf| it.extension().is_some_and(|it| it == "json");
        let rows = self.entries()?.into_iter().filter(is_row).filter_map(|it| Row::read(&it));
        Ok(rows.map(|it| (it.key.clone(), it)).collect())
    }

    /// Removes the rows that programs left unfinished.
    ///
    /// # Errors
    /// If the folder cannot be read.
    pub(super) fn tidy(&self) -> Result<(), Fault> {
        let left = self.entries()?.into_iter().filter(|it| it.extension().is_some_and(|it| it == PARTIAL));
        // Another program may remove it first.
        left.for_each(|it| drop(fs::remove_file(it)));
        Ok(())
    }

    fn entries(&self) -> Result<Vec<PathBuf>, Fault> {
        let rows = self.0.join(ROWS);
        let refused = |error: io::Error| Fault::refused(&rows, "read", &error);
        let entries = fs::read_dir(&rows).map_err(refused)?;
        entries.map(|it| it.map(|it| it.path()).map_err(refused)).collect()
    }

    /// The path of a table.
    pub(super) fn table(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }
}
