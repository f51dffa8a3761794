//! The class `Map`.

use std::path::PathBuf;

use laneweave::maps::Sense;
use laneweave::network::{Lanelet, Polyline};
use laneweave::scenario::{MapOptions, open_map};
use laneweave::{Fault, FaultKind, Id};
use laneweave_studies::check::{GraphJson, Report, picture};
use laneweave_studies::routes::ways;
use numpy::{PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors::{Failure, detached};
use crate::id::GivenId;
use crate::keys::fitting;
use crate::values::{given, plain, to_python};

/// A map that was read: its lanelets, what is wrong with it, and the ways through it.
#[pyclass(frozen, module = "laneweave")]
pub(crate) struct Map {
    pub(crate) path: PathBuf,
    pub(crate) options: MapOptions,
    read: laneweave::maps::Map,
}

impl Map {
    fn lanelet(&self, id: Id) -> Result<&Lanelet, Failure> {
        self.read.network.lanelets.iter().find(|it| it.id == id).ok_or_else(|| {
            let what = format!("this map has no lanelet {id} for vehicles");
            Fault::new("map", what, "choose one of its lanelets").of_kind(FaultKind::NotFound).into()
        })
    }
}

/// The points of a line, in a row each.
fn points<'py>(py: Python<'py>, line: &Polyline) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let numbers: Vec<f64> = line.points().iter().flat_map(|it| [it.x, it.y, it.z]).collect();
    crate::values::array(py, numbers).reshape([line.points().len(), 3])
}

#[pymethods]
impl Map {
    #[new]
    #[pyo3(signature = (path, **options))]
    fn new(py: Python<'_>, path: PathBuf, options: Option<&Bound<'_, PyDict>>) -> PyResult<Map> {
        let options = options.map(|it| given("options", it)).transpose()?;
        detached(py, || {
            let options: MapOptions = options.map_or(Ok(MapOptions::default()), fitting)?;
            let read = open_map(&path, &options)?;
            Ok(Map { path, options, read })
        })
    }

    /// The file.
    #[getter]
    fn path(&self) -> PathBuf {
        self.path.clone()
    }

    /// How it was read, with the keys of a scenario's table map_options.
    #[getter]
    fn options(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        to_python(py, &self.options)
    }

    /// The ids of all lanelets for vehicles.
    #[getter]
    fn lanelets(&self) -> Vec<GivenId> {
        self.read.network.lanelets.iter().map(|it| GivenId(it.id)).collect()
    }

    /// The borders and the centre line of a lanelet.
    fn lines<'py>(&self, py: Python<'py>, lanelet: GivenId) -> PyResult<Bound<'py, PyDict>> {
        let lanelet = self.lanelet(lanelet.0).map_err(|it| it.raise(py))?;
        let dict = PyDict::new(py);
        dict.set_item("left", points(py, &lanelet.left_border)?)?;
        dict.set_item("right", points(py, &lanelet.right_border)?)?;
        dict.set_item("centre", points(py, &lanelet.centre)?)?;
        Ok(dict)
    }

    /// The routing graph, by the ids of the lanelets.
    fn graph(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        let graph = detached(py, || plain(&GraphJson(&self.read)))?;
        to_python(py, &graph)
    }

    /// What the map contains, and the problems in it.
    fn check(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        let report = detached(py, || plain(&Report::of(&self.read)))?;
        to_python(py, &report)
    }

    /// The sensible routes from one lanelet to another, the fastest first.
    #[pyo3(signature = (from_lanelet, to_lanelet, *, most = Sense::default().most, longest = Sense::default().longest))]
    fn routes(
        &self,
        py: Python<'_>,
        from_lanelet: GivenId,
        to_lanelet: GivenId,
        most: usize,
        longest: f64,
    ) -> PyResult<Py<PyAny>> {
        let found = detached(py, || {
            if most == 0 || longest.is_nan() || longest < 1.0 {
                let what = format!("most={most}, longest={longest}");
                let remedy = "choose 1 or more for both";
                return Err(Fault::new("routes", what, remedy).of_kind(FaultKind::Value).into());
            }
            Ok(ways(&self.read, from_lanelet.0, to_lanelet.0, Sense { most, longest })?)
        })?;
        to_python(py, &found)
    }

    /// A picture of the map, with its problems.
    fn svg(&self, py: Python<'_>) -> PyResult<String> {
        let name = self.path.file_name().unwrap_or_default().to_string_lossy();
        detached(py, || Ok(picture(&name, &self.read, &Report::of(&self.read).problems)))
    }

    fn _repr_svg_(&self, py: Python<'_>) -> PyResult<String> {
        self.svg(py)
    }

    fn __repr__(&self) -> String {
        format!("<laneweave.Map {}: {} lanelets>", self.path.display(), self.read.network.lanelets.len())
    }
}
