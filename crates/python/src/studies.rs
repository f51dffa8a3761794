//! Studies: models compared, styles fitted, recordings replayed.

use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::thread::available_parallelism;

use laneweave::maps::FileKind;
use laneweave::scenario::{Origin, Replay};
use laneweave::style::Model;
use laneweave::{Fault, FaultKind, Simulation};
use laneweave_studies::compare::{ComparisonFiles, USUAL, seeds_from};
use laneweave_studies::fit::{Request, Rollouts};
use laneweave_studies::replay::{self, Asked as AskedReplay};
use laneweave_studies::{compare, fit};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde::Deserialize;
use serde_json::Value;

use crate::errors::Failure;
use crate::keys::{Asked, Given, Keys, fitting};
use crate::run::{COMMAND, left, share};
use crate::task::{Task, watched};
use crate::values::{given, named, plain, to_python};

fn wrong(place: &str, what: &str, remedy: &str) -> Failure {
    Fault::new(place, what, remedy).of_kind(FaultKind::Value).into()
}

fn threads() -> usize {
    available_parallelism().map_or(1, NonZero::get)
}

fn models(names: Option<Vec<String>>, usual: &[Model]) -> Result<Vec<Model>, Failure> {
    names.map_or(Ok(usual.to_vec()), |it| it.iter().map(|name| named("models", name)).collect())
}

/// Runs each of the `sources` with each of the models and so many seeds, writes the report and the table of all runs
/// into the folder `out`, and returns the comparisons in words and the paths of report and table.
#[pyfunction]
#[pyo3(signature = (sources, out, models = None, seeds = 10, progress = None, **keys))]
pub(crate) fn compare_models(
    py: Python<'_>,
    sources: Vec<Given<'_>>,
    out: PathBuf,
    models: Option<Vec<String>>,
    seeds: u64,
    progress: Option<Py<PyAny>>,
    keys: Option<&Bound<'_, PyDict>>,
) -> PyResult<(String, [PathBuf; 2])> {
    let asked = sources.into_iter().map(|it| Asked::new(py, it, keys)).collect::<PyResult<Vec<Asked>>>()?;
    watched(py, progress.as_ref(), move |task| compared(asked, &out, models, seeds, task))
}

fn compared(
    asked: Vec<Asked>,
    out: &Path,
    names: Option<Vec<String>>,
    seeds: u64,
    task: &Task,
) -> Result<(String, [PathBuf; 2]), Failure> {
    let models = models(names, &USUAL)?;
    let mut inputs = Vec::new();
    for it in asked {
        let name = it.source.display().to_string();
        let (scenario, origin) = it.read()?;
        // Nothing runs before everything has been checked.
        Simulation::from_scenario(&scenario, &origin)?;
        let seeds = seeds_from(scenario.run.seed, seeds)?;
        inputs.push((name, scenario, origin, seeds));
    }
    if inputs.is_empty() || models.is_empty() || seeds == 0 {
        return Err(wrong("compare", "nothing to compare", "give scenarios, models and seeds"));
    }
    let mut files = ComparisonFiles::begin(out)?;
    let (mut text, count) = (String::new(), inputs.len() as f64);
    for (done, (name, scenario, origin, seeds)) in inputs.into_iter().enumerate() {
        let goes_on = |share: f64| {
            task.has_done((done as f64 + share) / count);
            !task.is_stopped()
        };
        let comparison = compare::compare(&scenario, &origin, &models, &seeds, threads(), goes_on)?;
        text += &comparison.to_titled_text(&name, scenario.run.duration_s);
        files.add(name, comparison)?;
    }
    Ok((text, files.finish(COMMAND)?))
}

/// What a fit leaves.
#[derive(IntoPyObject)]
pub(crate) struct Fitted {
    found: Py<PyAny>,
    text: String,
    styles: Vec<PathBuf>,
    warnings: Vec<String>,
}

/// Fits styles to recordings, writes them with the report into the folder `out`, and returns what was found, in words,
/// the paths of the styles, and warnings.
#[pyfunction]
#[pyo3(signature = (recordings, out, keys, progress = None))]
pub(crate) fn fit_styles(
    py: Python<'_>,
    recordings: Vec<PathBuf>,
    out: PathBuf,
    keys: &Bound<'_, PyDict>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Fitted> {
    let keys = given("fit", keys)?;
    let (found, text, styles, warnings) = watched(py, progress.as_ref(), move |task| {
        let request = Request { recordings, ..fitting(keys)? };
        let observed = request.observe()?;
        let warnings = observed.problems().iter().map(ToString::to_string).collect();
        let judged = request.judge.map(|count| {
            let rollouts = Rollouts { count, threads: threads() };
            observed.judge(&rollouts, &|share| task.has_done(share))
        });
        let report: fit::FitReport = observed.fit_beside(judged.transpose()?.flatten())?;
        if task.is_stopped() {
            return Err(Fault::new("fit", "it was interrupted", "fit again")
                .of_kind(FaultKind::State)
                .into());
        }
        let styles = report.write(&out, &request.recordings, COMMAND)?;
        Ok((plain(&report)?, report.to_text(), styles, warnings))
    })?;
    Ok(Fitted { found: to_python(py, &found)?, text, styles, warnings })
}

/// How a recording is replayed: what `laneweave replay` takes as options.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ReplayKeys {
    map: Option<PathBuf>,
    columns: Option<PathBuf>,
    reactive_share: f64,
    reactive_ids: Vec<i64>,
    reactive_from_s: f64,
    rollouts: u64,
    models: Option<Vec<String>>,
}

/// What a replay leaves.
#[derive(IntoPyObject)]
pub(crate) struct Replayed {
    summary: Py<PyAny>,
    files: Vec<PathBuf>,
    warnings: Vec<String>,
    found: Py<PyAny>,
    text: String,
}

/// Replays recordings with its results in the folder `out`, compares its drivers with what was recorded of them, and
/// returns the summary, the names of the files, warnings, and the report as data and in words.
#[pyfunction]
#[pyo3(signature = (recordings, out, how, keys, progress = None))]
pub(crate) fn replay_recordings(
    py: Python<'_>,
    recordings: Vec<PathBuf>,
    out: PathBuf,
    how: &Bound<'_, PyDict>,
    keys: &Bound<'_, PyDict>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Replayed> {
    let how = given("replay", how)?;
    let keys = Keys::new(py, Some(keys))?;
    let ((summary, files, warnings), report, text) = watched(py, progress.as_ref(), move |task| {
        let how: ReplayKeys = fitting(how)?;
        replayed(recordings, out, how, keys, task)
    })?;
    Ok(Replayed { summary: to_python(py, &summary)?, files, warnings, found: to_python(py, &report)?, text })
}

fn replayed(
    recordings: Vec<PathBuf>,
    out: PathBuf,
    how: ReplayKeys,
    keys: Keys,
    task: &Task,
) -> Result<(crate::run::Left, Value, String), Failure> {
    if !(1..=1000).contains(&how.rollouts) {
        return Err(wrong("rollouts", "it is out of range", "choose 1 to 1000"));
    }
    if recordings.is_empty() {
        return Err(wrong("recordings", "there is none", "name a file"));
    }
    let has_map = |it: &&PathBuf| FileKind::of(it).has_tracks();
    let map = how.map.or_else(|| recordings.first().filter(has_map).cloned());
    let map = map.ok_or_else(|| {
        let place = recordings.first().map_or(String::new(), |it| it.display().to_string());
        Fault::new(place, "a recording needs the map of its location", "name it with map=")
    })?;
    let asked = AskedReplay {
        rollouts: how.rollouts,
        models: models(how.models, &replay::USUAL)?,
        threads: threads(),
    };
    let replay = Replay {
        recording: recordings.clone(),
        columns: how.columns,
        reactive_share: how.reactive_share,
        reactive_ids: how.reactive_ids,
        reactive_from_s: how.reactive_from_s,
    };
    let (mut scenario, notes) = replay::scenario(map, replay)?;
    scenario.output.dir = out;
    let (mut scenario, origin) = keys.put(&scenario, Origin::default())?;
    // A map that was read brings all its options along; a replay joins ends, as the command does.
    scenario.map_options.joins_ends = true;
    let show = |it: &Simulation| task.has_done(share(it));
    let done = replay::replay(&scenario, &origin, &asked, COMMAND, show, || task.is_stopped())?;
    let Some((report, _)) = done.write(&scenario.output.dir, &recordings, COMMAND)? else {
        return Err(Fault::new("replay", "it was interrupted", "replay again")
            .of_kind(FaultKind::State)
            .into());
    };
    let (report, text) = (plain(report)?, report.to_text());
    let (summary, files, warnings) = left(done.results)?;
    Ok(((summary, files, notes.into_iter().chain(warnings).collect()), report, text))
}
