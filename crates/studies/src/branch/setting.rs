//! A changed setting: `STYLE.KEY=VALUE`, or `commands=FILE`.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use laneweave_scenario::style::StyleTemplate;
use laneweave_scenario::{Fault, did_you_mean};
use toml::Value;

/// A changed setting.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// The text as given.
    text: String,
    changed: Changed,
}

#[derive(Clone, Debug, PartialEq)]
enum Changed {
    /// Other commands, or none.
    Commands(Option<PathBuf>),
    /// A value of the styles.
    Value(StyleValue),
}

/// A key of one style, or of all, with another value.
#[derive(Clone, Debug, PartialEq)]
struct StyleValue {
    /// The style; `None`: all.
    style: Option<String>,
    /// The keys, from the outermost to the innermost.
    path: Vec<String>,
    value: Value,
}

/// The name for all styles.
const ALL: &str = "style";
/// The key of the commands, and its value for none.
const COMMANDS: &str = "commands";
const NONE: &str = "none";
/// The section in which keys are searched that are no sections of a style.
const USUAL_SECTION: &str = "change";
/// The sections and keys at the top level of a style.
const TOP: [&str; 8] =
    ["speed_factor", "follow", "change", "safety", "attention", "manner", "yielding", "guidance"];

impl FromStr for Setting {
    type Err = String;

    /// `style.change.speed.weight=2`, or with the name of a style in the place of `style`; `change` may be left out. Or
    /// `commands=FILE`, `commands=none`.
    fn from_str(text: &str) -> Result<Setting, String> {
        let (key, value) =
            text.split_once('=').ok_or("write STYLE.KEY=VALUE, such as style.speed.weight=2")?;
        if key.trim() == COMMANDS {
            let file = Some(value.trim()).filter(|it| *it != NONE).map(PathBuf::from);
            return Ok(Setting { text: text.into(), changed: Changed::Commands(file) });
        }
        let mut keys = key.trim().split('.').map(str::to_owned);
        let style = keys.next().filter(|it| !it.is_empty()).ok_or("the name of a style is missing")?;
        let mut path: Vec<String> = keys.collect();
        if path.is_empty() {
            return Err(format!(
                "the key is missing: write {style}.KEY=VALUE, such as {style}.speed.weight=2"
            ));
        }
        if !TOP.contains(&path[0].as_str()) {
            path.insert(0, USUAL_SECTION.into());
        }
        let value = value.trim();
        let document: Result<toml::Table, _> = format!("value = {value}").parse();
        // A value that is no TOML is a text.
        let value = document
            .ok()
            .and_then(|mut it| it.remove("value"))
            .unwrap_or_else(|| Value::String(value.into()));
        let style = Some(style).filter(|it| it != ALL);
        Ok(Setting { text: text.into(), changed: Changed::Value(StyleValue { style, path, value }) })
    }
}

impl Setting {
    /// The text as given.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The file of other commands, if it sets them; in it `None` for none.
    pub(super) fn commands(&self) -> Option<Option<&Path>> {
        match &self.changed {
            Changed::Commands(file) => Some(file.as_deref()),
            Changed::Value(_) => None,
        }
    }

    /// Changes the styles of `mixture` that the setting names; if it names all, those that have the key.
    pub(super) fn apply(&self, mixture: &mut [(StyleTemplate, f64)]) -> Result<(), Fault> {
        let Changed::Value(setting) = &self.changed else { return Ok(()) };
        setting.apply(mixture, &format!("--set {}", self.text))
    }
}

impl StyleValue {
    fn apply(&self, mixture: &mut [(StyleTemplate, f64)], place: &str) -> Result<(), Fault> {
        let names: Vec<String> = mixture.iter().map(|(it, _)| it.typical().name.clone()).collect();
        if let Some(style) = &self.style
            && !names.contains(style)
        {
            let known = names.iter().map(String::as_str).chain([ALL]);
            return Err(Fault::new(
                place,
                format!("the run has no style {style:?}"),
                did_you_mean(style, known),
            ));
        }
        let is_meant = |it: &StyleTemplate| match &self.style {
            Some(style) => *style == it.typical().name,
            None => it.has(&self.path),
        };
        let changed = |it: &StyleTemplate| it.with_value(&self.path, self.value.clone(), place);
        if let Some((any, _)) = mixture.first()
            && !mixture.iter().any(|(it, _)| is_meant(it))
        {
            // No style has the key: any style gives the error message.
            return changed(any).map(drop);
        }
        for (template, _) in mixture.iter_mut().filter(|(it, _)| is_meant(it)) {
            *template = changed(template)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_setting_names_a_style_a_key_and_a_value() {
        let setting = |text: &str| match text.parse::<Setting>().unwrap().changed {
            Changed::Value(it) => it,
            other => panic!("{other:?}"),
        };
        let path = |it: &StyleValue| it.path.join(".");
        let all = setting("style.speed.weight=2");
        assert_eq!((all.style.as_deref(), path(&all).as_str()), (None, "change.speed.weight"));
        assert_eq!(all.value, Value::Integer(2));
        let one = setting("aggressive.follow.time_gap = 0.9");
        assert_eq!((one.style.as_deref(), path(&one).as_str()), (Some("aggressive"), "follow.time_gap"));
        assert_eq!(one.value, Value::Float(0.9));
        assert_eq!(setting("style.rule=threshold").value, Value::String("threshold".into()));
        let commands =
            |text: &str| text.parse::<Setting>().unwrap().commands().map(|it| it.map(Path::to_owned));
        assert_eq!(commands("commands = a.csv"), Some(Some("a.csv".into())));
        assert_eq!(commands("commands=none"), Some(None));
        assert_eq!(commands("style.speed.weight=2"), None);
        for wrong in ["speed", "style=2", ".speed=1"] {
            assert!(wrong.parse::<Setting>().is_err(), "{wrong}");
        }
    }
}
