//! The settings of a run.

use laneweave_test_data::data;

use crate::command::program::Folder;
use crate::command::run::number;

#[test]
fn nothing_is_measured_before_the_warm_up_is_over() {
    let folder = Folder::new();
    let line = "MAPS/motorway_2_lanes.osm --duration 60 --warmup 120 --format csv";
    let summary = folder.summary(line);
    assert_eq!((number(&summary, "duration_s"), number(&summary, "warmup_s")), (60.0, 120.0));
    assert_eq!(number(&summary, "entered"), number(&summary, "completed") + number(&summary, "on_road"));
    let text = folder.read("out/trajectories.csv");
    let first: f64 = text.lines().nth(1).unwrap().split(',').next().unwrap().parse().unwrap();
    assert_eq!(first, 121.0);
}

#[test]
fn options_go_before_what_the_scenario_says() {
    let scenario = "map = \"MAPS/motorway_2_lanes.osm\"\n[run]\nduration_s = 30\nseed = 5\n[styles]\nconservative = 1\n\
                    [demand]\nvehicles_per_hour = 500\n[output]\ndir = \"here\"\nrecord_s = 0\n";
    let maps = crate::command::program::maps();
    let folder = Folder::new().with("own.toml", &scenario.replace("MAPS", maps.to_str().unwrap()));
    let as_written = folder.summary("own.toml");
    assert_eq!((&as_written["seed"], &as_written["demand_veh_h"]), (&5.into(), &500.0.into()));
    assert!(folder.holds("here/summary.json") && !folder.holds("here/trajectories.parquet"));
    let replaced = folder.summary("own.toml --seed 6 --demand 700 --out there");
    assert_eq!((&replaced["seed"], &replaced["demand_veh_h"]), (&6.into(), &700.0.into()));
    assert!(folder.holds("there/summary.json"));
}

#[test]
fn single_entrances_and_exits_can_be_told() {
    let maps = crate::command::program::maps();
    let scenario = format!(
        "map = \"{}/ramps.osm\"\n[run]\nduration_s = 60\n[demand]\nvehicles_per_hour = 2000\n\
         [demand.entrances]\n1 = 3000\n[demand.exits]\n",
        maps.display()
    );
    let folder = Folder::new().with("own.toml", &scenario);
    // Of 2000 veh/h a quarter belongs to the ramp, which has one of four lanes.
    assert_eq!(folder.summary("own.toml")["demand_veh_h"], 3500.0);
}

#[test]
fn tables_of_origins_and_destinations_and_rates_over_time_are_the_demand() {
    let maps = crate::command::program::maps();
    let demand = |keys: &str| {
        let scenario = format!(
            "map = \"{}/ramps.osm\"\n[run]\nwarmup_s = 20\nduration_s = 40\n[demand]\n{keys}\n",
            maps.display()
        );
        number(&Folder::new().with("own.toml", &scenario).summary("own.toml"), "demand_veh_h")
    };
    let row = |from, to, rate| {
        format!("[[demand.od]]\nfrom = \"{from}\"\nto = \"{to}\"\nvehicles_per_hour = {rate}\n")
    };
    assert_eq!(demand(&(row(1, 91, 900) + &row(1, 94, 300))), 1200.0);
    // Of 2000 veh/h a quarter belongs to the ramp, which keeps it.
    assert_eq!(demand(&("vehicles_per_hour = 2000\n".to_owned() + &row(1, 91, 900))), 1400.0);
    // Measured from 20 to 60 s.
    assert_eq!(demand("vehicles_per_hour = 2000\nprofile = [[0, 1], [30, 0.5]]"), 1250.0);
    assert_eq!(demand("vehicles_per_hour = 0\n[demand.entrances]\n95 = [[40, 600], [50, 0]]"), 150.0);
}

#[test]
fn headways_follow_the_law_of_the_scenario() {
    let maps = crate::command::program::maps();
    let scenario = format!(
        "map = \"{}/motorway_2_lanes.osm\"\n[run]\nduration_s = 60\n[demand.headways]\nlaw = \"pearson-iii\"\n",
        maps.display()
    );
    let folder = Folder::new().with("own.toml", &scenario);
    let hash = folder.summary("own.toml")["state_hash"].clone();
    assert_eq!(folder.summary("own.toml")["state_hash"], hash);
    let exponential = Folder::new().with("own.toml", &scenario.replace("pearson-iii", "exponential"));
    assert_ne!(exponential.summary("own.toml")["state_hash"], hash);
}

#[test]
fn on_a_map_without_gates_trips_start_and_end_along_its_lanes() {
    let Some(town) = data("lanelet2/town10.osm") else { return };
    let summary = Folder::new().summary(&format!("{} --demand 900 --duration 120 --quiet", town.display()));
    let count = |name: &str| summary[name].as_u64().unwrap();
    assert_eq!(number(&summary, "demand_veh_h").round(), 900.0);
    assert_eq!(count("entered"), count("completed") + count("on_road"));
    assert!(count("completed") > 5, "{summary}");
}

#[test]
fn without_arguments_the_demo_runs() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path().join("out")).unwrap();
    let folder = folder.with("out/map.osm", "a map of somebody's");
    let run = folder.laneweave("");
    assert_eq!(run.code(), 0, "{}", run.errors());
    assert_eq!(folder.read("out/map.osm"), "a map of somebody's");
    assert!(
        folder.read("out/scenario.toml").contains("map = \"map-2.osm\"") && folder.holds("out/map-2.osm")
    );
    assert!(run.text().contains("maps/town.osm") && folder.holds("out/time_space.svg"), "{}", run.text());
}
