//! The command `laneweave`.

use std::ffi::OsString;

use pyo3::prelude::*;

use crate::errors::detached;

/// Does what a command line asks for, and returns the exit code. The first argument is the name of the program. Another
/// process of the command begins with `program`.
#[pyfunction]
pub(crate) fn command(py: Python<'_>, arguments: Vec<OsString>, program: Vec<OsString>) -> PyResult<u8> {
    detached(py, || Ok(laneweave_cli::command(&arguments, program)))
}
