//! A run with all its result files.

use std::path::PathBuf;

use laneweave::Simulation;
use laneweave::run::{Results, Run};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::Value;

use crate::errors::Failure;
use crate::keys::{Asked, Given};
use crate::task::watched;
use crate::values::{plain, to_python};

/// The command line that is kept with results.
pub(crate) const COMMAND: &str = "a program in Python, with the package laneweave";

/// What a run leaves, as plain data: its summary, the names of its files, and its warnings.
pub(crate) type Left = (Value, Vec<PathBuf>, Vec<String>);

/// What a run has left.
pub(crate) fn left(results: Results) -> Result<Left, Failure> {
    Ok((plain(&results.summary)?, results.files, results.warnings))
}

/// The share of a run that is done.
pub(crate) fn share(simulation: &Simulation) -> f64 {
    simulation.time_s() / simulation.end_s()
}

/// Runs the scenario or the map `source` to its end, writes all result files into the folder `out`, and returns the
/// summary, the names of the files and the warnings. `progress` is called with the share that is done, several times a
/// second.
#[pyfunction]
#[pyo3(signature = (source, out, progress = None, **keys))]
pub(crate) fn run(
    py: Python<'_>,
    source: Given<'_>,
    out: PathBuf,
    progress: Option<Py<PyAny>>,
    keys: Option<&Bound<'_, PyDict>>,
) -> PyResult<(Py<PyAny>, Vec<PathBuf>, Vec<String>)> {
    let asked = Asked::new(py, source, keys)?;
    let (summary, files, warnings) = watched(py, progress.as_ref(), move |task| {
        let (mut scenario, origin) = asked.read()?;
        scenario.output.dir = out;
        left(Run::begin(&scenario, &origin, COMMAND)?.complete(|simulation| {
            task.has_done(share(simulation));
            !task.is_stopped()
        })?)
    })?;
    Ok((to_python(py, &summary)?, files, warnings))
}
