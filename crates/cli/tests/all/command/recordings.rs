//! `observe`, `recording join`, and recordings of datasets in `check`.

use std::fs;

use laneweave_test_data::data;
use serde_json::Value;

use crate::command::program::Folder;

/// A folder with the results of a short run.
fn driven() -> Folder {
    let folder = Folder::new();
    let run = folder.laneweave("run MAPS/ramps.osm --duration 60 --demand 3000 --record 0 --quiet --seed 4");
    assert_eq!(run.code(), 0, "{}", run.errors());
    folder
}

fn told(folder: &Folder, line: &str) -> String {
    let run = folder.laneweave(line);
    assert_eq!((run.code(), run.errors().as_str()), (0, ""), "{line}");
    run.text()
}

fn report(folder: &Folder, line: &str) -> Value {
    serde_json::from_str(&told(folder, &format!("{line} --map MAPS/ramps.osm --json"))).expect("it is JSON")
}

fn refusal(folder: &Folder, line: &str) -> String {
    let run = folder.laneweave(line);
    assert_eq!(run.code(), 2, "{line}: {}", run.text());
    run.errors()
}

#[test]
fn a_drone_records_a_run_and_its_parts_join_to_the_whole() {
    let folder = driven();
    told(&folder, "observe out --to whole.csv");
    told(&folder, "observe out --until 30 --to a.csv");
    told(&folder, "observe out --from 30 --to b.csv");
    let joined = told(&folder, "recording join a.csv b.csv --to joined.csv");
    assert!(joined.starts_with(&told(&folder, "observe out --to again.csv")[..10]), "{joined}");
    let rows = |name: &str| {
        let mut rows: Vec<String> = folder.read(name).lines().map(str::to_owned).collect();
        rows.sort();
        rows.into_iter().map(|it| it.split(',').take(6).collect::<Vec<_>>().join(",")).collect::<Vec<_>>()
    };
    assert_eq!(rows("whole.csv"), rows("again.csv"));
    assert_eq!(rows("whole.csv"), rows("joined.csv"));
    let [whole, parts] = ["check whole.csv", "check a.csv b.csv"].map(|it| report(&folder, it));
    assert!(whole["states"].as_u64() > Some(10_000), "{whole}");
    assert_eq!(whole["states"], parts["states"]);
    assert_eq!(whole["lane_changes_by_kind"], parts["lane_changes_by_kind"]);
}

#[test]
fn a_drone_sees_its_field_of_view_at_its_rate_and_loses_vehicles() {
    let folder = driven();
    told(&folder, "observe out --above 900,0 --view 300 --rate 10 --noise 0 --to near.csv");
    for row in folder.read("near.csv").lines().skip(1) {
        let x: f64 = row.split(',').nth(4).expect("x").parse().expect("a number");
        assert!((750.0..=1050.0).contains(&x), "{row}");
    }
    assert_eq!(report(&folder, "check near.csv")["step_s"], 0.1);
    let tracks = |line: &str| {
        let text = told(&folder, line);
        text.split_whitespace().next().and_then(|it| it.parse::<u32>().ok()).expect("a number of tracks")
    };
    let whole = tracks("observe out --rate 10 --to a.csv");
    assert!(tracks("observe out --rate 10 --lost-every 10 --to b.csv") > 2 * whole);
}

#[test]
fn what_cannot_be_observed_or_joined_is_refused_with_a_remedy() {
    let folder = driven();
    assert!(
        refusal(&folder, "observe out --rate 0").contains("--rate: 0 is out of range; choose 0.5 to 100")
    );
    assert!(refusal(&folder, "observe out --from 70").contains("choose times between 0 and 60 s"));
    assert!(refusal(&folder, "observe nowhere").contains("no results of a run"));
    told(&folder, "observe out --until 20 --to a.csv");
    told(&folder, "observe out --from 40 --to b.csv");
    let refused = refusal(&folder, "recording join b.csv a.csv");
    assert!(refused.contains("recording 2 continues none of the others"), "{refused}");
    fs::write(folder.path().join("odd.csv"), "p,q\n1,2\n").expect("it can be written");
    let refused = refusal(&folder, "check odd.csv --map MAPS/ramps.osm");
    assert!(
        refused.contains("INTERACTION; highD; inD, rounD, exiD; NGSIM") && refused.contains("--columns"),
        "{refused}"
    );
    fs::write(folder.path().join("odd.toml"), "[columns]\ntrack = \"p\"\nxx = \"q\"\n")
        .expect("it can be written");
    let refused = refusal(&folder, "check odd.csv --map MAPS/ramps.osm --columns odd.toml");
    assert!(refused.contains("odd.toml: line 3: unknown field `xx`"), "{refused}");
}

#[test]
fn a_window_that_continues_none_of_the_others_is_left_out_and_named() {
    let folder = driven();
    told(&folder, "observe out --until 30 --to a.csv");
    told(&folder, "observe out --from 30.04 --to b.csv");
    // The same vehicles half a kilometre beside.
    let beside = |row: &str| {
        let mut cells: Vec<String> = row.split(',').map(str::to_owned).collect();
        if let Ok(y) = cells[5].parse::<f64>() {
            cells[5] = (y + 500.0).to_string();
        }
        cells.join(",")
    };
    let bad: Vec<String> = folder.read("a.csv").lines().map(beside).collect();
    fs::write(folder.path().join("bad.csv"), bad.join("\n") + "\n").expect("it can be written");
    let states = |files: &str| {
        let report = report(&folder, &format!("check {files}"));
        (report["states"].clone(), report["windows"].to_string())
    };
    let (good, notes) = states("a.csv b.csv");
    assert!(notes.contains("a.csv, b.csv are joined: ") && !notes.contains("left out"), "{notes}");
    let (with_bad, notes) = states("bad.csv a.csv b.csv");
    assert_eq!(with_bad, good);
    assert!(notes.contains("bad.csv is left out: the others hold more"), "{notes}");
    let run = folder.laneweave("replay a.csv bad.csv b.csv --map MAPS/ramps.osm --duration 1 --out replayed");
    assert_eq!(run.code(), 0, "{}", run.errors());
    assert!(run.errors().contains("bad.csv stays by itself: of "), "{}", run.errors());
}

#[test]
fn commonroad_files_without_a_map_are_a_set_each_with_its_own() {
    let folder = Folder::new();
    let Some(data) = data("recordings/ngsim_commonroad") else { return };
    let names = ["USA_US101-3_1_T-1.xml", "USA_US101-6_1_T-1.xml"];
    for name in names {
        fs::copy(data.join(name), folder.path().join(name)).expect("a copy");
    }
    let line = format!("check {} {}", names[0], names[1]);
    let set: Value = serde_json::from_str(&told(&folder, &format!("{line} --json"))).expect("it is JSON");
    let parts = names.map(|it| {
        let one: Value =
            serde_json::from_str(&told(&folder, &format!("check {it} --json"))).expect("it is JSON");
        one["recording"].clone()
    });
    let total = |key: &str| parts.iter().filter_map(|it| it[key].as_f64()).sum::<f64>();
    for key in ["duration_s", "veh_km", "lane_changes_begun_before", "lane_changes_seen_shortly"] {
        assert!((set[key].as_f64().expect("a number") - total(key)).abs() < 0.01, "{key}: {set}");
    }
    assert_eq!(set["recordings"][1]["file"], names[1]);
    assert!(told(&folder, &line).starts_with("2 recordings, 16.0 s, "));
}

/// What the columns of the table `trajectories` hold.
const TRAJECTORIES: &str = r#"
[columns]
track = "vehicle"
time = "time_s"
x = "x_m"
y = "y_m"
speed = "speed_mps"
heading = "heading_rad"
class = "class"
length = "length_m"
width = "width_m"

[units]
time = "s"
"#;

#[test]
fn the_trajectories_of_a_run_are_a_recording_in_parquet_as_in_csv() {
    let folder = Folder::new().with("columns.toml", TRAJECTORIES);
    for format in ["parquet", "csv"] {
        let run =
            format!("run MAPS/ramps.osm --duration 40 --demand 3000 --record 0.1 --quiet --format {format}");
        assert_eq!(folder.laneweave(&format!("{run} --out {format}")).code(), 0);
    }
    let [parquet, csv] = ["parquet", "csv"]
        .map(|it| report(&folder, &format!("check {it}/trajectories.{it} --columns columns.toml")));
    assert_eq!(parquet, csv);
    assert_eq!((&parquet["step_s"], &parquet["unmatched"]), (&0.1.into(), &0.into()));
    assert!(
        parquet["states"].as_u64() > Some(5000) && parquet["tracks"]["car"].as_u64() > Some(20),
        "{parquet}"
    );
    let bytes = fs::read(folder.path().join("parquet/trajectories.parquet")).expect("it is there");
    fs::write(folder.path().join("cut.parquet"), &bytes[..bytes.len() / 2]).expect("it can be written");
    let said = refusal(&folder, "check cut.parquet --columns columns.toml --map MAPS/ramps.osm");
    assert!(said.contains("cut.parquet: it cannot be read as Parquet"), "{said}");
}
