//! Values between the two languages, and signals.

use std::time::{Duration, Instant};

use laneweave::{Fault, FaultKind, in_words};
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

/// Plain data as a value that can be handed from thread to thread.
pub(crate) fn plain<T: Serialize + ?Sized>(data: &T) -> Result<Value, Failure> {
    serde_json::to_value(data).map_err(|error| Fault::bug("values", error).into())
}

/// The value with this name.
pub(crate) fn named<T: DeserializeOwned>(argument: &str, name: &str) -> Result<T, Failure> {
    serde_json::from_value(Value::String(name.to_owned())).map_err(|error| {
        let message = error.to_string();
        let (what, remedy) =
            in_words(&message).unwrap_or_else(|| (message, "choose one of the known names".into()));
        Fault::new(argument, what, remedy).of_kind(FaultKind::Command).into()
    })
}
