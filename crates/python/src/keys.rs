//! Keyword arguments become a scenario: they have the names of the keys of a scenario file.

use std::path::PathBuf;

use laneweave::scenario::{MapOptions, Origin, Scenario};
use laneweave::{Fault, FaultKind, did_you_mean, in_words};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::errors::Failure;
use crate::map::Map;
use crate::values::given;

/// Keys that are so common that they need no table.
const SHORT: [(&str, &str); 8] = [
    (TOTAL, "demand"),
    ("trucks", "demand"),
    ("seed", "run"),
    ("drivers_seed", "run"),
    ("duration_s", "run"),
    ("warmup_s", "run"),
    ("step_s", "run"),
    ("threads", "run"),
];
/// The one of them that replaces all demands, unless these are given, too.
const TOTAL: &str = "vehicles_per_hour";
/// The table of styles, which is given as a whole: its keys are names.
const STYLES: &str = "styles";
/// The table with the folder of results.
const OUTPUT: &str = "output";
/// The place of a fault.
const PLACE: &str = "keyword arguments";

type Table = serde_json::Map<String, Value>;

/// A map that was read, or the file of a map or of a scenario.
#[derive(FromPyObject)]
pub(crate) enum Given<'py> {
    /// A map that was read.
    #[pyo3(transparent, annotation = "Map")]
    Map(PyRef<'py, Map>),
    /// A file.
    #[pyo3(transparent, annotation = "path")]
    File(PathBuf),
}

/// A scenario, or a bare map, with these keys in place of its own.
pub(crate) struct Asked {
    pub(crate) source: PathBuf,
    options: Option<MapOptions>,
    keys: Keys,
}

impl Asked {
    /// What is `given`, with the keyword arguments `keys`.
    ///
    /// # Errors
    /// If a value is neither a number, a text, a list, a dict nor a style.
    pub(crate) fn new(
        py: Python<'_>,
        source: Given<'_>,
        keys: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Asked> {
        let (source, options) = match source {
            Given::Map(map) => (map.path.clone(), Some(map.options.clone())),
            Given::File(path) => (path, None),
        };
        if source.to_str().is_none() {
            let fault = Fault::new(source.display(), "this name is no text in UTF-8", "rename the file");
            return Err(Failure::from(fault.of_kind(FaultKind::File)).raise(py));
        }
        Ok(Asked { source, options, keys: Keys::new(py, keys)? })
    }

    /// The scenario, with the source of its values.
    ///
    /// # Errors
    /// If the file cannot be read, or is no scenario; or if a key is unknown, or its value of another kind.
    pub(crate) fn read(self) -> Result<(Scenario, Origin), Failure> {
        let (mut scenario, origin) = Origin::open(&self.source)?;
        scenario.map_options = self.options.unwrap_or(scenario.map_options);
        self.keys.put(&scenario, origin)
    }
}

/// Keys of a scenario, by their tables.
#[derive(Clone)]
pub(crate) struct Keys {
    values: Table,
    /// The texts of styles that are given themselves, by their names.
    styles: Vec<(String, String)>,
}

impl Keys {
    /// The keyword arguments `keys`.
    ///
    /// # Errors
    /// If a value is neither a number, a text, a list, a dict nor a style.
    pub(crate) fn new(py: Python<'_>, keys: Option<&Bound<'_, PyDict>>) -> PyResult<Keys> {
        let mut all = Keys { values: Table::new(), styles: Vec::new() };
        for (key, value) in keys.into_iter().flat_map(PyDictMethods::iter) {
            let key: String = key.extract()?;
            let value = match value.cast::<PyDict>() {
                Ok(styles) if key == STYLES => all.mixture(py, styles)?,
                _ => given(&key, &value)?,
            };
            if key == OUTPUT && value.get("dir").is_some() {
                let fault =
                    Fault::new("output.dir", "the folder of results is an argument", "give it as out=");
                return Err(Failure::from(fault.of_kind(FaultKind::Value)).raise(py));
            }
            all.values.insert(key, value);
        }
        Ok(all)
    }

    /// The weights of styles, by their names. The texts of styles that are given themselves are kept.
    fn mixture(&mut self, py: Python<'_>, styles: &Bound<'_, PyDict>) -> PyResult<Value> {
        let mut weights = Table::new();
        for (style, weight) in styles {
            let name: String = if style.hasattr("to_toml")? {
                let name: String = style.getattr("name")?.extract()?;
                self.styles.push((name.clone(), style.call_method0("to_toml")?.extract()?));
                name
            } else {
                match given(STYLES, &style)? {
                    Value::String(name) => name,
                    other => return Err(PyTypeError::new_err(format!("styles: {other} is no style"))),
                }
            };
            let place = format!("{STYLES}.{name}");
            if weights.insert(name, given(&place, &weight)?).is_some() {
                let fault = Fault::new(place, "two styles have this name", "give each its own name");
                return Err(Failure::from(fault.of_kind(FaultKind::Style)).raise(py));
            }
        }
        Ok(Value::Object(weights))
    }

    /// `scenario` with these keys in place of its own.
    ///
    /// # Errors
    /// If a key is unknown, or its value of another kind.
    pub(crate) fn put(self, scenario: &Scenario, mut origin: Origin) -> Result<(Scenario, Origin), Failure> {
        let mut all = serde_json::to_value(scenario).map_err(|it| Fault::bug("scenario", it))?;
        if self.values.contains_key(TOTAL) {
            // As the option --demand of the command: beside these the total may mean nothing.
            all["demand"]["entrances"] = Value::Object(Table::new());
            all["demand"]["od"] = Value::Array(Vec::new());
        }
        for (key, value) in self.values {
            let short = SHORT.iter().find(|it| it.0 == key);
            let known = all.as_object().into_iter().flat_map(|it| it.keys().map(String::as_str));
            if short.is_none() && !known.clone().any(|it| it == key) {
                let names = known.chain(SHORT.iter().map(|it| it.0));
                return Err(wrong(format!("unknown key {key:?}"), did_you_mean(&key, names)));
            }
            match short {
                Some((_, table)) => origin.replaced(format!("{table}.{key}"), key.clone()),
                None => replaced(&mut origin, &key, &value),
            }
            let one = Value::Object([(key, value)].into_iter().collect());
            match short {
                Some((_, table)) => merge(&mut all[*table], one),
                None => merge(&mut all, one),
            }
        }
        let origin = self.styles.iter().fold(origin, |origin, (name, text)| origin.with_style(name, text));
        Ok((fitting(all)?, origin))
    }
}

/// Notes that the program gave this key, with all in it.
fn replaced(origin: &mut Origin, key: &str, value: &Value) {
    match value.as_object() {
        Some(table) if key != STYLES => {
            table.iter().for_each(|(name, it)| replaced(origin, &format!("{key}.{name}"), it));
        }
        _ => origin.replaced(key, key),
    }
}

/// Values as a `T`.
///
/// # Errors
/// If a key is unknown, or its value of another kind.
pub(crate) fn fitting<T: DeserializeOwned>(values: Value) -> Result<T, Failure> {
    serde_json::from_value(values).map_err(|error| {
        let message = error.to_string();
        let (what, remedy) = in_words(&message).unwrap_or_else(|| (message, "correct the value".into()));
        wrong(what, remedy)
    })
}

fn wrong(what: String, remedy: String) -> Failure {
    Fault::new(PLACE, what, remedy).of_kind(FaultKind::Value).into()
}

/// Puts `new` into `old`, table by table.
fn merge(old: &mut Value, new: Value) {
    match (old, new) {
        (Value::Object(old), Value::Object(new)) => {
            for (key, value) in new {
                if key == STYLES {
                    old.insert(key, value);
                } else {
                    merge(old.entry(key).or_insert(Value::Null), value);
                }
            }
        }
        (old, new) => *old = new,
    }
}
