//! The text of a TOML file, and the positions of its keys.

use std::ops::Range;
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use toml::de::{DeArray, DeTable, DeValue, Error};

use crate::fault::{Fault, FaultKind, did_you_mean};

/// The text of a TOML file and its name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    /// Its path as the user gave it.
    pub path: PathBuf,
    /// Its text.
    pub text: String,
}

impl Source {
    /// Reads the file at `path`.
    ///
    /// # Errors
    /// If it cannot be read as text.
    pub fn read(path: &Path) -> Result<Source, Fault> {
        let text = std::fs::read_to_string(path).map_err(|error| Fault::refused(path, "read", &error))?;
        Ok(Source { path: path.to_owned(), text })
    }

    /// Whether it is a scenario, and no style.
    pub fn is_scenario(&self) -> bool {
        self.has_key("map") && !self.has_key("follow")
    }

    /// Whether it is a style, and no scenario.
    pub fn is_style(&self) -> bool {
        self.has_key("follow") && !self.has_key("map")
    }

    /// The folder to which its relative paths refer.
    pub fn folder(&self) -> &Path {
        self.path.parent().unwrap_or(Path::new(""))
    }

    /// `FILE:LINE:COLUMN` of the byte at `offset`; columns count characters.
    pub fn at(&self, offset: usize) -> String {
        let before = self.text.get(..offset).unwrap_or(&self.text);
        let line = before.matches('\n').count() + 1;
        let column = before.chars().rev().take_while(|it| *it != '\n').count() + 1;
        format!("{}:{line}:{column}", self.path.display())
    }

    /// The position of the key at `path`, or else of the nearest existing table around it; the file if there is none.
    /// The elements of a list are named by their numbers from 0 on.
    pub fn place(&self, path: &[&str]) -> String {
        let Ok(root) = DeTable::parse(&self.text) else { return self.path.display().to_string() };
        let mut names = path.iter();
        let mut at = names.next().and_then(|name| entry(root.get_ref(), name));
        let mut found = None;
        while let Some((span, value)) = at {
            found = Some(span);
            at = names.next().and_then(|name| match value {
                DeValue::Table(table) => entry(table, name),
                DeValue::Array(list) => element(list, name),
                _ => None,
            });
        }
        found.map_or(self.path.display().to_string(), |span| self.at(span.start))
    }

    /// Whether it has this key in addition to its tables.
    pub(crate) fn has_key(&self, name: &str) -> bool {
        DeTable::parse(&self.text).is_ok_and(|root| entry(root.get_ref(), name).is_some())
    }

    /// The position of `text` as a value, if there is one.
    pub(crate) fn place_of_value(&self, text: &str) -> Option<String> {
        fn find(table: &DeTable, text: &str) -> Option<Range<usize>> {
            table.iter().find_map(|(_, value)| match value.get_ref() {
                DeValue::Table(inner) => find(inner, text),
                DeValue::String(it) if it == text => Some(value.span()),
                _ => None,
            })
        }
        let root = DeTable::parse(&self.text).ok()?;
        find(root.get_ref(), text).map(|span| self.at(span.start))
    }

    /// Reads the text as a `T`.
    ///
    /// # Errors
    /// If it is no TOML, or has another structure: with the place, and the most similar valid name.
    pub fn parse<T: DeserializeOwned>(&self) -> Result<T, Fault> {
        toml::from_str(&self.text).map_err(|error| self.fault(&error))
    }

    /// The message of serde or of the parser, with its place and a remedy.
    pub(crate) fn fault(&self, error: &Error) -> Fault {
        let message = error.message();
        let name = message.split('`').nth(1).unwrap_or("");
        let place = match error.span() {
            Some(span) => self.at(span.start),
            None => self.place_of_value(name).unwrap_or(self.path.display().to_string()),
        };
        let (what, remedy) = in_words(message).unwrap_or_else(|| {
            let remedy = "correct this line; the format is TOML, https://toml.io";
            (message.replace('\n', ", "), remedy.into())
        });
        Fault::new(place, what, remedy).of_kind(FaultKind::Syntax)
    }
}

/// A message of serde on a value that does not fit: what is wrong, and the remedy. `None` for another message.
pub fn in_words(message: &str) -> Option<(String, String)> {
    // An unknown name comes first in backticks, then the known ones.
    let mut quoted = message.split('`').skip(1).step_by(2);
    let (name, known): (&str, Vec<&str>) = (quoted.next().unwrap_or(""), quoted.collect());
    if message.starts_with("unknown field") {
        return Some((format!("unknown key {name:?}"), did_you_mean(name, known)));
    }
    if message.starts_with("unknown variant") {
        return Some((format!("unknown value {name:?}"), did_you_mean(name, known)));
    }
    if message.starts_with("missing field") {
        let remedy = if name == "map" { "add it, such as map = \"road.osm\"" } else { "add it" };
        return Some((format!("the key {name:?} is missing"), remedy.into()));
    }
    let is_of_value = message.starts_with("invalid type") || message.starts_with("invalid value");
    is_of_value.then(|| {
        let what = of_types(message).unwrap_or_else(|| message.replace('\n', ", "));
        (what, "correct the value".into())
    })
}

/// A message of serde on a value of another type, in words of users.
fn of_types(message: &str) -> Option<String> {
    let (found, expected) = message.strip_prefix("invalid type: ")?.rsplit_once(", expected ")?;
    let found = match found.split_once(' ') {
        Some(("string", text)) => format!("the text {text}"),
        Some(("integer" | "boolean", value)) => value.replace('`', ""),
        Some(("floating", value)) => value.trim_start_matches("point ").replace('`', ""),
        Some(("unit", "variant")) => "a name only".into(),
        _ => match found {
            "sequence" => "a list".into(),
            "map" => "a table".into(),
            "null" => "nothing".into(),
            other => other.to_owned(),
        },
    };
    let expected = match expected {
        "f64" | "f32" => "a number".into(),
        "u64" | "u32" | "usize" | "i64" | "i32" | "a nonzero usize" => "a whole number".into(),
        "a string" | "string" => "a text".into(),
        "a boolean" => "true or false".into(),
        "a sequence" => "a list".into(),
        "a map" | "newtype variant" => "a table".into(),
        "path string" => "a path".into(),
        other if other.starts_with("struct ") => "a table".into(),
        other => other.replace("an array of length", "a list of length"),
    };
    Some(format!("this is {found}, but {expected} is expected"))
}

/// The position of a key of `table`, and its value.
fn entry<'t, 'i>(table: &'t DeTable<'i>, name: &str) -> Option<(Range<usize>, &'t DeValue<'i>)> {
    let (key, value) = table.iter().find(|(key, _)| key.get_ref() == name)?;
    Some((key.span(), value.get_ref()))
}

/// The position of an element of `list`, and its value.
fn element<'t, 'i>(list: &'t DeArray<'i>, number: &str) -> Option<(Range<usize>, &'t DeValue<'i>)> {
    let found = list.get(number.parse::<usize>().ok()?)?;
    Some((found.span(), found.get_ref()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn source(text: &str) -> Source {
        Source { path: "a.toml".into(), text: text.into() }
    }

    #[test]
    fn a_key_has_its_line_and_column() {
        let source = source("map = \"x\"\n\n[run]\n  seed = 1\nstep_s = 2\n");
        assert_eq!(source.place(&["map"]), "a.toml:1:1");
        assert_eq!(source.place(&["run", "seed"]), "a.toml:4:3");
        assert_eq!(source.place(&["run", "threads"]), "a.toml:3:2");
        assert_eq!(source.place(&["demand"]), "a.toml");
    }

    #[test]
    fn an_element_of_a_list_has_the_place_of_its_table() {
        let source = source("[[a.od]]\nfrom = 1\n[[a.od]]\nfrom = 2\n[b]\nlist = [[1, 2],\n [3, 4]]\n");
        assert_eq!(source.place(&["a", "od", "1", "from"]), "a.toml:4:1");
        assert_eq!(source.place(&["b", "list", "1"]), "a.toml:7:2");
        assert_eq!(source.place(&["b", "list", "2"]), "a.toml:6:1");
    }

    #[test]
    fn a_value_of_another_type_is_told_in_words_of_users() {
        let cases = [
            (
                "invalid type: string \"long\", expected f64",
                "this is the text \"long\", but a number is expected",
            ),
            ("invalid type: sequence, expected struct Demand", "this is a list, but a table is expected"),
            (
                "invalid type: floating point `6.5`, expected u64",
                "this is 6.5, but a whole number is expected",
            ),
            ("invalid type: boolean `true`, expected a map", "this is true, but a table is expected"),
        ];
        for (message, expected) in cases {
            assert_eq!(in_words(message).map(|it| it.0).as_deref(), Some(expected));
        }
    }

    #[test]
    fn columns_count_characters() {
        assert_eq!(source("# ü\nöö = 1").at("# ü\nöö".len()), "a.toml:2:3");
    }

    #[test]
    fn what_is_no_toml_is_refused_at_its_place() {
        let fault = source("a = 1\nb = = 2\n").parse::<toml::Table>().unwrap_err();
        assert_eq!(fault.place, "a.toml:2:5");
    }
}
