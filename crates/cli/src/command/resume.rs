//! The check that the options beside `--resume` are those of the resumed run.

use laneweave::Fault;
use laneweave::record::{SCENARIO, style_texts};
use laneweave::scenario::{Origin, Scenario};
use toml::{Table, Value};

/// A scenario, and the source of its values.
type Sourced<'a> = (&'a Scenario, &'a Origin);

/// Results do not depend on them.
const FREE: [&str; 2] = ["run.threads", "map_options.max_size_mb"];
/// An option that replaces the demand replaces these as well.
const DEMANDS: [&str; 3] = ["demand.vehicles_per_hour", "demand.entrances", "demand.od"];

/// Whether `asked`, the scenario of the run with the options of the command line, is that of the run itself.
///
/// # Errors
/// The options that differ, each with its value and that of the run.
pub(super) fn same_run(run: Sourced, asked: Sourced) -> Result<(), Fault> {
    let [of_run, of_asked] = [table(run.0)?, table(asked.0)?];
    let mut differing = Vec::new();
    for (key, option) in asked.1.options().filter(|(key, _)| !FREE.contains(key)) {
        let is_same = match key {
            "styles" => style_texts(run.0, run.1)? == style_texts(asked.0, asked.1)?,
            _ if key == DEMANDS[0] => DEMANDS.iter().all(|it| at(&of_run, it) == at(&of_asked, it)),
            _ => at(&of_run, key) == at(&of_asked, key),
        };
        if !is_same {
            let [given, kept] = [&of_asked, &of_run].map(|it| shown(at(it, key)));
            differing.push(format!("{option} {given} instead of {kept}"));
        }
    }
    if differing.is_empty() {
        return Ok(());
    }
    let remedy = "remove these options, or run again from the beginning without --resume";
    Err(Fault::new(
        "--resume",
        format!("the options differ from those of the run: {}", differing.join(", ")),
        remedy,
    ))
}

fn table(scenario: &Scenario) -> Result<Table, Fault> {
    Table::try_from(scenario).map_err(|error| Fault::bug(SCENARIO, error))
}

/// The value of a key such as `run.seed`.
fn at<'a>(table: &'a Table, key: &str) -> Option<&'a Value> {
    let (first, rest) = key.split_once('.').map_or((key, None), |(first, rest)| (first, Some(rest)));
    match (table.get(first)?, rest) {
        (value, None) => Some(value),
        (Value::Table(inner), Some(rest)) => at(inner, rest),
        _ => None,
    }
}

fn shown(value: Option<&Value>) -> String {
    match value {
        None => "none".into(),
        Some(Value::Float(number)) => number.to_string(),
        Some(Value::Table(table)) => {
            let pairs: Vec<String> =
                table.iter().map(|(name, value)| format!("{name}={}", shown(Some(value)))).collect();
            pairs.join(" ")
        }
        Some(Value::String(text)) => text.clone(),
        Some(value) => value.to_string(),
    }
}
