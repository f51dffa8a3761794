//! The built-in styles, and styles by name or file.

use std::path::Path;

use laneweave_maps::FileKind;

use super::template::StyleTemplate;
use crate::fault::{Fault, did_you_mean};
use crate::source::Source;

/// A built-in style file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BuiltIn {
    /// Its name.
    pub name: &'static str,
    /// Its text.
    pub text: &'static str,
}

macro_rules! built_in {
    ($($name:literal),*) => {
        &[$(BuiltIn { name: $name, text: include_str!(concat!("../../assets/styles/", $name, ".toml")) }),*]
    };
}

/// The built-in styles.
pub const BUILT_IN: &[BuiltIn] = built_in![
    "aggressive",
    "conservative",
    "cautious",
    "inattentive",
    "altruistic",
    "egoistic",
    "paper-aggressive",
    "paper-conservative",
    "mobil",
    "mobil-european",
    "lmrs",
    "constant-hazard"
];

/// The default mixture: the paper's, one aggressive driver to 7.4 conservative ones.
pub const DEFAULT_MIXTURE: [(&str, f64); 2] = [("aggressive", 1.0), ("conservative", 7.4)];

/// The built-in style of this name.
pub fn built_in(name: &str) -> Option<&'static BuiltIn> {
    BUILT_IN.iter().find(|it| it.name == name)
}

/// The text of the style called `name`: a built-in one, or a file with a path that ends in `.toml`, relative to
/// `folder`.
///
/// # Errors
/// If there is none, or the file cannot be read. If the name is wrong, the caller sets the place.
pub fn find(name: &str, folder: &Path, place: impl Fn() -> String) -> Result<Source, Fault> {
    if let Some(it) = built_in(name) {
        return Ok(Source { path: format!("styles/{name}.toml").into(), text: it.text.into() });
    }
    let kind = FileKind::by_name(Path::new(name));
    if let FileKind::Toml = kind {
        let path = folder.join(name);
        let source = Source::read(&path).map_err(|Fault { place: file, what, remedy, .. }| {
            Fault::new(place(), format!("style file {file}: {what}"), remedy)
        })?;
        if source.is_scenario() {
            let what = format!("{name} is a scenario, but a style is expected");
            return Err(Fault::new(place(), what, format!("run it: laneweave run {name}")));
        }
        return Ok(source);
    }
    if let FileKind::Map(_) = kind {
        let what = format!("{name} is a map, but a style is expected");
        return Err(Fault::new(place(), what, "list the styles with: laneweave styles list"));
    }
    let names = BUILT_IN.iter().map(|it| it.name);
    let remedy = format!("{} (or give the path of a style file, FILE.toml)", did_you_mean(name, names));
    Err(Fault::new(place(), format!("unknown style {name:?}"), remedy))
}

/// The text of a style file like `source`, with its comments, and with the name `name`.
///
/// # Errors
/// If the name is invalid, or `source` is no style.
pub fn copy(source: &Source, name: &str) -> Result<String, Fault> {
    let is_name = |it: char| it.is_alphanumeric() || matches!(it, '-' | '_' | '.' | ' ');
    if name.trim().is_empty() || !name.chars().all(is_name) {
        let remedy = "choose letters, digits, - and _";
        return Err(Fault::new("NAME", format!("{name:?} is not a valid name for a style"), remedy));
    }
    if built_in(name).is_some() {
        let what = format!("{name:?} is the name of a built-in style");
        return Err(Fault::new("NAME", what, "choose another name"));
    }
    StyleTemplate::parse(source)?;
    let renamed = source.text.lines().map(|line| {
        let is_name = line.strip_prefix("name").is_some_and(|rest| rest.trim_start().starts_with('='));
        if is_name { format!("name = {name:?}\n") } else { format!("{line}\n") }
    });
    Ok(renamed.collect())
}
