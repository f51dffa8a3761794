//! A scenario file as a start: every key with its meaning, and its value on the given map.
//!
//! Names, meanings and choices come from the schema, defaults from the scenario of a bare map, so that the text
//! always agrees with the program. A line that begins with `#` and a letter or bracket is a key that is commented
//! out; prose begins with `#` and a blank.

mod facts;
mod prose;

use serde_json::{Map, Value};

use super::{Prepared, Scenario};
use crate::fault::Fault;
use facts::{Facts, Row};
use prose::{Kind, comment, described, inline, key, kind, meaning};

/// Keys and tables in the order of the file; others follow in that of their names.
const ORDER: [&str; 46] = [
    "map",
    "model",
    "made_signals",
    "commands",
    "demand",
    "demand.vehicles_per_hour",
    "demand.trucks",
    "demand.buses",
    "demand.motorcycles",
    "demand.taxis",
    "demand.emergency",
    "demand.profile",
    "demand.headways",
    "demand.entrances",
    "demand.exits",
    "demand.od",
    "demand.od.from",
    "demand.od.to",
    "demand.line",
    "demand.line.from",
    "demand.line.to",
    "turns",
    "turns.from",
    "turns.left",
    "turns.straight",
    "signals",
    "signals.offset_s",
    "signals.cycle_s",
    "signals.phases",
    "signals.phases.green",
    "signals.phases.green_s",
    "external",
    "external.lanelet",
    "obstacle",
    "obstacle.lanelet",
    "replay",
    "replay.recording",
    "replay.columns",
    "styles",
    "run",
    "run.duration_s",
    "run.warmup_s",
    "run.step_s",
    "output",
    "output.dir",
    "map_options",
];

/// The text of a scenario file that does the same as `scenario`. It contains every key; those with a default value
/// are commented out.
///
/// # Errors
/// None, as long as scenarios can be written as JSON.
pub fn write(scenario: &Scenario, prepared: &Prepared) -> Result<String, Fault> {
    let json = |it: &Scenario| serde_json::to_value(it).map_err(|it| Fault::bug("scenario", it));
    let draft = Draft {
        schema: Scenario::schema().to_value(),
        values: json(scenario)?,
        defaults: json(&Scenario::of_map(scenario.map.clone()))?,
        facts: Facts::of(prepared),
    };
    let mut text = String::new();
    let head = "A scenario of laneweave. A key after a # has its default value, or an example where the text says so. To change a \
                key, remove the # and edit the value. Put a new key of a table below the name of the table in [brackets].";
    text += &comment(head, "");
    draft.table("", &draft.schema, &mut text);
    Ok(text)
}

/// The sources of the text.
struct Draft {
    schema: Value,
    values: Value,
    defaults: Value,
    facts: Facts,
}

impl Draft {
    /// The keys of the table at `path`, whose schema is `of`: first those with plain values.
    fn table(&self, path: &str, of: &Value, text: &mut String) {
        let Some(properties) = of["properties"].as_object() else { return };
        let (plain, tables): (Vec<_>, Vec<_>) = sorted(path, properties).into_iter().partition(|(_, it)| {
            matches!(kind(&self.schema, it), Kind::Value | Kind::Choice(_) | Kind::Tagged(_))
        });
        for (path, property) in plain {
            *text += "\n";
            *text += &comment(&meaning(property), "");
            self.plain(&path, property, text);
        }
        for (path, property) in tables {
            *text += "\n";
            *text += &comment(&meaning(property), "");
            match kind(&self.schema, property) {
                Kind::Table(of) => {
                    *text += &format!("[{path}]\n");
                    self.table(&path, of, text);
                }
                Kind::List(of) => {
                    self.keys_of(&path, &path, of, text);
                    self.rows(&path, text);
                }
                _ => {
                    *text += &format!("[{path}]\n");
                    self.entries(&path, text);
                }
            }
        }
    }

    /// A key with a plain value.
    fn plain(&self, path: &str, property: &Value, text: &mut String) {
        for choice in kind(&self.schema, property).choices() {
            *text += &comment(&described(choice), "  ");
        }
        let known = self.facts.values.get(path);
        if let Some(note) = known.and_then(|it| it.note.as_deref()) {
            *text += &comment(note, "");
        }
        let [own, default] = [&self.values, &self.defaults].map(|it| at(it, path));
        let is_given = own != default || path == "map";
        let value = if is_given { Some(own) } else { known.map(|it| &it.value).or(Some(own)) };
        // Without a known value, the meaning is written.
        if let Some(value) = value.filter(|it| !it.is_null()) {
            let name = path.rsplit('.').next().unwrap_or(path);
            *text += &format!("{}{name} = {}\n", if is_given { "" } else { "#" }, inline(value));
        }
    }

    /// The entries of a table whose keys are names.
    fn entries(&self, path: &str, text: &mut String) {
        // The drivers of the styles: the list is short.
        if let Some(own) = at(&self.values, path).as_object().filter(|it| !it.is_empty()) {
            own.iter().for_each(|(name, value)| *text += &format!("{} = {}\n", key(name), inline(value)));
        }
        self.rows(path, text);
    }

    /// The meanings of the keys of the tables in a list.
    fn keys_of(&self, list: &str, path: &str, of: &Value, text: &mut String) {
        let Some(properties) = of["properties"].as_object() else { return };
        for (path, property) in sorted(path, properties) {
            let name = path.strip_prefix(list).unwrap_or(&path).trim_start_matches('.');
            *text += &comment(&format!("{name}: {}", meaning(property)), "  ");
            if let Kind::List(of) = kind(&self.schema, property) {
                self.keys_of(list, &path, of, text);
            }
        }
    }

    /// The map's values for a table of names, or for a list, commented out.
    fn rows(&self, path: &str, text: &mut String) {
        let Some(rows) = self.facts.rows.get(path) else { return };
        *text += &comment(&rows.note, "");
        for row in &rows.rows {
            match row {
                Row::Entry { name, value, what } => {
                    *text += &format!("#{} = {value:<8} # {what}\n", key(name));
                }
                Row::Table { header, keys } => {
                    *text += &format!("#{header}\n");
                    keys.iter().for_each(|(name, value)| *text += &format!("#{name} = {}\n", inline(value)));
                }
            }
        }
        if rows.omitted > 0 {
            *text += &comment(&format!("… and {} more", rows.omitted), "");
        }
    }
}

/// The value at `path`, whose names are joined by dots; null if there is none.
fn at<'a>(value: &'a Value, path: &str) -> &'a Value {
    path.split('.').fold(value, |it, name| &it[name])
}

/// The properties of the table at `path` with their own paths, in the order of the file.
fn sorted<'a>(path: &str, properties: &'a Map<String, Value>) -> Vec<(String, &'a Value)> {
    let own = |name: &String| if path.is_empty() { name.clone() } else { format!("{path}.{name}") };
    let mut all: Vec<(String, &Value)> = properties.iter().map(|(name, it)| (own(name), it)).collect();
    all.sort_by_key(|(path, _)| ORDER.iter().position(|it| it == path).unwrap_or(ORDER.len()));
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_key_whose_place_is_named_is_one() {
        let schema = Scenario::schema().to_value();
        for path in ORDER {
            let mut table = &schema;
            for name in path.split('.') {
                let property = &table["properties"][name];
                assert!(property.is_object(), "{path}");
                table = match kind(&schema, property) {
                    Kind::Table(of) | Kind::List(of) => of,
                    _ => property,
                };
            }
        }
    }
}
