//! The class `Template`.

use std::sync::Arc;

use laneweave::scenario::read_map;
use laneweave_viewer::Surroundings;
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
    /// What the map has beside its network.
    pub(crate) around: Arc<Surroundings>,
}

impl Template {
    /// A template of the scenario or the map `source`.
    pub(crate) fn of(
        py: Python<'_>,
        source: Given<'_>,
        keys: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Template> {
        let asked = Asked::new(py, source, keys)?;
        detached(py, || {
            let (scenario, origin) = asked.read()?;
            let map = read_map(&scenario, &origin)?;
            let around = Arc::new(Surroundings::of(&map));
            let simulation = laneweave::Simulation::from_scenario_on(map, &scenario, &origin)?;
            Ok(Template { made: simulation.into_template(), around })
        })
    }
}

#[pymethods]
impl Template {
    #[new]
    #[pyo3(signature = (source, **keys))]
    fn new(py: Python<'_>, source: Given<'_>, keys: Option<&Bound<'_, PyDict>>) -> PyResult<Template> {
        Template::of(py, source, keys)
    }

    /// A simulation with this seed of all random numbers, which begins where the template is.
    fn spawn(&self, py: Python<'_>, seed: u64) -> PyResult<Simulation> {
        detached(py, || Simulation::spawned(self, seed))
    }

    /// The scenario as a dict, with the keys of a scenario file.
    #[getter]
    fn scenario(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        to_python(py, self.made.scenario())
    }
}
