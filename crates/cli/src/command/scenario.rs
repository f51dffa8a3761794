//! `laneweave scenario`.

use std::path::{Component, Path, PathBuf};

use clap::{Args, Subcommand, ValueHint};
use laneweave::maps::{FileKind, uncompressed};
use laneweave::output::write_whole;
use laneweave::scenario::{Origin, Scenario};
use laneweave::{Fault, Simulation};

use super::check::Reading;
use super::{examples, say};

#[derive(Debug, Subcommand)]
pub(crate) enum ScenarioCommand {
    /// Write a scenario for a map to edit, with the meaning and the default of every key.
    #[command(after_help = examples::SCENARIO_NEW)]
    New(New),
}

#[derive(Debug, Args)]
pub(crate) struct New {
    /// The map (Lanelet2: .osm, CommonRoad: .xml; compressed: .osm.gz).
    #[arg(value_hint = ValueHint::FilePath)]
    map: PathBuf,
    /// The file to write (.toml) [default: the name of the map, in this folder].
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    out: Option<PathBuf>,
    /// Replace the file if it exists.
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    reading: Reading,
}

impl ScenarioCommand {
    pub(crate) fn execute(self) -> Result<(), Fault> {
        match self {
            ScenarioCommand::New(new) => new.execute(),
        }
    }
}

impl New {
    fn execute(self) -> Result<(), Fault> {
        if let FileKind::Toml = FileKind::by_name(&self.map) {
            let what = "this is a scenario, but a map is expected";
            return Err(Fault::new(self.map.display(), what, "give the map instead, or copy the file"));
        }
        let file = self.out.clone().unwrap_or_else(|| named_after(&self.map));
        self.check(&file)?;
        let mut scenario =
            Scenario { map_options: self.reading.options(), ..Scenario::of_map(self.map.clone()) };
        let mut origin = Origin::default();
        origin.replaced("map_options.origin", "--origin");
        let simulation = Simulation::from_scenario(&scenario, &origin)?;
        scenario.map = from_folder_of(&file, &self.map);
        write_whole(&file, &simulation.to_toml(&scenario)?)?;
        say(&format!("{0} is written; edit it, then run: laneweave run {0}\n", file.display()))
    }

    /// Whether `file` may be written.
    fn check(&self, file: &Path) -> Result<(), Fault> {
        if !matches!(FileKind::by_name(file), FileKind::Toml) {
            return Err(Fault::new(
                file.display(),
                "this is not a valid name for a scenario file",
                "use a name that ends in .toml",
            ));
        }
        if file.exists() && !self.force {
            let remedy = "choose another name with --out, or replace it with --force";
            return Err(Fault::new(file.display(), "this file already exists", remedy));
        }
        Ok(())
    }
}

/// The name of a scenario file after that of `map`.
fn named_after(map: &Path) -> PathBuf {
    PathBuf::from(uncompressed(map).as_ref()).with_extension("toml")
}

/// The relative path of `map` from the folder of `file`; `map` itself where there is none.
fn from_folder_of(file: &Path, map: &Path) -> PathBuf {
    let folder = file.parent().filter(|it| !it.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let (Ok(folder), Ok(whole)) = (folder.canonicalize(), map.canonicalize()) else { return map.to_owned() };
    let [from, to] = [&folder, &whole].map(|it| it.components().collect::<Vec<Component>>());
    let common = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
    // There is no relative path to another drive.
    if common == 0 {
        return whole;
    }
    let up = from[common..].iter().map(|_| Component::ParentDir);
    up.chain(to[common..].iter().copied()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scenario_is_called_like_its_map() {
        assert_eq!(named_after(Path::new("maps/town.osm.gz")), Path::new("town.toml"));
        assert_eq!(named_after(Path::new("a.xml")), Path::new("a.toml"));
    }
}
