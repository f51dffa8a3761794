//! Ids of lanelets and lights in Python.

use std::convert::Infallible;

use laneweave::Id;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyString;

/// An id: a `str` in Python, which may also be given as an `int`.
#[derive(Clone, Copy)]
pub(crate) struct GivenId(pub(crate) Id);

impl<'a, 'py> FromPyObject<'a, 'py> for GivenId {
    type Error = PyErr;

    fn extract(value: Borrowed<'a, 'py, PyAny>) -> PyResult<GivenId> {
        if let Ok(text) = value.cast::<PyString>() {
            return Ok(GivenId(Id::from(text.to_str()?)));
        }
        let number = value.extract::<i64>();
        let wrong = |_| PyTypeError::new_err("an id is a str, such as \"12\" or \"edge_0\", or an int");
        number.map(|it| GivenId(Id::from(it))).map_err(wrong)
    }
}

impl<'py> IntoPyObject<'py> for GivenId {
    type Target = PyString;
    type Output = Bound<'py, PyString>;
    type Error = Infallible;

    fn into_pyobject(self, py: Python<'py>) -> Result<Bound<'py, PyString>, Infallible> {
        self.0.to_string().into_pyobject(py)
    }
}
