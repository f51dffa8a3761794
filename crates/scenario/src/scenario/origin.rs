//! The source of each value of a scenario: its file, or an option of the command.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use laneweave_maps::FileKind;

use super::{Replay, Scenario};
use crate::fault::{Fault, FaultKind};
use crate::source::Source;
use crate::style::find;
use crate::sumo;

/// The demo scenario and its map, which are built in.
const DEMO: &str = include_str!("../../assets/demo.toml");
const DEMO_MAP: &str = include_str!("../../assets/town.osm");

/// Whether a file is a configuration of SUMO, by its name.
fn is_configuration(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    name.ends_with(".sumocfg") || name.ends_with(".sumo.cfg")
}

/// The source of the values of a scenario.
#[derive(Clone, Debug, Default)]
pub struct Origin {
    source: Option<Source>,
    /// The map's text, if it is built in.
    pub(super) map: Option<&'static str>,
    /// Options by the key whose value they replace.
    options: BTreeMap<String, String>,
    /// Style files in memory, by the names that a scenario gives them.
    styles: BTreeMap<String, String>,
}

impl Origin {
    /// The scenario in the file at `path`, or of the map there.
    ///
    /// # Errors
    /// If the scenario file cannot be read or is no scenario. A map is not read yet.
    pub fn open(path: &Path) -> Result<(Scenario, Origin), Fault> {
        match FileKind::by_name(path) {
            FileKind::Toml => Origin::from_source(Source::read(path)?),
            _ if is_configuration(path) => Ok((sumo::open(path)?, Origin::default())),
            _ => Ok((Scenario::of_map(path.to_owned()), Origin::default())),
        }
    }

    /// The scenario in a text. Its relative paths start in `folder`.
    ///
    /// # Errors
    /// If the text is no scenario.
    pub fn from_text(text: &str, folder: &Path) -> Result<(Scenario, Origin), Fault> {
        Origin::from_source(Source { path: folder.join("scenario.toml"), text: text.into() })
    }

    fn from_source(source: Source) -> Result<(Scenario, Origin), Fault> {
        let path = &source.path;
        if source.is_style() {
            let what = "this is a driver style, but a scenario or a map is expected";
            let remedy = format!("run a map with it: laneweave run MAP --style {}=1", path.display());
            return Err(Fault::new(path.display(), what, remedy));
        }
        let mut scenario: Scenario = source.parse()?;
        scenario.map = source.folder().join(&scenario.map);
        scenario.commands = scenario.commands.map(|it| source.folder().join(it));
        let Replay { recording, columns, .. } = &mut scenario.replay;
        recording.iter_mut().chain(columns).for_each(|it| *it = source.folder().join(&*it));
        scenario.sumo.files_mut().for_each(|it| *it = source.folder().join(&*it));
        Ok((scenario, Origin { source: Some(source), ..Origin::default() }))
    }

    /// The demo scenario.
    ///
    /// # Errors
    /// None, as long as the file in the repository is a scenario.
    pub fn demo() -> Result<(Scenario, Origin), Fault> {
        let source = Source { path: "scenarios/demo.toml".into(), text: DEMO.into() };
        let mut scenario: Scenario = source.parse()?;
        scenario.map = PathBuf::from("maps/town.osm");
        Ok((scenario, Origin { source: Some(source), map: Some(DEMO_MAP), ..Origin::default() }))
    }

    /// Keeps the text of a style file for the style that a scenario calls `name`.
    pub fn with_style(mut self, name: &str, text: &str) -> Origin {
        self.styles.insert(name.to_owned(), text.to_owned());
        self
    }

    /// The style that a scenario calls `name`: one that is kept in memory, a built-in one, or a file.
    ///
    /// # Errors
    /// If there is no such style, or its file cannot be read.
    pub fn style(&self, name: &str) -> Result<Source, Fault> {
        match self.styles.get(name) {
            Some(text) => Ok(Source { path: name.into(), text: text.clone() }),
            None => find(name, self.style_folder(), || self.place(&["styles", name]))
                .map_err(|fault| fault.of_kind(FaultKind::Style)),
        }
    }

    /// Records that `option` has replaced the value of `key`.
    pub fn replaced(&mut self, key: impl Into<String>, option: impl Into<String>) {
        self.options.insert(key.into(), option.into());
    }

    /// The keys with replaced values, each with its option.
    pub fn options(&self) -> impl Iterator<Item = (&str, &str)> {
        self.options.iter().map(|(key, option)| (key.as_str(), option.as_str()))
    }

    /// The place of the key at `path`: an option, a place in the scenario file, or else the key itself.
    pub fn place(&self, path: &[&str]) -> String {
        let option = (1..=path.len()).find_map(|n| self.options.get(path[..n].join(".").as_str()));
        option.cloned().or_else(|| self.in_file(path)).unwrap_or(path.join("."))
    }

    /// The place of the key at `path` in the scenario file, if there is one.
    pub(super) fn in_file(&self, path: &[&str]) -> Option<String> {
        self.source.as_ref().map(|source| source.place(path))
    }

    /// The map's text, if it is built in.
    pub fn built_in_map(&self) -> Option<&'static str> {
        self.map
    }

    /// The folder for relative paths of style files.
    pub fn style_folder(&self) -> &Path {
        match &self.source {
            Some(source) if !self.options.contains_key("styles") => source.folder(),
            _ => Path::new(""),
        }
    }
}
