//! The texts of styles. The class `Style` itself is written in Python.

use std::path::Path;

use laneweave::style::{StyleTemplate, copy, find};
use laneweave::{Fault, FaultKind, Source};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors::{Failure, detached};
use crate::values::given;

fn named(name: &str) -> Result<Source, Fault> {
    find(name, Path::new("."), || "style".into()).map_err(|fault| fault.of_kind(FaultKind::Style))
}

/// The text of a style file: of a built-in style, or of a file.
#[pyfunction]
pub(crate) fn style_text(py: Python<'_>, name: &str) -> PyResult<String> {
    detached(py, || {
        let source = named(name)?;
        StyleTemplate::parse(&source)?;
        Ok(source.text)
    })
}

/// The text of a new style like another one.
#[pyfunction]
pub(crate) fn new_style(py: Python<'_>, name: &str, base: &str) -> PyResult<String> {
    detached(py, || Ok(copy(&named(base)?, name).map_err(|it| it.of_kind(FaultKind::Style))?))
}

/// The text of a style file with these values.
#[pyfunction]
pub(crate) fn style_of(py: Python<'_>, values: &Bound<'_, PyDict>) -> PyResult<String> {
    let values = given("style", values)?;
    detached(py, || {
        let text = toml::to_string(&values).map_err(|error| -> Failure {
            Fault::new("style", error, "correct the value").of_kind(FaultKind::Style).into()
        })?;
        let source = Source { path: "style".into(), text };
        StyleTemplate::parse(&source).map_err(|fault| without_line(fault, &source))?;
        Ok(source.text)
    })
}

/// A fault that names the line itself, which nobody has seen, in place of its number.
fn without_line(fault: Fault, source: &Source) -> Fault {
    let line = fault.place.split(':').nth(1).and_then(|it| it.parse::<usize>().ok());
    let line = line.and_then(|it| source.text.lines().nth(it.saturating_sub(1)));
    let place = line.map_or_else(|| "style".to_owned(), |it| format!("style, {it}"));
    Fault { place, ..fault }.of_kind(FaultKind::Style)
}
