//! `replay`: recorded vehicles beside drivers who react.

use std::fs;

use serde_json::Value;

use crate::command::program::Folder;

/// A folder with a recording of a motorway, `observed.csv`.
fn recorded() -> Folder {
    let folder = Folder::new();
    for line in [
        "run MAPS/ramps.osm --duration 40 --demand 3000 --warmup 30 --record 0 --quiet --out driven",
        "observe driven",
    ] {
        let run = folder.laneweave(line);
        assert_eq!(run.code(), 0, "{}", run.errors());
    }
    folder
}

fn replayed(folder: &Folder, options: &str) -> Value {
    let run = folder.laneweave(&format!("replay observed.csv --map MAPS/ramps.osm --json {options}"));
    assert_eq!((run.code(), run.errors().as_str()), (0, ""), "{options}");
    serde_json::from_str(&run.text()).expect("it is JSON")
}

fn refusal(folder: &Folder, line: &str) -> String {
    let run = folder.laneweave(line);
    assert_eq!(run.code(), 2, "{line}: {}", run.text());
    run.errors()
}

fn summary(folder: &Folder, dir: &str) -> Value {
    serde_json::from_str(&folder.read(&format!("{dir}/summary.json"))).expect("it is JSON")
}

#[test]
fn with_nobody_reactive_there_are_the_tables_of_a_run_and_no_driver() {
    let folder = recorded();
    let report = replayed(&folder, "");
    assert_eq!((&report["reactive"], &report["drivers"]), (&0.into(), &Value::Array(Vec::new())));
    let recorded = report["recorded"].as_u64().expect("a number");
    assert!(recorded > 30 && report["vehicles"].as_array().map(Vec::len) == Some(recorded as usize));
    let summary = summary(&folder, "replay");
    assert_eq!(summary["inserted"], recorded);
    assert_eq!((&summary["lane_changes"], &summary["emergency_brakings"]), (&0.into(), &0.into()));
    for file in ["trajectories.parquet", "trips.parquet", "report.html", "replay.html", "replay.json"] {
        assert!(fs::metadata(folder.path().join("replay").join(file)).is_ok_and(|it| it.len() > 0), "{file}");
    }
}

#[test]
fn drivers_react_and_the_same_replay_is_the_same_again() {
    let folder = recorded();
    let report = replayed(&folder, "--reactive 0.3 --rollouts 2 --style conservative=1 --out a");
    let models: Vec<&Value> =
        report["models"].as_array().expect("a list").iter().map(|it| &it["model"]).collect();
    assert_eq!(models, ["own", "null", "mobil"]);
    let own = &report["models"][0];
    assert!(report["reactive"].as_u64() > Some(10) && own["parting"]["after"].as_array().is_some());
    assert!(report["models"][1]["difference"]["half_width"].as_f64() > Some(0.0), "{report}");
    assert_eq!(report, replayed(&folder, "--reactive 0.3 --rollouts 2 --style conservative=1 --out b"));
    let hash = |dir: &str| summary(&folder, dir)["state_hash"].clone();
    assert_eq!(hash("a"), hash("b"));
    // What is kept with the results runs again, and can be explained.
    let again = folder.laneweave("run a/scenario.toml --threads 2 --quiet --out again");
    assert_eq!((again.code(), again.errors().as_str()), (0, ""));
    assert_eq!(hash("a"), hash("again"));
    let page = folder.read("a/replay.html");
    assert!(page.contains("Collisions, by fault") && page.contains("How likely the record is"));
    let explained = folder.laneweave("explain a --summary");
    assert!(explained.code() == 0 && explained.text().contains("conservative"), "{}", explained.errors());
    let branch = folder.laneweave("branch a --at 20 --set style.courtesy.weight=0");
    assert_eq!(branch.code(), 0, "{}", branch.errors());
}

#[test]
fn chosen_vehicles_react_from_a_time_on() {
    let folder = recorded();
    let known = replayed(&folder, "--duration 5");
    let ids: Vec<i64> = known["vehicles"].as_array().expect("a list")[..3]
        .iter()
        .map(|it| it["recorded"].as_i64().expect("an id"))
        .collect();
    let report = replayed(
        &folder,
        &format!("--reactive-ids {},{} --from 3 --rollouts 1 --against mobil", ids[0], ids[2]),
    );
    let drivers = report["drivers"].as_array().expect("a list");
    let of = |it: &Value| {
        (it["recorded"].as_i64(), it["from_s"].as_f64().is_some_and(|it| (3.0..3.2).contains(&it)))
    };
    let mut found: Vec<_> = drivers.iter().map(of).collect();
    found.sort();
    let mut expected = [(Some(ids[0]), true), (Some(ids[2]), true)];
    expected.sort();
    assert_eq!(found, expected);
}

#[test]
fn what_cannot_be_replayed_is_refused_with_a_remedy() {
    let folder = recorded();
    let with =
        |options: &str| refusal(&folder, &format!("replay observed.csv --map MAPS/ramps.osm {options}"));
    assert!(refusal(&folder, "replay observed.csv").contains("needs the map of its location; add --map MAP"));
    assert!(refusal(&folder, "replay nowhere.csv --map MAPS/ramps.osm").contains("nowhere.csv"));
    let elsewhere = refusal(&folder, "replay observed.csv --map MAPS/roundabout.osm");
    assert!(elsewhere.contains("most of the recording lies outside all lanelets: it covers"), "{elsewhere}");
    assert!(with("--reactive 1.5").contains("--reactive: a share of 1.5; choose 0 to 1"));
    assert!(with("--from -1").contains("--from"));
    let unknown = with("--reactive-ids 123456789");
    assert!(
        unknown.contains("--reactive-ids: the recording has no motor vehicle 123456789; choose among"),
        "{unknown}"
    );
    assert!(with("--style brave=1").contains("brave"));
    assert!(with("--record 0.05").contains("--record"));
    assert!(!folder.path().join("replay").exists(), "nothing is written before everything has been checked");
    let head: Vec<String> = folder.read("observed.csv").lines().take(2).map(str::to_owned).collect();
    let folder = folder.with("one.csv", &(head.join("\n") + "\n"));
    assert!(refusal(&folder, "replay one.csv --map MAPS/ramps.osm").contains("one.csv"));
}
