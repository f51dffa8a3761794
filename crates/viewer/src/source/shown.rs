//! What is shown of a file or a folder.

use std::path::{Path, PathBuf};

use laneweave::Fault;
use laneweave::maps::FileKind;
use laneweave::record::SCENARIO;
use laneweave::scenario::{MapOptions, Origin, open_map};
use laneweave_studies::branch::Setting;
use laneweave_studies::check::tracks;

use super::{Live, Recorded, Rerun, Source};

/// Traffic that is shown.
#[derive(Clone, Debug, Default)]
pub struct Shown {
    /// A scenario or a map to simulate, the folder of a run that has ended, or recordings; nothing: the demo.
    pub input: Vec<PathBuf>,
    /// The map of the recordings.
    pub map: Option<PathBuf>,
    /// A file that says what the columns of the recordings hold.
    pub columns: Option<PathBuf>,
    /// How a map is read.
    pub options: MapOptions,
}

impl Shown {
    /// It. What is done by hand in a simulation is saved in folders inside `saved`.
    ///
    /// # Errors
    /// If something is missing, not readable, or invalid.
    pub fn source(&self, saved: &Path) -> Result<Box<dyn Source>, Fault> {
        if let Some(map) = &self.map {
            return Ok(Box::new(Recorded::open(&self.input, map, self.columns.as_deref(), &self.options)?));
        }
        let path = match &self.input[..] {
            [] => {
                let (scenario, origin) = Origin::demo()?;
                return Ok(Box::new(Live::new(&scenario, &origin, saved.to_owned())?));
            }
            [path] => path,
            [_, second, ..] => {
                let remedy = "add --map MAP if these are recordings, or give one of them";
                return Err(Fault::new(second.display(), "one thing is shown at a time", remedy));
            }
        };
        match FileKind::of(path) {
            FileKind::Folder if self.options != MapOptions::default() => {
                let what = "how its map is read is kept with a run, and cannot be changed";
                Err(Fault::new(path.display(), what, "leave the options of the map out"))
            }
            FileKind::Folder => run(path),
            kind if kind.is_table() => {
                Err(Fault::new(path.display(), "a recording needs the map of its location", "add --map MAP"))
            }
            kind if kind.has_tracks() => self.common_road(path, saved),
            _ => self.simulated(path, saved),
        }
    }

    /// The run that has ended, and its twin, which has the `settings` from the time `at` on [s].
    ///
    /// # Errors
    /// If it is no such run, if something is missing, not readable, or invalid, or if a setting does not fit.
    pub fn twins(&self, at: f64, settings: &[Setting]) -> Result<Box<dyn Source>, Fault> {
        match &self.input[..] {
            [dir] if self.map.is_none() && dir.is_dir() => {
                check_results(dir)?;
                Ok(Box::new(Rerun::with_twin(dir, at, settings)?))
            }
            _ => {
                let what = "only a run that has ended has a twin with other settings";
                let remedy = "give the folder that laneweave run has written, or leave out --at and --set";
                Err(Fault::new("--at", what, remedy))
            }
        }
    }

    /// A simulation that runs now.
    fn simulated(&self, path: &Path, saved: &Path) -> Result<Box<dyn Source>, Fault> {
        let (mut scenario, origin) = Origin::open(path)?;
        scenario.map_options = match FileKind::by_name(path) {
            FileKind::Toml => over(&scenario.map_options, &self.options),
            _ => self.options.clone(),
        };
        Ok(Box::new(Live::new(&scenario, &origin, saved.to_owned())?))
    }

    /// A CommonRoad file may contain a recording beside its map.
    fn common_road(&self, path: &Path, saved: &Path) -> Result<Box<dyn Source>, Fault> {
        let map = open_map(path, &self.options)?;
        match tracks(path)? {
            Some((recording, _)) => {
                let title = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
                Ok(Box::new(Recorded::new(title, &map, recording)?))
            }
            None => self.simulated(path, saved),
        }
    }
}

/// The `options` over those of a scenario.
fn over(own: &MapOptions, options: &MapOptions) -> MapOptions {
    let usual = MapOptions::default();
    MapOptions {
        origin: options.origin.or(own.origin),
        law: if options.law == usual.law { own.law } else { options.law },
        driving_side: options.driving_side.or(own.driving_side),
        joins_ends: options.joins_ends || own.joins_ends,
        max_size_mb: options.max_size_mb.or(own.max_size_mb),
    }
}

/// A run that has ended.
fn run(dir: &Path) -> Result<Box<dyn Source>, Fault> {
    check_results(dir)?;
    Ok(Box::new(Rerun::open(dir)?))
}

/// Checks that a folder has the results of a run.
fn check_results(dir: &Path) -> Result<(), Fault> {
    if dir.join(SCENARIO).is_file() {
        return Ok(());
    }
    let what = "this folder has no results of a run";
    Err(Fault::new(dir.display(), what, "give the folder that laneweave run has written"))
}
