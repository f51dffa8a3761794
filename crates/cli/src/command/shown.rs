//! What is shown: by `laneweave view` in the browser, by `laneweave render` as pictures.

use std::path::{Path, PathBuf};

use clap::{Args, ValueHint};
use laneweave::Fault;
use laneweave::maps::FileKind;
use laneweave::record::SCENARIO;
use laneweave::scenario::{Origin, open_map};
use laneweave_studies::branch::Setting;
use laneweave_studies::check::tracks;
use laneweave_viewer::{Live, Recorded, Rerun, Source};

use super::check::Reading;

/// Traffic that is shown.
#[derive(Debug, Args)]
pub(super) struct Shown {
    /// A scenario (.toml) or a map to simulate, the folder with the results of a run, or with --map a recording
    /// (several that continue one another are joined) [default: the demo].
    #[arg(value_name = "SCENARIO|MAP|OUT|RECORDING", value_hint = ValueHint::AnyPath)]
    input: Vec<PathBuf>,
    /// The map of the recording.
    #[arg(long, value_name = "MAP", value_hint = ValueHint::FilePath, requires = "input")]
    map: Option<PathBuf>,
    /// A TOML file that says what the columns of the recording hold.
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath, requires = "map")]
    columns: Option<PathBuf>,
    #[command(flatten)]
    options: Reading,
}

impl Shown {
    /// It. What is done by hand in a simulation is saved in folders inside `saved`.
    ///
    /// # Errors
    /// If something is missing, not readable, or invalid.
    pub(super) fn source(&self, saved: &Path) -> Result<Box<dyn Source>, Fault> {
        if let Some(map) = &self.map {
            let options = self.options.options();
            return Ok(Box::new(Recorded::open(&self.input, map, self.columns.as_deref(), &options)?));
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
    pub(super) fn twins(&self, at: f64, settings: &[Setting]) -> Result<Box<dyn Source>, Fault> {
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
        let options = self.options.options();
        if !matches!(FileKind::by_name(path), FileKind::Toml) {
            scenario.map_options = options;
        } else if options.driving_side.is_some() {
            scenario.map_options.driving_side = options.driving_side;
        }
        Ok(Box::new(Live::new(&scenario, &origin, saved.to_owned())?))
    }

    /// A CommonRoad file may contain a recording beside its map.
    fn common_road(&self, path: &Path, saved: &Path) -> Result<Box<dyn Source>, Fault> {
        let map = open_map(path, &self.options.options())?;
        match tracks(path)? {
            Some((recording, _)) => {
                let title = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
                Ok(Box::new(Recorded::new(title, &map, recording)?))
            }
            None => self.simulated(path, saved),
        }
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
