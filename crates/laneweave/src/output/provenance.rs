//! Where results come from: noted in every file that has a place for it.

use serde::Serialize;

use crate::fault::Fault;
use crate::scenario::Scenario;

/// What was run, so that a file can be made again.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Provenance {
    /// Version of the program.
    pub version: String,
    /// The command line, beginning with the name of the program.
    pub command: String,
    /// Seed of all random draws.
    pub seed: u64,
    /// The scenario with all defaults and options, as TOML.
    pub scenario: String,
}

impl Provenance {
    /// Of `scenario`, as `arguments` of the command line made it.
    ///
    /// # Errors
    /// If the scenario cannot be written as TOML, which is a bug.
    pub fn of(scenario: &Scenario, arguments: impl IntoIterator<Item = String>) -> Result<Provenance, Fault> {
        let command: Vec<String> =
            ["laneweave".into()].into_iter().chain(arguments.into_iter().map(quoted)).collect();
        let toml = toml::to_string(scenario)
            .map_err(|error| Fault::new("the scenario", error, "report this as a bug"))?;
        Ok(Provenance {
            version: env!("CARGO_PKG_VERSION").into(),
            command: command.join(" "),
            seed: scenario.run.seed,
            scenario: toml,
        })
    }

    /// Keys and values for the files.
    pub(super) fn notes(&self) -> [(&'static str, String); 4] {
        let Provenance { version, command, seed, scenario } = self;
        [
            ("laneweave.version", version.clone()),
            ("laneweave.command", command.clone()),
            ("laneweave.seed", seed.to_string()),
            ("laneweave.scenario", scenario.clone()),
        ]
    }
}

/// An argument as a shell takes it for one.
fn quoted(argument: String) -> String {
    let is_plain = |it: char| it.is_alphanumeric() || "-_=./:,+%@".contains(it);
    if !argument.is_empty() && argument.chars().all(is_plain) {
        return argument;
    }
    format!("'{}'", argument.replace('\'', "'\\''"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_can_be_given_to_a_shell_and_the_scenario_read_again() {
        let mut scenario = Scenario::of_map("my maps/a.osm".into());
        scenario.run.seed = 7;
        let arguments = ["run", "my maps/a.osm", "--seed", "7", "--out", "it's"].map(String::from);
        let provenance = Provenance::of(&scenario, arguments).unwrap();
        assert_eq!(provenance.command, "laneweave run 'my maps/a.osm' --seed 7 --out 'it'\\''s'");
        assert_eq!(provenance.seed, 7);
        assert_eq!(toml::from_str(&provenance.scenario), Ok(scenario));
    }
}
