//! The class `Template`.

use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors::detached;
use crate::keys::{Asked, Given};
use crate::simulation::Simulation;
use crate::values::to_python;

/// A scenario of which many simulations are made, each with a seed of its own.
#[pyclass(frozen, module = "laneweave")]
pub(crate) struct Template {
    pub(crate) made: laneweave::Template,
}

/// A template of the scenario or the map `source`.
pub(crate) fn template(
    py: Python<'_>,
    source: Given<'_>,
    keys: Option<&Bound<'_, PyDict>>,
) -> PyResult<laneweave::Template> {
    let asked = Asked::new(source, keys)?;
    detached(py, || {
        let (scenario, origin) = asked.read()?;
        Ok(laneweave::Simulation::from_scenario(&scenario, &origin)?.into_template()?)
    })
}

#[pymethods]
impl Template {
    #[new]
    #[pyo3(signature = (source, **keys))]
    fn new(py: Python<'_>, source: Given<'_>, keys: Option<&Bound<'_, PyDict>>) -> PyResult<Template> {
        Ok(Template { made: template(py, source, keys)? })
    }

    /// A simulation at its start, with this seed of all random numbers.
    fn spawn(&self, py: Python<'_>, seed: u64) -> PyResult<Simulation> {
        detached(py, || Simulation::spawned(self.made.clone(), seed))
    }

    /// The scenario as a dict, with the keys of a scenario file.
    #[getter]
    fn scenario(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        to_python(py, self.made.scenario())
    }
}
