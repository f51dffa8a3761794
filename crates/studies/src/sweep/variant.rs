//! Variants of a scenario: what changes in each of them.

use std::num::NonZero;
use std::path::Path;

use laneweave_scenario::scenario::{Origin, Output, Scenario};
use laneweave_scenario::{Fault, did_you_mean, in_words};
use serde_json::Value;

/// A table of a scenario whose keys are names.
const STYLES: &str = "styles";
/// Keys that a plan does not change: what is said instead, and the remedy.
const RESERVED: [(&str, &str, &str); 3] = [
    ("run.seed", "the seed is not a key of a sweep", "give seeds = [1, 2] at the top of the plan"),
    ("run.threads", "each run of a sweep has one thread", "leave it out"),
    ("output", "a sweep writes its own tables only", "leave it out"),
];
/// Keys whose values are paths.
const PATHS: [&str; 4] = ["map", "commands", "replay.recording", "replay.columns"];

/// A new value of a key of a scenario.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Change {
    /// The path of the key, such as `["demand", "trucks"]`; an element of a list is named by its number.
    path: Vec<String>,
    /// Its value.
    pub(super) value: Value,
    /// Where the plan gives it.
    pub(super) place: String,
}

impl Change {
    /// A change to `value` of the key at `path`, which the plan gives at `place`. A name in quotes may contain a path.
    ///
    /// # Errors
    /// If a plan does not change this key.
    pub(super) fn new(path: &[&str], value: Value, place: String) -> Result<Change, Fault> {
        let path = path.join(".");
        // Names of styles may be names of files.
        let path: Vec<String> = match path.split_once('.') {
            Some((STYLES, name)) => vec![STYLES.to_owned(), name.to_owned()],
            _ => path.split('.').map(str::to_owned).collect(),
        };
        let change = Change { path, value, place };
        let key = change.key();
        match RESERVED.iter().find(|it| key == it.0 || key.starts_with(&format!("{}.", it.0))) {
            Some((_, what, remedy)) => Err(Fault::new(change.place, what, remedy)),
            None => Ok(change),
        }
    }

    /// The same change, with relative paths from `folder` on.
    pub(super) fn within(mut self, folder: &Path) -> Change {
        let whole = |path: &str| folder.join(path).display().to_string();
        let key = self.key();
        match &mut self.value {
            Value::String(path) if PATHS.contains(&key.as_str()) => *path = whole(path),
            Value::Array(paths) if PATHS.contains(&key.as_str()) => {
                for path in paths {
                    if let Value::String(path) = path {
                        *path = whole(path);
                    }
                }
            }
            Value::Object(styles) if key == STYLES => {
                let named = std::mem::take(styles).into_iter();
                *styles = named.map(|(name, it)| (style(name, folder), it)).collect();
            }
            _ => {}
        }
        if let [table, name] = &mut self.path[..]
            && table == STYLES
        {
            *name = style(std::mem::take(name), folder);
        }
        self
    }

    /// The key with its tables: `demand.trucks`.
    pub(super) fn key(&self) -> String {
        self.path.join(".")
    }

    /// The value in a few characters: a text without quotes.
    pub(super) fn value_text(&self) -> String {
        self.value.as_str().map_or_else(|| self.value.to_string(), str::to_owned)
    }

    /// Puts the value into the scenario `all`.
    fn put(&self, all: &mut Value) -> Result<(), Fault> {
        let mut at = all;
        for (depth, name) in self.path.iter().enumerate() {
            let table = self.path[..depth].join(".");
            if let Value::Object(names) = at
                && OPEN.contains(&table.as_str())
            {
                names.entry(name.clone()).or_insert(Value::Null);
            }
            let known: Vec<String> = at.as_object().into_iter().flat_map(|it| it.keys().cloned()).collect();
            let found = match at {
                Value::Object(table) => table.get_mut(name),
                Value::Array(list) => {
                    let count = list.len();
                    let entry = name.parse::<usize>().ok().and_then(|it| list.get_mut(it));
                    at = entry.ok_or_else(|| self.no_entry(&table, name, count))?;
                    continue;
                }
                _ => None,
            };
            at = found.ok_or_else(|| {
                let of = if table.is_empty() { String::new() } else { format!(" in {table}") };
                let known = known.iter().map(String::as_str);
                Fault::new(&self.place, format!("unknown key {name:?}{of}"), did_you_mean(name, known))
            })?;
        }
        *at = self.value.clone();
        Ok(())
    }

    /// The list `key` of the scenario, with `count` entries, has none that is called so.
    fn no_entry(&self, key: &str, name: &str, count: usize) -> Fault {
        let (what, remedy) = match count {
            0 => (
                format!("the scenario has no {key}"),
                format!("write {key} in the scenario, and change it here"),
            ),
            _ => (
                format!("the scenario has {count} of {key}, and none is {key}.{name}"),
                format!("they are {key}.0 to {key}.{}", count - 1),
            ),
        };
        Fault::new(&self.place, what, remedy)
    }
}

/// Tables of a scenario whose keys are names or ids.
const OPEN: [&str; 3] = [STYLES, "demand.entrances", "demand.exits"];

/// A style by its name; a file with its folder.
fn style(name: String, folder: &Path) -> String {
    if name.ends_with(".toml") { folder.join(name).display().to_string() } else { name }
}

/// A variant of a scenario.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Variant {
    /// What changes, in this order.
    pub(super) changes: Vec<Change>,
}

impl Variant {
    /// A variant with these changes.
    pub(super) fn of(changes: impl Into<Vec<Change>>) -> Variant {
        Variant { changes: changes.into() }
    }

    /// This variant with the changes of another.
    pub(super) fn and(&self, other: &Variant) -> Variant {
        Variant { changes: [&self.changes[..], &other.changes].concat() }
    }

    /// Refuses a key with two values, also as a part of a table that is given as a whole.
    pub(super) fn names_each_key_once(&self) -> Result<(), Fault> {
        for (number, change) in self.changes.iter().enumerate() {
            let overlaps =
                |it: &&Change| it.path.starts_with(&change.path) || change.path.starts_with(&it.path);
            if let Some(other) = self.changes[..number].iter().find(overlaps) {
                let (key, other) = (change.key(), other.key());
                let what = if key == other {
                    format!("the key {key} is given twice")
                } else {
                    format!("the keys {other} and {key} both say what one of them is")
                };
                return Err(Fault::new(&change.place, what, "leave it out here, or in the other table"));
            }
        }
        Ok(())
    }

    /// The changes in a line.
    pub(super) fn to_text(&self) -> String {
        let changes: Vec<String> =
            self.changes.iter().map(|it| format!("{}={}", it.key(), it.value_text())).collect();
        changes.join(", ")
    }

    /// The change to a key, if it changes.
    pub(super) fn change(&self, key: &str) -> Option<&Change> {
        self.changes.iter().find(|it| it.key() == key)
    }

    /// The variant of `scenario`, with this seed.
    ///
    /// # Errors
    /// If a key is unknown, or its value of another kind.
    pub(super) fn scenario(
        &self,
        (scenario, origin): (&Scenario, &Origin),
        seed: u64,
    ) -> Result<(Scenario, Origin), Fault> {
        let mut varied = scenario.clone();
        let mut origin = origin.clone();
        for change in &self.changes {
            let mut all = serde_json::to_value(&varied).map_err(|it| Fault::bug(&change.place, it))?;
            change.put(&mut all)?;
            varied = serde_json::from_value(all).map_err(|error| {
                let message = error.to_string();
                let (what, mut remedy) =
                    in_words(&message).unwrap_or_else(|| (message, "correct the value".into()));
                if change.value.is_f64() && what.ends_with("a whole number is expected") {
                    remedy = "this key takes whole numbers: list them in the grid".into();
                }
                Fault::new(&change.place, format!("{}: {what}", change.key()), remedy)
            })?;
            match &change.value {
                // Style files are found from the folder of the scenario on, as before.
                Value::Object(styles) if change.path == [STYLES] => {
                    let keys = styles.keys().map(|it| format!("{STYLES}.{it}"));
                    keys.for_each(|it| origin.replaced(it, change.place.clone()));
                }
                _ => origin.replaced(change.key(), change.place.clone()),
            }
        }
        varied.run.seed = seed;
        varied.run.threads = NonZero::new(1);
        varied.output = Output { record_s: 0.0, ..Output::default() };
        Ok((varied, origin))
    }
}
