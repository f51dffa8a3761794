//! Keyword arguments become a scenario: they have the names of the keys of a scenario file.

use std::path::PathBuf;

use laneweave::scenario::{Origin, Scenario};
use laneweave::{Fault, FaultKind};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::{Map, Value};

use crate::errors::Failure;

/// Keys that are so common that they need no table.
const SHORT: [(&str, &str); 8] = [
    ("vehicles_per_hour", "demand"),
    ("trucks", "demand"),
    ("seed", "run"),
    ("drivers_seed", "run"),
    ("duration_s", "run"),
    ("warmup_s", "run"),
    ("step_s", "run"),
    ("threads", "run"),
];

/// Tables that are given as a whole: their keys are names.
const WHOLE: [&str; 1] = ["styles"];

/// A scenario, or a bare map, with these keys in place of its own.
pub(crate) struct Asked {
    source: PathBuf,
    keys: Value,
}

impl Asked {
    /// The scenario or the map in the file `source`, with the keyword arguments `keys`.
    ///
    /// # Errors
    /// If a value is neither a number, a text, a list nor a dict.
    pub(crate) fn new(source: PathBuf, keys: Option<&Bound<'_, PyDict>>) -> PyResult<Asked> {
        let keys = keys.map_or(Ok(Value::Object(Map::new())), |it| pythonize::depythonize(it))?;
        Ok(Asked { source, keys })
    }

    /// The scenario, with the source of its values.
    ///
    /// # Errors
    /// If the file cannot be read, or is no scenario; or if a key is unknown, or its value of another kind.
    pub(crate) fn read(self) -> Result<(Scenario, Origin), Failure> {
        let (scenario, origin) = Origin::open(&self.source)?;
        let mut values = serde_json::to_value(&scenario).map_err(|it| Fault::bug("scenario", it))?;
        let Value::Object(keys) = self.keys else { return Ok((scenario, origin)) };
        for (key, value) in keys {
            let table = SHORT.iter().find(|it| it.0 == key);
            match table {
                Some((_, table)) => {
                    merge(&mut values[*table], Value::Object([(key, value)].into_iter().collect()))
                }
                None => merge(&mut values, Value::Object([(key, value)].into_iter().collect())),
            }
        }
        let scenario = serde_json::from_value(values).map_err(|error| {
            let remedy =
                "use the keys of a scenario file, such as vehicles_per_hour=3000 or demand={\"trucks\": 0.1}";
            Fault::new("keyword arguments", error, remedy).of_kind(FaultKind::Value)
        })?;
        Ok((scenario, origin))
    }
}

/// Puts `new` into `old`, table by table.
fn merge(old: &mut Value, new: Value) {
    match (old, new) {
        (Value::Object(old), Value::Object(new)) => {
            for (key, value) in new {
                if WHOLE.contains(&key.as_str()) {
                    old.insert(key, value);
                } else {
                    merge(old.entry(key).or_insert(Value::Null), value);
                }
            }
        }
        (old, new) => *old = new,
    }
}
