//! The provenance of results, which is written into every file with a place for it.

use serde::Serialize;

/// The description of a run by which its files can be made again.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Provenance {
    /// Version of the program.
    pub version: String,
    /// The command line, beginning with the name of the program.
    pub command: String,
    /// Seed of all random numbers.
    pub seed: u64,
    /// Hash of everything on which the run depends.
    pub fingerprint: String,
    /// The scenario with all defaults and options, as TOML, as stored with the results.
    pub scenario: String,
}

impl Provenance {
    /// The provenance of a run with the [stored](crate::record::keep) `scenario`, with its seed and its
    /// [fingerprint](crate::record::fingerprint).
    pub fn of(scenario: String, seed: u64, fingerprint: String) -> Provenance {
        let command = scenario.lines().next().and_then(|it| it.strip_prefix("# ")).unwrap_or_default();
        Provenance {
            version: env!("CARGO_PKG_VERSION").into(),
            command: command.into(),
            seed,
            fingerprint,
            scenario,
        }
    }

    /// Keys and values for the files.
    pub(crate) fn notes(&self) -> [(&'static str, String); 4] {
        let Provenance { version, command, seed, scenario, .. } = self;
        [
            ("laneweave.version", version.clone()),
            ("laneweave.command", command.clone()),
            ("laneweave.seed", seed.to_string()),
            ("laneweave.scenario", scenario.clone()),
        ]
    }
}

/// The command line with these arguments, on one line, for a shell.
pub fn command_line(arguments: impl IntoIterator<Item = String>) -> String {
    let words = ["laneweave".into()].into_iter().chain(arguments.into_iter().map(quoted));
    words.collect::<Vec<String>>().join(" ").replace(char::is_control, " ")
}

/// An argument, quoted for a shell if necessary.
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
    fn the_command_can_be_given_to_a_shell_and_is_one_line() {
        let arguments = ["run", "my maps/a.osm", "--seed", "7", "--out", "it's\nhere"].map(String::from);
        let command = command_line(arguments);
        assert_eq!(command, "laneweave run 'my maps/a.osm' --seed 7 --out 'it'\\''s here'");
        let provenance = Provenance::of(format!("# {command}\n\nmap = \"a.osm\"\n"), 7, String::new());
        assert_eq!((provenance.command, provenance.seed), (command, 7));
    }
}
