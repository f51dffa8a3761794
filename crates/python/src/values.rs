//! Values between the two languages, and signals.

use std::time::{Duration, Instant};

use laneweave::{Fault, FaultKind, in_words};
use numpy::{Element, PyArray1};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyString, PyTuple};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Number, Value};

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

/// Deepest tables and lists in tables and lists: what contains itself has no end.
const DEEPEST: usize = 32;

/// What a program gives as the argument `name`: numbers, texts, paths, lists and dicts, also those of numpy.
///
/// # Errors
/// If it is of another type, or too deep.
pub(crate) fn given(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Value> {
    value_of(value, DEEPEST)
        .map_err(|error| PyTypeError::new_err(format!("{name}: {}", error.value(value.py()))))
}

fn value_of(value: &Bound<'_, PyAny>, depth: usize) -> PyResult<Value> {
    let deeper = |it: &Bound<'_, PyAny>| match depth {
        0 => Err(PyTypeError::new_err("it is too deep, or contains itself")),
        _ => value_of(it, depth - 1),
    };
    if value.is_none() {
        return Ok(Value::Null);
    }
    if value.is_instance_of::<PyBool>() {
        return Ok(value.extract::<bool>()?.into());
    }
    if value.is_instance_of::<PyString>() {
        return Ok(value.extract::<String>()?.into());
    }
    if value.is_instance_of::<PyInt>() {
        return value.extract::<i64>().map(Value::from).or_else(|_| Ok(value.extract::<u64>()?.into()));
    }
    if value.is_instance_of::<PyFloat>() {
        let number = Number::from_f64(value.extract()?);
        return number.map(Value::Number).ok_or_else(|| PyTypeError::new_err("it is no finite number"));
    }
    if let Ok(dict) = value.cast::<PyDict>() {
        let entries = dict.iter().map(|(key, it)| Ok((key.extract::<String>()?, deeper(&it)?)));
        return Ok(Value::Object(entries.collect::<PyResult<_>>()?));
    }
    if value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>() {
        let all = value.try_iter()?.map(|it| deeper(&it?));
        return Ok(Value::Array(all.collect::<PyResult<_>>()?));
    }
    // Paths; numbers and arrays of numpy.
    for plain in ["__fspath__", "tolist"] {
        if let Ok(method) = value.getattr(plain) {
            return deeper(&method.call0()?);
        }
    }
    Err(PyTypeError::new_err(format!("the type {} has no meaning here", value.get_type().name()?)))
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
