//! `scenario new`.

use std::collections::BTreeSet;
use std::fs;

use laneweave::scenario::Scenario;
use serde_json::Value;

use crate::command::program::{Folder, closed, maps};

/// Maps for these tests: with lights, with a table of forks, closed, with traffic on the left.
fn tried(folder: &Folder) -> Vec<String> {
    fs::write(folder.path().join("closed.osm"), closed()).unwrap();
    assert_eq!(folder.laneweave("generate weaving --driving-side left left.osm").code(), 0);
    let own = ["ramps", "town", "roundabout"].map(|it| format!("{}/{it}.osm", maps().display()));
    own.into_iter().chain(["closed.osm".into(), "left.osm".into()]).collect()
}

#[test]
fn a_scenario_as_it_was_written_runs_like_its_map() {
    let folder = Folder::new();
    for map in tried(&folder) {
        let run = folder.laneweave(&format!("scenario new {map} --out s.toml --force"));
        assert_eq!((run.code(), run.errors().as_str()), (0, ""), "{map}");
        assert_eq!(run.text(), "s.toml is written; edit it, then run: laneweave run s.toml\n");
        // On the closed loop a trip starts every 50 s.
        let duration = if map == "closed.osm" { 200 } else { 30 };
        let [bare, written] =
            [&map, "s.toml"].map(|it| folder.summary(&format!("{it} --duration {duration} --record 0")));
        for field in ["state_hash", "entered", "demand_veh_h", "estimated_capacity_veh_h"] {
            assert_eq!(bare[field], written[field], "{map}: {field}");
        }
        assert!(bare["entered"].as_u64().unwrap() > 0, "{map}");
    }
}

/// The file with every key that was commented out.
fn with_all_keys(text: &str) -> String {
    let line = |it: &str| match it.strip_prefix('#') {
        Some(key) if !key.starts_with(' ') => format!("{key}\n"),
        _ => format!("{it}\n"),
    };
    text.lines().map(line).collect()
}

#[test]
fn every_key_behind_a_hash_is_one() {
    let folder = Folder::new();
    for map in tried(&folder) {
        assert_eq!(folder.laneweave(&format!("scenario new {map} --out s.toml --force")).code(), 0);
        let text = folder.read("s.toml");
        let all = with_all_keys(&text);
        assert!(all.lines().count() == text.lines().count() && all != text);
        let scenario: Scenario = toml::from_str(&all).unwrap_or_else(|error| panic!("{map}: {error}\n{all}"));
        assert!(scenario.model.is_some() && scenario.demand.od.len() == 1 && !scenario.turns.is_empty());
        assert_eq!(scenario.demand.profile.len(), 2);
    }
}

#[test]
fn each_default_behind_a_hash_changes_nothing() {
    let folder = Folder::new();
    let map = format!("{}/grid.osm", maps().display());
    let bare = folder.summary(&format!("{map} --duration 20 --record 0"))["state_hash"].clone();
    assert_eq!(folder.laneweave(&format!("scenario new {map} --out s.toml")).code(), 0);
    let text = folder.read("s.toml");
    // All keys except the examples, which the text marks as such.
    let examples = ["model", "commands", "profile", "from", "to", "left", "straight", "right"];
    let mut is_example = false;
    let mut kept = String::new();
    for line in text.lines() {
        let key = line.strip_prefix('#').filter(|it| !it.starts_with(' '));
        if let Some(header) = key.filter(|it| it.starts_with('[')) {
            is_example = [
                "[[demand.od]]",
                "[[demand.line]]",
                "[[demand.line.stops]]",
                "[[turns]]",
                "[[external]]",
                "[[obstacle]]",
            ]
            .contains(&header);
        }
        let name = key.and_then(|it| it.split(' ').next()).unwrap_or_default();
        let is_kept = !is_example && !examples.contains(&name);
        kept += key.filter(|_| is_kept).unwrap_or(line);
        kept += "\n";
        // Text outside of lists comes after a blank line.
        is_example = is_example && !line.is_empty();
    }
    fs::write(folder.path().join("all.toml"), &kept).unwrap();
    assert!(kept.contains("\n[[signals]]\n") && kept.contains("\nvehicles_per_hour = "));
    assert_eq!(folder.summary("all.toml --duration 20 --record 0")["state_hash"], bare);
}

/// All keys of a schema, at any depth.
fn keys(schema: &Value, found: &mut BTreeSet<String>) {
    if let Some(properties) = schema["properties"].as_object() {
        found.extend(properties.keys().cloned());
    }
    match schema {
        Value::Object(all) => all.values().for_each(|it| keys(it, found)),
        Value::Array(all) => all.iter().for_each(|it| keys(it, found)),
        _ => {}
    }
}

#[test]
fn every_key_of_the_schema_is_in_the_file_with_its_meaning() {
    let folder = Folder::new();
    assert_eq!(folder.laneweave("scenario new MAPS/grid.osm").code(), 0);
    let text = folder.read("grid.toml");
    let words: Vec<&str> = text.split(|it: char| !(it.is_alphanumeric() || it == '_')).collect();
    let mut found = BTreeSet::new();
    keys(&Scenario::schema().to_value(), &mut found);
    assert!(found.len() > 40);
    let missing: Vec<&String> = found.iter().filter(|it| !words.contains(&it.as_str())).collect();
    assert!(missing.is_empty(), "{missing:?}");
    let prose = text.lines().map(|it| it.trim_start_matches(['#', ' '])).collect::<Vec<_>>().join(" ");
    for meaning in [
        "Seed of all random numbers.",
        "Maximum green [s], if traffic extends the phase",
        "Share of free drivers.",
    ] {
        assert!(prose.contains(meaning), "{meaning}");
    }
}

#[test]
fn options_of_reading_are_kept() {
    let folder = Folder::new();
    assert_eq!(folder.laneweave("scenario new MAPS/on_ramp.osm --law usa --origin 49,-8.5").code(), 0);
    let text = folder.read("on_ramp.toml");
    assert!(text.contains("\nlaw = \"usa\"\n") && text.contains("\norigin = [49.0, -8.5]\n"), "{text}");
}

#[test]
fn the_map_is_named_from_the_folder_of_the_file_on() {
    let folder = Folder::new();
    fs::create_dir_all(folder.path().join("a/b")).unwrap();
    fs::create_dir_all(folder.path().join("a/c")).unwrap();
    assert_eq!(folder.laneweave("generate roundabout a/b/ring.osm").code(), 0);
    assert_eq!(folder.laneweave("scenario new a/b/ring.osm --out a/c/s.toml").code(), 0);
    assert!(folder.read("a/c/s.toml").contains("\nmap = \"../b/ring.osm\"\n"));
}

#[test]
fn a_file_is_replaced_by_force_only() {
    let folder = Folder::new().with("mine.toml", "mine");
    let run = folder.laneweave("scenario new MAPS/on_ramp.osm --out mine.toml");
    assert_eq!(
        (run.code(), run.errors().as_str()),
        (
            2,
            "error: mine.toml: this file already exists; choose another name with --out, or replace it with --force\n"
        )
    );
    assert_eq!(folder.read("mine.toml"), "mine");
    assert_eq!(folder.laneweave("scenario new MAPS/on_ramp.osm --out mine.toml --force").code(), 0);
    assert!(folder.read("mine.toml").contains("[demand.entrances]"));
    for (line, message) in [
        ("mine.toml", "this is a scenario, but a map is expected"),
        (
            "MAPS/on_ramp.osm --out mine.txt",
            "this is not a valid name for a scenario file; use a name that ends in .toml",
        ),
        ("none.osm", "there is no such file"),
        ("MAPS/on_ramp.osm --out none/mine.toml", "cannot be written"),
    ] {
        let run = folder.laneweave(&format!("scenario new {line}"));
        assert_eq!(run.code(), 2);
        assert!(run.errors().contains(message), "{line}: {}", run.errors());
    }
}
