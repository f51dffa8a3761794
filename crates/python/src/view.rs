//! The class `View`: the page in the browser.

use std::net::{Ipv4Addr, SocketAddr};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use laneweave::scenario::MapOptions;
use laneweave::{Fault, FaultKind, VehicleId};
use laneweave_viewer::{Camera, Doorway, Live, Picture, Server, Shown, Source, Surroundings, Token, picture};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors::{Failure, detached, refused};
use crate::keys::fitting;
use crate::values::given;

/// The page in the browser: it is served until it is closed.
#[pyclass(frozen, module = "laneweave")]
pub(crate) struct View {
    /// `None` once it is closed.
    held: Mutex<Option<Served>>,
    url: String,
}

/// What ends with a view: its server, and the file that leads a browser there, if one was opened.
struct Served {
    _server: Server,
    doorway: Option<Doorway>,
}

impl View {
    /// Serves `source`; port 0 is any free one.
    pub(crate) fn of(source: Box<dyn Source>, port: u16) -> Result<View, Failure> {
        let address = SocketAddr::from((Ipv4Addr::LOCALHOST, port));
        let server = Server::start(source, address, Token::new()).map_err(|error| {
            let fault = Fault::new(format!("view: {address}"), error, "choose another port");
            fault.of_kind(FaultKind::File)
        })?;
        let url = server.url();
        Ok(View { held: Mutex::new(Some(Served { _server: server, doorway: None })), url })
    }

    /// What ends with it. Nobody holds it for long.
    fn held(&self) -> MutexGuard<'_, Option<Served>> {
        self.held.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[pymethods]
impl View {
    /// The address of the page. Whoever knows it can do there what you can do.
    #[getter]
    fn url(&self) -> &str {
        &self.url
    }

    /// A file that leads a browser to the page, and that only you can read; it is there until the view is closed.
    fn doorway(&self, py: Python<'_>) -> PyResult<PathBuf> {
        detached(py, || {
            let mut held = self.held();
            let served = held.as_mut().ok_or_else(|| refused("view", "it is closed", "make a new one"))?;
            let doorway = match served.doorway.take() {
                Some(doorway) => doorway,
                None => Doorway::to(&self.url)
                    .map_err(|error| Fault::refused(&std::env::temp_dir(), "written", &error))?,
            };
            Ok(served.doorway.insert(doorway).path().to_owned())
        })
    }

    /// Whether it is closed.
    #[getter]
    fn is_closed(&self) -> bool {
        self.held().is_none()
    }

    /// Ends the page.
    fn close(&self, py: Python<'_>) -> PyResult<()> {
        detached(py, || {
            let gone = self.held().take();
            drop(gone);
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
    let options = given("map_options", options)?;
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
    #[pyo3(transparent, annotation = "(x_m, y_m, width_m)")]
    Place(Vec<f64>),
    /// By a name.
    #[pyo3(transparent, annotation = "str")]
    Name(String),
}

fn is_place(numbers: &[f64]) -> bool {
    matches!(numbers, [x, y, width] if x.is_finite() && y.is_finite() && (1.0..=1e6).contains(width))
}

impl GivenCamera {
    pub(crate) fn camera(self) -> Result<Camera, Failure> {
        match self {
            GivenCamera::Vehicle(id) => Ok(Camera::Follow(id)),
            GivenCamera::Name(name) if name == "map" => Ok(Camera::Map),
            GivenCamera::Place(numbers) if is_place(&numbers) => {
                Ok(Camera::Place { x: numbers[0], y: numbers[1], width: numbers[2] })
            }
            _ => {
                let remedy =
                    "choose \"map\", (x_m, y_m, width_m) with a width of 1 to 1000000 m, or a vehicle";
                Err(Fault::new("camera", "no place for a camera", remedy).into())
            }
        }
    }
}

/// A source that goes on from where `simulation` is, on a map that has this beside its network.
pub(crate) fn live(simulation: laneweave::Simulation, around: &Surroundings, saved: &Path) -> Live {
    Live::of(simulation, around.clone(), saved.to_owned())
}

/// A picture of a simulation.
///
/// # Errors
/// If the camera follows a vehicle that is not on the road, or is none, or if the size is impossible.
pub(crate) fn taken(
    simulation: laneweave::Simulation,
    around: &Surroundings,
    camera: GivenCamera,
    size: [u32; 2],
) -> Result<Picture, Failure> {
    let camera = camera.camera()?;
    if let Camera::Follow(id) = camera
        && VehicleId::try_from(id).ok().and_then(|id| simulation.view(id)).is_none()
    {
        let what = format!("vehicle {id} is not on the road");
        let fault = Fault::new("camera", what, "choose one of simulation.vehicles()");
        return Err(fault.of_kind(FaultKind::NotFound).into());
    }
    Ok(picture(&mut live(simulation, around, Path::new("")), camera, size)?)
}
