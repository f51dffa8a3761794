//! A run with all its result files.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use laneweave::run::Run;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors::{Failure, detached};
use crate::keys::Asked;
use crate::values::to_python;

/// The command line that is kept with the results.
const COMMAND: &str = "run by a program in Python, with the package laneweave";
/// Time between two calls of the progress.
const EVERY: Duration = Duration::from_millis(100);

/// Runs the scenario or the map `source` to its end, writes all result files into the folder `out`, and returns the
/// summary and the names of the files. `progress` is called with the share that is done, several times a second.
#[pyfunction]
#[pyo3(signature = (source, out, progress = None, **keys))]
pub(crate) fn run<'py>(
    py: Python<'py>,
    source: PathBuf,
    out: PathBuf,
    progress: Option<Py<PyAny>>,
    keys: Option<&Bound<'py, PyDict>>,
) -> PyResult<(Py<PyAny>, Vec<PathBuf>, Vec<String>)> {
    let asked = Asked::new(source, keys)?;
    let results = detached(py, || {
        let (mut scenario, origin) = asked.read()?;
        scenario.output.dir = out;
        let mut last = Instant::now();
        Run::begin(&scenario, &origin, COMMAND)?.drive(|simulation| -> Result<bool, Failure> {
            if last.elapsed() >= EVERY {
                last = Instant::now();
                let share = simulation.time_s() / simulation.end_s();
                Python::attach(|py| {
                    py.check_signals()?;
                    progress.as_ref().map_or(Ok(()), |it| it.call1(py, (share,)).map(drop))
                })?;
            }
            Ok(true)
        })
    })?;
    Ok((to_python(py, &results.summary)?, results.files, results.warnings))
}
