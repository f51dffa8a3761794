//! The class `Simulation`.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::{Arc, Mutex};

use laneweave::{Class, Columns, Control, Event, NewVehicle, Parameter, VehicleId};
use laneweave_viewer::Surroundings;
use numpy::{IntoPyArray, PyArray3, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use serde::Serialize;

use crate::control::control;
use crate::errors::{Failure, detached, locked, refused};
use crate::id::GivenId;
use crate::keys::Given;
use crate::template::Template;
use crate::values::{Signals, named, to_python};
use crate::view::{GivenCamera, View, live, taken};

/// A simulation: traffic on a map, which a program steps through, asks, and changes.
#[pyclass(frozen, module = "laneweave")]
pub(crate) struct Simulation {
    /// `None` once it is closed.
    held: Mutex<Option<laneweave::Simulation>>,
    template: laneweave::Template,
    /// What the map has beside its network.
    around: Arc<Surroundings>,
}

impl Simulation {
    pub(crate) fn spawned(template: &Template, seed: u64) -> Result<Simulation, Failure> {
        let Template { made, around } = template;
        let held = Mutex::new(Some(made.spawn(seed)?));
        Ok(Simulation { held, template: made.clone(), around: Arc::clone(around) })
    }

    /// Another simulation in the same state.
    fn branched(&self, base: &laneweave::Simulation) -> Result<laneweave::Simulation, Failure> {
        let mut branch = self.template.spawn(base.scenario().run.seed)?;
        branch.take_state_of(base)?;
        Ok(branch)
    }

    /// Does `work` with the simulation, without the lock of the interpreter.
    fn with<T: Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&mut laneweave::Simulation) -> Result<T, Failure> + Send,
    ) -> PyResult<T> {
        detached(py, || {
            let mut held = locked(&self.held, "simulation")?;
            work(held.as_mut().ok_or_else(|| refused("simulation", "it is closed", "make a new one"))?)
        })
    }

    /// The same, for what cannot fail.
    fn ask<T: Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&laneweave::Simulation) -> T + Send,
    ) -> PyResult<T> {
        self.with(py, |it| Ok(work(it)))
    }

    /// The same, for plain data.
    fn tell<T: Serialize + Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&laneweave::Simulation) -> T + Send,
    ) -> PyResult<Py<PyAny>> {
        let told = self.ask(py, work)?;
        to_python(py, &told)
    }
}

#[pymethods]
impl Simulation {
    #[new]
    #[pyo3(signature = (source, **keys))]
    fn new(py: Python<'_>, source: Given<'_>, keys: Option<&Bound<'_, PyDict>>) -> PyResult<Simulation> {
        let template = Template::of(py, source, keys)?;
        let seed = template.made.scenario().run.seed;
        detached(py, || Simulation::spawned(&template, seed))
    }

    /// A template of simulations that go on from where this one is.
    fn template(&self, py: Python<'_>) -> PyResult<Template> {
        self.with(py, |it| {
            Ok(Template { made: self.branched(it)?.into_template(), around: Arc::clone(&self.around) })
        })
    }

    /// Simulates `count` steps, and returns what happened in them.
    #[pyo3(signature = (count = 1))]
    fn step(&self, py: Python<'_>, count: u32) -> PyResult<Py<PyAny>> {
        let events = self.with(py, |it| {
            let mut events: Vec<Event> = Vec::new();
            let mut signals = Signals::new();
            for _ in 0..count {
                events.extend(it.step());
                signals.check()?;
            }
            Ok(events)
        })?;
        to_python(py, &events)
    }

    /// Simulates steps until the time `until_s` [s], without their events.
    fn run(&self, py: Python<'_>, until_s: f64) -> PyResult<()> {
        self.with(py, |it| {
            let mut signals = Signals::new();
            it.observe::<Failure>(
                until_s,
                &mut [&mut |_: &laneweave::Simulation, _: &[Event]| signals.check()],
            )
        })
    }

    /// Begins anew with this seed; the drivers stay those of the template.
    fn reset(&self, py: Python<'_>, seed: u64) -> PyResult<()> {
        self.with(py, |it| Ok(it.reset(seed)?))
    }

    /// The present time [s].
    #[getter]
    fn time_s(&self, py: Python<'_>) -> PyResult<f64> {
        self.ask(py, laneweave::Simulation::time_s)
    }

    /// The time at which a run of the scenario ends [s].
    #[getter]
    fn end_s(&self, py: Python<'_>) -> PyResult<f64> {
        self.ask(py, laneweave::Simulation::end_s)
    }

    /// The length of a step [s].
    #[getter]
    fn step_s(&self, py: Python<'_>) -> PyResult<f64> {
        self.ask(py, laneweave::Simulation::step_s)
    }

    /// The scenario as a dict, with the keys of a scenario file.
    #[getter]
    fn scenario(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        self.tell(py, |it| it.scenario().clone())
    }

    /// The ids of all lanelets.
    #[getter]
    fn lanelets(&self, py: Python<'_>) -> PyResult<Vec<GivenId>> {
        self.ask(py, |it| it.lanelets().into_iter().map(GivenId).collect())
    }

    /// What each traffic light shows, by its id: green, yellow or red.
    #[getter]
    fn lights(&self, py: Python<'_>) -> PyResult<BTreeMap<String, &'static str>> {
        self.ask(py, |it| it.lights().into_iter().map(|it| (it.id.to_string(), it.state.name())).collect())
    }

    /// Where trips start, by the smallest lanelet id, with the demand there [veh/h].
    #[getter]
    fn origins(&self, py: Python<'_>) -> PyResult<Vec<(GivenId, f64)>> {
        self.ask(py, |it| it.origins().into_iter().map(|(id, demand)| (GivenId(id), demand)).collect())
    }

    /// Where trips can end, by the smallest lanelet id.
    #[getter]
    fn destinations(&self, py: Python<'_>) -> PyResult<Vec<GivenId>> {
        self.ask(py, |it| it.destinations().into_iter().map(GivenId).collect())
    }

    /// The styles with their weights.
    #[getter]
    fn styles(&self, py: Python<'_>) -> PyResult<Vec<(String, f64)>> {
        self.ask(py, |it| it.styles().into_iter().map(|it| (it.name, it.weight)).collect())
    }

    /// Number of vehicles on the road.
    fn __len__(&self, py: Python<'_>) -> PyResult<usize> {
        self.ask(py, laneweave::Simulation::on_road)
    }

    /// A hash of the traffic: two simulations with the same hash have the same traffic.
    #[getter]
    fn state_hash(&self, py: Python<'_>) -> PyResult<u64> {
        self.ask(py, laneweave::Simulation::state_hash)
    }

    /// Counts of vehicles, trips and lane changes since the end of the warm-up.
    #[getter]
    fn counts(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        self.tell(py, |it| *it.counts())
    }

    /// All vehicles on the road as dicts, in the order of their ids.
    fn vehicles(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        self.tell(py, laneweave::Simulation::vehicles)
    }

    /// A vehicle as a dict; None if it is not on the road.
    fn vehicle(&self, py: Python<'_>, id: VehicleId) -> PyResult<Py<PyAny>> {
        self.tell(py, |it| it.vehicle(id))
    }

    /// All vehicles as numpy arrays by the names of the columns of the table trajectories; with poses on request. The
    /// array lanelet_index has places in the list of all lanelets.
    #[pyo3(signature = (poses = false))]
    fn columns<'py>(&self, py: Python<'py>, poses: bool) -> PyResult<Bound<'py, PyDict>> {
        let columns = self.ask(py, |it| {
            let mut columns = if poses { Columns::with_poses() } else { Columns::default() };
            it.columns(&mut columns);
            columns
        })?;
        crate::columns::dict(py, columns, poses)
    }

    /// Puts a vehicle on the road, at once, and returns its id. Its own driver drives it.
    #[pyo3(signature = (lanelet, position_m, speed_mps, *, class_ = "car", style = None, destination = None))]
    #[expect(clippy::too_many_arguments, reason = "they are named in Python")]
    fn insert(
        &self,
        py: Python<'_>,
        lanelet: GivenId,
        position_m: f64,
        speed_mps: f64,
        class_: &str,
        style: Option<String>,
        destination: Option<GivenId>,
    ) -> PyResult<VehicleId> {
        let class: Class = named("class_", class_).map_err(|it| it.raise(py))?;
        self.with(py, |it| {
            let first = || it.styles().into_iter().next().map_or_else(String::new, |it| it.name);
            let style = style.unwrap_or_else(first);
            let (lanelet, destination) = (lanelet.0, destination.map(|it| it.0));
            Ok(it.insert(NewVehicle { lanelet, position_m, speed_mps, class, style, destination })?)
        })
    }

    /// Takes a vehicle off the road.
    fn remove(&self, py: Python<'_>, id: VehicleId) -> PyResult<()> {
        self.with(py, |it| Ok(it.remove(id)?))
    }

    /// Drives a vehicle in lanes until the next control: at a speed, with an acceleration, or as its driver does but no
    /// faster than a speed; and keeps its lane or changes to the "left" or the "right".
    #[pyo3(signature = (id, *, speed_mps = None, acceleration_mps2 = None, most_mps = None, lateral = "driver"))]
    fn control(
        &self,
        py: Python<'_>,
        id: VehicleId,
        speed_mps: Option<f64>,
        acceleration_mps2: Option<f64>,
        most_mps: Option<f64>,
        lateral: &str,
    ) -> PyResult<()> {
        let lateral = lateral.to_owned();
        self.with(py, move |it| {
            Ok(it.control(id, control(speed_mps, acceleration_mps2, most_mps, &lateral)?)?)
        })
    }

    /// Puts the centre of a vehicle at a pose at the end of the next step, and leaves it there.
    fn pose(
        &self,
        py: Python<'_>,
        id: VehicleId,
        x_m: f64,
        y_m: f64,
        heading_rad: f64,
        speed_mps: f64,
    ) -> PyResult<()> {
        let pose = Control::Pose { x: x_m, y: y_m, heading: heading_rad, speed: speed_mps };
        self.with(py, |it| Ok(it.control(id, pose)?))
    }

    /// Gives a vehicle back to its driver.
    fn release(&self, py: Python<'_>, id: VehicleId) -> PyResult<()> {
        self.with(py, |it| Ok(it.control(id, Control::DRIVER)?))
    }

    /// Gives the driver of a vehicle another style.
    fn set_style(&self, py: Python<'_>, id: VehicleId, style: String) -> PyResult<()> {
        self.with(py, |it| Ok(it.set_style(id, style)?))
    }

    /// Gives the driver of a vehicle another destination; None: it follows the road.
    #[pyo3(signature = (id, destination))]
    fn set_destination(&self, py: Python<'_>, id: VehicleId, destination: Option<GivenId>) -> PyResult<()> {
        self.with(py, |it| Ok(it.set_destination(id, destination.map(|it| it.0))?))
    }

    /// Sets the demand at an entrance from now on [veh/h].
    fn set_demand(&self, py: Python<'_>, origin: GivenId, vehicles_per_hour: f64) -> PyResult<()> {
        self.with(py, |it| Ok(it.set_demand(origin.0, vehicles_per_hour)?))
    }

    /// Sets the weight of a style among those of the drivers who arrive from now on.
    fn set_share(&self, py: Python<'_>, style: String, weight: f64) -> PyResult<()> {
        self.with(py, |it| Ok(it.set_share(style, weight)?))
    }

    /// Changes a number of a style for all of its drivers, such as "change.courtesy.weight".
    fn set_parameter(&self, py: Python<'_>, style: String, parameter: &str, value: f64) -> PyResult<()> {
        let parameter: Parameter = named("parameter", parameter).map_err(|it| it.raise(py))?;
        self.with(py, |it| Ok(it.set_parameter(style, parameter, value)?))
    }

    /// Closes a lanelet to all vehicles, or opens it again.
    #[pyo3(signature = (lanelet, is_closed = true))]
    fn close_lanelet(&self, py: Python<'_>, lanelet: GivenId, is_closed: bool) -> PyResult<()> {
        self.with(py, |it| Ok(it.close_lanelet(lanelet.0, is_closed)?))
    }

    /// What a driver makes of its lanes and is about to do, in words; None if it is not on the road.
    fn explain(&self, py: Python<'_>, id: VehicleId) -> PyResult<Option<String>> {
        self.ask(py, |it| it.explain(id))
    }

    /// The same as a dict, with the yield and weight of each incentive.
    fn evaluate(&self, py: Python<'_>, id: VehicleId) -> PyResult<Py<PyAny>> {
        self.tell(py, |it| it.evaluate(id))
    }

    /// All state of the traffic, as bytes.
    fn save<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let saved = self.with(py, |it| Ok(it.save()?))?;
        Ok(PyBytes::new(py, &saved))
    }

    /// Goes on from a saved state of a simulation of the same scenario and seed, bit for bit.
    fn restore(&self, py: Python<'_>, saved: &[u8]) -> PyResult<()> {
        let saved = saved.to_vec();
        self.with(py, move |it| Ok(it.restore(&saved)?))
    }

    /// Another simulation in the same state, which goes on by itself.
    fn branch(&self, py: Python<'_>) -> PyResult<Simulation> {
        self.with(py, |it| {
            let held = Mutex::new(Some(self.branched(it)?));
            Ok(Simulation { held, template: self.template.clone(), around: Arc::clone(&self.around) })
        })
    }

    /// A picture of the traffic as it is now, as PNG.
    #[pyo3(name = "_png")]
    fn png(&self, py: Python<'_>, camera: GivenCamera, size: [u32; 2]) -> PyResult<Py<PyBytes>> {
        let png = self.with(py, |it| Ok(taken(self.branched(it)?, &self.around, camera, size)?.to_png()?))?;
        Ok(PyBytes::new(py, &png).unbind())
    }

    /// The same as an array: height × width × red, green and blue.
    #[pyo3(name = "_pixels")]
    fn pixels<'py>(
        &self,
        py: Python<'py>,
        camera: GivenCamera,
        size: [u32; 2],
    ) -> PyResult<Bound<'py, PyArray3<u8>>> {
        let rgb = self.with(py, |it| taken(self.branched(it)?, &self.around, camera, size))?.to_rgb();
        rgb.into_pyarray(py).reshape([size[1] as usize, size[0] as usize, 3])
    }

    /// The page in the browser with a branch of it, which goes on by itself.
    #[pyo3(name = "_view")]
    fn view(&self, py: Python<'_>, saved: PathBuf, port: u16) -> PyResult<View> {
        self.with(py, |it| View::of(Box::new(live(self.branched(it)?, &self.around, &saved)), port))
    }

    /// Frees its memory. Nothing can be asked of it any more.
    fn close(&self, py: Python<'_>) -> PyResult<()> {
        detached(py, || {
            *locked(&self.held, "simulation")? = None;
            Ok(())
        })
    }

    /// It is there, also while nobody is on the road.
    fn __bool__(&self) -> bool {
        true
    }

    fn __enter__(this: Py<Simulation>) -> Py<Simulation> {
        this
    }

    #[pyo3(signature = (*_exception))]
    fn __exit__(&self, py: Python<'_>, _exception: &Bound<'_, pyo3::types::PyTuple>) -> PyResult<()> {
        self.close(py)
    }

    fn __repr__(&self, py: Python<'_>) -> String {
        let told = self.ask(py, |it| (it.scenario().map.display().to_string(), it.time_s(), it.on_road()));
        told.map_or_else(
            |_| "<laneweave.Simulation: closed or in use>".into(),
            |(map, time, count)| format!("<laneweave.Simulation of {map} at {time:.1} s: {count} vehicles>"),
        )
    }
}
