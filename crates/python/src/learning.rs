//! The class `Batch`, of which the environments of `laneweave.gym` are made.

use std::sync::{Arc, Mutex};

use laneweave::scenario::read_map;
use laneweave::{Simulation as Simulated, VehicleId};
use laneweave_learning::{Autoreset, Choice, Part, Results, TERMS, Task};
use laneweave_viewer::Surroundings;
use numpy::{PyReadonlyArray2, PyReadwriteArray1, PyReadwriteArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors::{Failure, detached, locked, refused};
use crate::keys::{Asked, Given, fitting};
use crate::simulation::Simulation;
use crate::template::Template;
use crate::values::{given, named, to_python};

/// Many worlds in which a program learns to drive one vehicle.
#[pyclass(frozen, module = "laneweave")]
pub(crate) struct Batch {
    held: Mutex<laneweave_learning::Batch>,
    parts: Vec<Part>,
    populations: Vec<String>,
    around: Arc<Surroundings>,
}

impl Batch {
    fn with<T: Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&mut laneweave_learning::Batch) -> Result<T, Failure> + Send,
    ) -> PyResult<T> {
        detached(py, || work(&mut *locked(&self.held, "environment")?))
    }
}

/// Templates by the names of populations.
type Named = Vec<(String, laneweave::Template)>;

/// Templates of the populations, with what the map has beside its network.
fn populations(asked: Vec<(String, Asked)>) -> Result<(Named, Arc<Surroundings>), Failure> {
    let mut around = None;
    let mut templates = Vec::new();
    for (name, asked) in asked {
        let (mut scenario, origin) = asked.read()?;
        scenario.run.audit = true;
        let map = read_map(&scenario, &origin)?;
        around = Some(Arc::new(Surroundings::of(&map)));
        templates.push((name, Simulated::from_scenario_on(map, &scenario, &origin)?.into_template()));
    }
    let around = around.ok_or_else(|| refused("populations", "there are none", "give one or more"))?;
    Ok((templates, around))
}

#[pymethods]
impl Batch {
    /// `sources` are keyword arguments by the name of a population.
    #[new]
    #[pyo3(signature = (source, populations, task, seeds, threads = 1, autoreset = "next_step", changes = false))]
    #[expect(clippy::too_many_arguments, reason = "they are named in Python")]
    fn new(
        py: Python<'_>,
        source: Bound<'_, PyAny>,
        populations: Vec<(String, Bound<'_, PyDict>)>,
        task: &Bound<'_, PyDict>,
        seeds: Vec<u64>,
        threads: usize,
        autoreset: &str,
        changes: bool,
    ) -> PyResult<Batch> {
        let task = given("task", task)?;
        let autoreset: Autoreset = named("autoreset", autoreset).map_err(|it| it.raise(py))?;
        let mut asked = Vec::new();
        for (name, keys) in populations {
            asked.push((name, Asked::new(py, source.extract::<Given<'_>>()?, Some(&keys))?));
        }
        detached(py, || {
            let task: Task = fitting(task)?;
            let (templates, around) = self::populations(asked)?;
            let mut batch =
                laneweave_learning::Batch::new(templates, task, &seeds, threads)?.with_autoreset(autoreset);
            if changes {
                batch = batch.with_changes();
            }
            let parts = batch.task().observation.parts();
            let populations = batch.populations().map(str::to_owned).collect();
            Ok(Batch { held: Mutex::new(batch), parts, populations, around })
        })
    }

    /// The parts of an observation: name, shape and columns of each.
    #[getter]
    fn parts(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        to_python(py, &self.parts)
    }

    /// The names of the terms of the reward.
    #[classattr]
    #[expect(non_snake_case, reason = "a constant in Python")]
    fn TERMS() -> Vec<&'static str> {
        TERMS.to_vec()
    }

    /// The names of the discrete actions.
    #[classattr]
    #[expect(non_snake_case, reason = "a constant in Python")]
    fn CHOICES() -> Vec<&'static str> {
        Choice::NAMES.to_vec()
    }

    /// The task, with all its values.
    #[getter]
    fn task(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        let task = self.with(py, |it| Ok(it.task().clone()))?;
        to_python(py, &task)
    }

    /// The name of the population in each world.
    #[getter]
    fn populations(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        let numbers: Vec<usize> =
            self.with(py, |it| (0..it.len()).map(|number| Ok(it.population(number)?)).collect())?;
        Ok(numbers.into_iter().map(|it| self.populations[it].clone()).collect())
    }

    /// Begins the next episodes where `mask` is true: the first one of a seed where one is given.
    fn reset(
        &self,
        py: Python<'_>,
        seeds: Vec<Option<u64>>,
        mask: Vec<bool>,
        mut observations: PyReadwriteArray2<'_, f32>,
    ) -> PyResult<()> {
        let seeds: Vec<Option<Option<u64>>> =
            seeds.into_iter().zip(mask).map(|(seed, is_reset)| is_reset.then_some(seed)).collect();
        let observations = observations.as_slice_mut()?;
        self.with(py, |it| Ok(it.reset(&seeds, observations)?))
    }

    /// Acts in all worlds, and fills the arrays.
    #[expect(clippy::too_many_arguments, reason = "they are named in Python")]
    fn act(
        &self,
        py: Python<'_>,
        actions: PyReadonlyArray2<'_, f64>,
        mut observations: PyReadwriteArray2<'_, f32>,
        mut last_observations: PyReadwriteArray2<'_, f32>,
        mut rewards: PyReadwriteArray1<'_, f64>,
        mut terms: PyReadwriteArray2<'_, f64>,
        mut terminated: PyReadwriteArray1<'_, bool>,
        mut truncated: PyReadwriteArray1<'_, bool>,
    ) -> PyResult<()> {
        let actions = actions.as_slice()?.to_vec();
        let results = Results {
            observations: observations.as_slice_mut()?,
            last_observations: last_observations.as_slice_mut()?,
            rewards: rewards.as_slice_mut()?,
            terms: terms.as_slice_mut()?,
            terminated: terminated.as_slice_mut()?,
            truncated: truncated.as_slice_mut()?,
        };
        self.with(py, |it| Ok(it.act(&actions, results)?))
    }

    /// The lane changes around the ego of a world in the steps of the last action, if it keeps them.
    fn changes(&self, py: Python<'_>, number: usize) -> PyResult<Py<PyAny>> {
        let changes = self.with(py, |it| Ok(it.changes(number)?.to_vec()))?;
        to_python(py, &changes)
    }

    /// The vehicle that the program drives in a world.
    fn ego(&self, py: Python<'_>, number: usize) -> PyResult<VehicleId> {
        self.with(py, |it| Ok(it.simulation(number)?.1))
    }

    /// A simulation that goes on from where a world is.
    fn simulation(&self, py: Python<'_>, number: usize) -> PyResult<Simulation> {
        self.with(py, |it| {
            let made = it.copy(number)?.into_template();
            let seed = made.scenario().run.seed;
            Simulation::spawned(&Template { made, around: Arc::clone(&self.around) }, seed)
        })
    }
}
