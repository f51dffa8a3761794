//! Faults become exceptions with their place and their remedy, and so do panics: nothing ends the interpreter.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Mutex, MutexGuard, TryLockError};

use laneweave::{Fault, FaultKind};
use pyo3::prelude::*;

/// A fault, or an exception that is there already.
pub(crate) enum Failure {
    Fault(Fault),
    Raised(PyErr),
}

impl From<Fault> for Failure {
    fn from(fault: Fault) -> Failure {
        Failure::Fault(fault)
    }
}

impl From<PyErr> for Failure {
    fn from(raised: PyErr) -> Failure {
        Failure::Raised(raised)
    }
}

/// The name of the exception of a kind of faults.
fn class(kind: FaultKind) -> &'static str {
    match kind {
        FaultKind::Map => "MapError",
        FaultKind::Recording => "RecordingError",
        FaultKind::Style => "StyleError",
        FaultKind::Command => "CommandError",
        FaultKind::State => "StateError",
        FaultKind::NotFound => "NotFoundError",
        FaultKind::File | FaultKind::Output | FaultKind::Closed => "FileError",
        FaultKind::Syntax | FaultKind::Value => "ScenarioError",
        FaultKind::Internal => "LaneweaveError",
    }
}

impl Failure {
    /// The exception, which knows its place and its remedy.
    pub(crate) fn raise(self, py: Python<'_>) -> PyErr {
        let fault = match self {
            Failure::Fault(fault) => fault,
            Failure::Raised(raised) => return raised,
        };
        let made = py.import("laneweave._errors").and_then(|it| it.getattr(class(fault.kind)));
        let place = argument(&fault.place);
        let remedy = fault.remedy.replace("add --map MAP", "name it with map=");
        let made = made.and_then(|it| it.call1((place, fault.what, remedy)));
        made.map_or_else(|error| error, PyErr::from_value)
    }
}

/// The place of a fault in the words of Python: an option of a command is an argument here.
fn argument(place: &str) -> String {
    const OTHERS: [(&str, &str); 5] = [
        ("--lead", "lead_s"),
        ("--position-error", "position_error_m"),
        ("FROM", "from_lanelet"),
        ("TO", "to_lanelet"),
        ("NAME", "name"),
    ];
    let other = OTHERS.iter().find(|it| it.0 == place).map(|it| it.1.to_owned());
    let option = || place.strip_prefix("--").map(|it| it.replace('-', "_"));
    other.or_else(option).unwrap_or_else(|| place.to_owned())
}

/// What is held there, while no other thread uses it. `place` is its name.
///
/// # Errors
/// If another thread uses it, or a panic has broken it.
pub(crate) fn locked<'a, T>(held: &'a Mutex<T>, place: &str) -> Result<MutexGuard<'a, T>, Failure> {
    held.try_lock().map_err(|error| match error {
        TryLockError::WouldBlock => refused(place, "another thread is using it", "give each thread its own"),
        TryLockError::Poisoned(_) => refused(place, "a mistake of laneweave broke it", "make a new one"),
    })
}

/// What is not possible in the present state.
pub(crate) fn refused(place: &str, what: &str, remedy: &str) -> Failure {
    Fault::new(place, what, remedy).of_kind(FaultKind::State).into()
}

/// Does `work` without the lock of the interpreter. A panic becomes an exception.
pub(crate) fn detached<T: Send>(
    py: Python<'_>,
    work: impl FnOnce() -> Result<T, Failure> + Send,
) -> PyResult<T> {
    py.detach(|| caught(work)).map_err(|it| it.raise(py))
}

/// Does `work`. A panic becomes a fault.
pub(crate) fn caught<T>(work: impl FnOnce() -> Result<T, Failure>) -> Result<T, Failure> {
    let done = catch_unwind(AssertUnwindSafe(work));
    done.unwrap_or_else(|panic| Err(Fault::bug("laneweave", said(&*panic)).into()))
}

/// What a panic said.
fn said(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|it| (*it).to_owned());
    text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_else(|| "a panic".into())
}
