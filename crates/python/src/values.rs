//! Values between the two languages, and signals.

use std::time::{Duration, Instant};

use laneweave::{Fault, FaultKind};
use numpy::{Element, PyArray1};
use pyo3::prelude::*;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::errors::Failure;

/// Looks now and then whether the user wants the program to end.
pub(crate) struct Signals {
    last: Instant,
}

impl Signals {
    /// Time between two looks.
    const EVERY: Duration = Duration::from_millis(50);

    pub(crate) fn new() -> Signals {
        Signals { last: Instant::now() }
    }

    pub(crate) fn check(&mut self) -> Result<(), Failure> {
        if self.last.elapsed() < Signals::EVERY {
            return Ok(());
        }
        self.last = Instant::now();
        Ok(Python::attach(|py| py.check_signals())?)
    }
}

/// An array that owns its numbers.
pub(crate) fn array<T: Element>(py: Python<'_>, numbers: Vec<T>) -> Bound<'_, PyArray1<T>> {
    PyArray1::from_vec(py, numbers)
}

/// Plain data as dicts, lists, numbers and texts.
pub(crate) fn to_python<T: Serialize + ?Sized>(py: Python<'_>, data: &T) -> PyResult<Py<PyAny>> {
    Ok(pythonize::pythonize(py, data)?.unbind())
}

/// The value with this name.
pub(crate) fn named<T: DeserializeOwned>(argument: &str, name: &str) -> Result<T, Failure> {
    serde_json::from_value(Value::String(name.to_owned())).map_err(|error| {
        let fault = Fault::new(argument, format!("{name:?}: {error}"), "choose one of the known names");
        Failure::Fault(fault.of_kind(FaultKind::Command))
    })
}
