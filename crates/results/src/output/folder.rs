//! The folder for the files of a run.

use std::fs;
use std::path::{Path, PathBuf};

use laneweave_scenario::Fault;
use laneweave_study::{Column, Format, TableWriter};

use crate::outcome::Provenance;

/// The folder of the results, and the data that all its files share.
pub(super) struct Folder<'a> {
    pub(super) dir: &'a Path,
    pub(super) format: Format,
    pub(super) provenance: &'a Provenance,
}

impl Folder<'_> {
    /// Creates it, if it does not exist.
    pub(super) fn make(&self) -> Result<(), Fault> {
        let Folder { dir, .. } = self;
        fs::create_dir_all(dir).map_err(|error| Fault::refused(dir, "created as the results folder", &error))
    }

    /// The path of a file in it.
    pub(super) fn file(&self, name: &str) -> PathBuf {
        self.dir.join(name)
    }

    /// Begins the table called `name`.
    pub(super) fn table(&self, name: &str, columns: &[Column]) -> Result<(TableWriter, PathBuf), Fault> {
        let path = self.file(name).with_extension(self.format.extension());
        let notes = self.provenance.notes();
        let notes = notes.each_ref().map(|(key, value)| (*key, value.as_str()));
        Ok((TableWriter::create_with(&path, self.format, columns, &notes)?, path))
    }
}
