//! Sweeps: the classes `SweepFolder`, which knows the runs of a sweep, and `SweepWorker`, which does them.

use std::ffi::OsString;
use std::fmt::Display;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};
use std::thread::available_parallelism;

use laneweave::Fault;
use laneweave_studies::sweep::{Processes, Shard, Sweep, Worker};
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors::{Failure, detached, locked};
use crate::task::watched;
use crate::values::given;

/// The name of a plan that is no file, in messages.
const PLAN: &str = "plan";

/// A value that cannot be used.
fn wrong(py: Python<'_>, place: &str, what: impl Display, remedy: &str) -> PyErr {
    Failure::from(Fault::new(place, what, remedy)).raise(py)
}

/// The `fault` of a plan that is no file: it has keys, but no lines. `text` has those that its place means.
fn of_keys(fault: Fault, text: &str) -> Fault {
    let place = fault.place.strip_prefix(PLAN).and_then(|it| it.strip_prefix(':'));
    let number = place.and_then(|it| it.split(':').next()?.parse::<usize>().ok());
    match number.and_then(|it| text.lines().nth(it.checked_sub(1)?)) {
        Some(line) => Fault { place: PLAN.into(), what: format!("{line}: {}", fault.what), ..fault },
        None => fault,
    }
}

/// A plan: a file, or its keys.
#[derive(FromPyObject)]
pub(crate) enum Plan<'py> {
    /// The keys of a plan.
    #[pyo3(transparent, annotation = "dict")]
    Keys(Bound<'py, PyDict>),
    /// A file.
    #[pyo3(transparent, annotation = "path")]
    File(PathBuf),
}

/// A sweep in its folder.
#[pyclass(frozen, module = "laneweave")]
pub(crate) struct SweepFolder {
    held: Arc<Sweep>,
}

#[pymethods]
impl SweepFolder {
    /// Begins a sweep in the folder `out`, or goes on with it.
    #[new]
    fn new(py: Python<'_>, plan: Plan<'_>, out: PathBuf) -> PyResult<SweepFolder> {
        let threads = available_parallelism().map_or(1, |it| it.get());
        let text = match &plan {
            Plan::Keys(keys) => {
                let keys = given(PLAN, keys)?;
                let text = toml::to_string(&keys);
                Some(text.map_err(|it| wrong(py, PLAN, it, "give numbers, texts, lists and dicts"))?)
            }
            Plan::File(_) => None,
        };
        let file = if let Plan::File(path) = plan { path } else { PathBuf::new() };
        let sweep = watched(py, None, move |task| {
            let goes_on = |_| !task.is_stopped();
            Ok(match text {
                Some(text) => Sweep::begin_text(&text, Path::new(PLAN), &out, threads, goes_on)
                    .map_err(|it| of_keys(it, &text))?,
                None => Sweep::begin(&file, &out, threads, goes_on)?,
            })
        })?;
        let held = sweep.ok_or_else(|| PyKeyboardInterrupt::new_err(()))?;
        Ok(SweepFolder { held: Arc::new(held) })
    }

    /// The number of all runs.
    #[getter]
    fn run_count(&self) -> usize {
        self.held.runs().len()
    }

    /// The keys of the runs that are not done; of part i of n with `shard` "i/n".
    #[pyo3(signature = (shard = None))]
    fn open_keys(&self, py: Python<'_>, shard: Option<&str>) -> PyResult<Vec<String>> {
        let part: Result<Shard, String> = shard.map_or_else(|| Ok(Shard::default()), str::parse);
        let part = part.map_err(|what| wrong(py, "shard", what, "write \"1/3\" for the first of three"))?;
        detached(py, || Ok(self.held.open_keys(part)?))
    }

    /// Does the runs with these keys, in as many processes as `workers`, each of which begins with `program`.
    #[pyo3(signature = (keys, program, workers, progress = None))]
    fn run(
        &self,
        py: Python<'_>,
        keys: Vec<String>,
        program: Vec<OsString>,
        workers: Option<usize>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<()> {
        let cores = available_parallelism().map_or(1, |it| it.get());
        let count = workers.unwrap_or(cores);
        if count == 0 {
            return Err(wrong(py, "workers", "there are none", "give 1 or more"));
        }
        let sweep = Arc::clone(&self.held);
        watched(py, progress.as_ref(), move |task| {
            let goes_on = |ended: usize| {
                task.has_done(ended as f64 / keys.len().max(1) as f64);
                !task.is_stopped()
            };
            Processes { program, count }.run(&sweep, &keys, goes_on)?;
            Ok(())
        })
    }

    /// Writes the tables of all runs and of all variants, and returns their paths and a few measures in words;
    /// `None` if not all runs are done.
    fn finish(&self, py: Python<'_>) -> PyResult<Option<(PathBuf, PathBuf, String)>> {
        detached(py, || Ok(self.held.finish()?.ok().map(|it| (it.runs, it.variants, it.text))))
    }
}

/// Does runs of a sweep that was begun.
#[pyclass(frozen, module = "laneweave")]
pub(crate) struct SweepWorker {
    held: Mutex<Worker>,
}

#[pymethods]
impl SweepWorker {
    /// Of the sweep in this folder.
    #[new]
    fn new(py: Python<'_>, folder: PathBuf) -> PyResult<SweepWorker> {
        let worker = detached(py, || Ok::<_, Failure>(Worker::of(Arc::new(Sweep::begun(&folder)?))))?;
        Ok(SweepWorker { held: Mutex::new(worker) })
    }

    /// Does the run with this key, and leaves its row in the folder.
    fn run(&self, py: Python<'_>, key: &str) -> PyResult<()> {
        detached(py, || Ok(locked(&self.held, "sweep")?.run(key)?))
    }
}
