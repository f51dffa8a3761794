//! The class `View`: the page in the browser.

use std::net::{Ipv4Addr, SocketAddr};
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use laneweave::Fault;
use laneweave::scenario::MapOptions;
use laneweave_viewer::{Camera, Doorway, Server, Shown, Source, Token};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::Value;

use crate::errors::{Failure, detached, locked};
use crate::keys::fitting;

/// The page in the browser: it is served until it is closed.
#[pyclass(frozen, module = "laneweave")]
pub(crate) struct View {
    /// `None` once it is closed.
    held: Mutex<Option<(Server, Doorway)>>,
    url: String,
    doorway: PathBuf,
}

impl View {
    /// Serves `source`; port 0 is any free one.
    pub(crate) fn of(source: Box<dyn Source>, port: u16) -> Result<View, Failure> {
        let address = SocketAddr::from((Ipv4Addr::LOCALHOST, port));
        let server = Server::start(source, address, Token::new())
            .map_err(|error| Fault::new(format!("view: {address}"), error, "choose another port"))?;
        let url = server.url();
        let doorway =
            Doorway::to(&url).map_err(|error| Fault::refused(&std::env::temp_dir(), "written", &error))?;
        let path = doorway.path().to_owned();
        Ok(View { held: Mutex::new(Some((server, doorway))), url, doorway: path })
    }
}

#[pymethods]
impl View {
    /// The address of the page. Whoever knows it can do there what you can do.
    #[getter]
    fn url(&self) -> &str {
        &self.url
    }

    /// A file that leads a browser to the page, and that only you can read.
    #[getter]
    fn doorway(&self) -> PathBuf {
        self.doorway.clone()
    }

    /// Whether it is closed.
    #[getter]
    fn is_closed(&self, py: Python<'_>) -> PyResult<bool> {
        detached(py, || Ok(locked(&self.held, "view")?.is_none()))
    }

    /// Ends the page.
    fn close(&self, py: Python<'_>) -> PyResult<()> {
        detached(py, || {
            drop(locked(&self.held, "view")?.take());
            Ok(())
        })
    }
}

/// A view of files: a scenario, a map, the folder of a run, or recordings.
#[pyfunction]
#[pyo3(signature = (input, map, columns, options, saved, port))]
pub(crate) fn view_files(
    py: Python<'_>,
    input: Vec<PathBuf>,
    map: Option<PathBuf>,
    columns: Option<PathBuf>,
    options: &Bound<'_, PyDict>,
    saved: PathBuf,
    port: u16,
) -> PyResult<View> {
    let options: Value = pythonize::depythonize(options)?;
    detached(py, || {
        let options: MapOptions = fitting(options)?;
        View::of(Shown { input, map, columns, options }.source(&saved)?, port)
    })
}

/// Where a camera is, as Python says it.
#[derive(FromPyObject)]
pub(crate) enum GivenCamera {
    /// It follows this vehicle.
    #[pyo3(transparent, annotation = "int")]
    Vehicle(i64),
    /// Above this place, with so much width in view [m].
    #[pyo3(transparent, annotation = "tuple[float, float, float]")]
    Place((f64, f64, f64)),
    /// By a name.
    #[pyo3(transparent, annotation = "str")]
    Name(String),
}

impl GivenCamera {
    pub(crate) fn camera(self) -> Result<Camera, Failure> {
        match self {
            GivenCamera::Vehicle(id) => Ok(Camera::Follow(id)),
            GivenCamera::Place((x, y, width))
                if x.is_finite() && y.is_finite() && (1.0..=1e6).contains(&width) =>
            {
                Ok(Camera::Place { x, y, width })
            }
            GivenCamera::Name(name) if name == "map" => Ok(Camera::Map),
            _ => {
                let remedy =
                    "choose \"map\", (x_m, y_m, width_m) with a width of 1 to 1000000 m, or a vehicle";
                Err(Fault::new("camera", "no place for a camera", remedy).into())
            }
        }
    }
}

/// What a map has beside its network.
pub(crate) fn around(simulation: &laneweave::Simulation) -> Result<laneweave_viewer::Surroundings, Failure> {
    let map = laneweave::scenario::read_map(simulation.scenario(), simulation.origin())?;
    Ok(laneweave_viewer::Surroundings::of(&map))
}

/// A source that goes on from where `simulation` is.
pub(crate) fn live(
    simulation: laneweave::Simulation,
    saved: &Path,
) -> Result<laneweave_viewer::Live, Failure> {
    let around = around(&simulation)?;
    Ok(laneweave_viewer::Live::of(simulation, around, saved.to_owned()))
}
