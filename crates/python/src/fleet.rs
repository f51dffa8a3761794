//! The class `Fleet`.

use std::sync::Mutex;

use laneweave::{Fault, Rows, VehicleId};
use numpy::{PyReadonlyArray1, PyReadwriteArray1, PyReadwriteArray3, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::control::control;
use crate::errors::{Failure, detached, locked};
use crate::id::GivenId;
use crate::template::Template;
use crate::values::Signals;

/// Many simulations of one template, stepped together on one pool of threads.
#[pyclass(frozen, module = "laneweave")]
pub(crate) struct Fleet {
    held: Mutex<laneweave::Fleet>,
    size: usize,
    lanelets: Vec<GivenId>,
}

/// Steps between two looks at signals.
const STEPS: u32 = 16;

impl Fleet {
    fn with<T: Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&mut laneweave::Fleet) -> Result<T, Failure> + Send,
    ) -> PyResult<T> {
        detached(py, || work(&mut *locked(&self.held, "fleet")?))
    }
}

#[pymethods]
impl Fleet {
    #[new]
    #[pyo3(signature = (template, seeds, threads = 1))]
    fn new(py: Python<'_>, template: &Template, seeds: Vec<u64>, threads: usize) -> PyResult<Fleet> {
        detached(py, || {
            let fleet = laneweave::Fleet::new(&template.made, seeds, threads)?;
            let lanelets = template.made.spawn(0)?.lanelets().into_iter().map(GivenId).collect();
            Ok(Fleet { size: fleet.len(), held: Mutex::new(fleet), lanelets })
        })
    }

    /// Number of simulations.
    fn __len__(&self) -> usize {
        self.size
    }

    /// Simulates so many steps of each.
    #[pyo3(signature = (steps = 1))]
    fn step(&self, py: Python<'_>, steps: u32) -> PyResult<()> {
        self.with(py, |it| {
            let mut signals = Signals::new();
            let mut left = steps;
            while left > 0 {
                let now = left.min(STEPS);
                it.step(now);
                left -= now;
                signals.check()?;
            }
            Ok(())
        })
    }

    /// The ids of all lanelets: the column `lanelet_index` has places in this list.
    #[getter]
    fn lanelets(&self) -> Vec<GivenId> {
        self.lanelets.clone()
    }

    /// Lets one of the simulations begin anew with this seed.
    fn reset(&self, py: Python<'_>, number: usize, seed: u64) -> PyResult<()> {
        self.with(py, |it| Ok(it.reset(number, seed)?))
    }

    /// The hashes of the traffic of all simulations.
    #[getter]
    fn state_hashes(&self, py: Python<'_>) -> PyResult<Vec<u64>> {
        self.with(py, |it| Ok(it.simulations().iter().map(laneweave::Simulation::state_hash).collect()))
    }

    /// Drives the vehicle of each simulation at these speeds [m/s]; a speed that is no number leaves it to its driver.
    #[pyo3(signature = (vehicles, speed_mps, lateral = "driver"))]
    fn control(
        &self,
        py: Python<'_>,
        vehicles: PyReadonlyArray1<'_, VehicleId>,
        speed_mps: PyReadonlyArray1<'_, f64>,
        lateral: &str,
    ) -> PyResult<()> {
        let (vehicles, speeds) = (vehicles.as_slice()?.to_vec(), speed_mps.as_slice()?.to_vec());
        let lateral = lateral.to_owned();
        self.with(py, move |it| {
            for (name, length) in [("vehicles", vehicles.len()), ("speed_mps", speeds.len())] {
                if length != it.len() {
                    let what = format!("{name} has {length} places");
                    return Err(Fault::new("fleet", what, format!("give it {}", it.len())).into());
                }
            }
            let controls: Result<Vec<_>, Failure> = vehicles
                .iter()
                .zip(&speeds)
                .enumerate()
                .map(|(number, (id, speed))| {
                    let speed = Some(*speed).filter(|it| !it.is_nan());
                    Ok((number, *id, control(speed, None, None, &lateral)?))
                })
                .collect();
            Ok(it.control(&controls?)?)
        })
    }

    /// Fills the arrays with the vehicles of all simulations, one simulation after the other, and `counts` with how
    /// many each has. Returns how many there are.
    #[expect(clippy::too_many_arguments, reason = "they are named in Python")]
    fn columns(
        &self,
        py: Python<'_>,
        mut counts: PyReadwriteArray1<'_, u32>,
        mut vehicle: PyReadwriteArray1<'_, VehicleId>,
        mut lanelet_index: PyReadwriteArray1<'_, u32>,
        mut position_m: PyReadwriteArray1<'_, f64>,
        mut speed_mps: PyReadwriteArray1<'_, f64>,
        mut acceleration_mps2: PyReadwriteArray1<'_, f32>,
    ) -> PyResult<usize> {
        let rows = Rows {
            id: vehicle.as_slice_mut()?,
            lanelet: lanelet_index.as_slice_mut()?,
            position_m: position_m.as_slice_mut()?,
            speed_mps: speed_mps.as_slice_mut()?,
            acceleration_mps2: acceleration_mps2.as_slice_mut()?,
            ..Rows::default()
        };
        let counts = counts.as_slice_mut()?;
        self.with(py, |it| Ok(it.columns(rows, counts)?))
    }

    /// Fills `sight`, an array (simulations, 1 + nearest, len(SIGHT_COLUMNS)), with what the vehicle of each simulation
    /// sees: itself first, then the others, the nearest first.
    fn sight(
        &self,
        py: Python<'_>,
        vehicles: PyReadonlyArray1<'_, VehicleId>,
        mut sight: PyReadwriteArray3<'_, f32>,
    ) -> PyResult<()> {
        let shape = [sight.shape()[0], sight.shape()[1], sight.shape()[2]];
        let wanted = laneweave::SIGHT_COLUMNS.len();
        if shape[1] == 0 || shape[2] != wanted || shape[0] != self.size {
            let what = format!("sight has the shape {shape:?}");
            let remedy = format!("give it ({}, 1 + nearest, {wanted})", self.size);
            return Err(Failure::Fault(Fault::new("fleet", what, remedy)).raise(py));
        }
        let (vehicles, numbers) = (vehicles.as_slice()?.to_vec(), sight.as_slice_mut()?);
        self.with(py, |it| Ok(it.sight(&vehicles, shape[1] - 1, numbers)?))
    }
}
