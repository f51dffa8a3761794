//! The default demand, and the warning about a demand above capacity.

use serde_json::Value;

use crate::command::program::{Folder, closed};

fn number(summary: &Value, field: &str) -> f64 {
    summary[field].as_f64().unwrap()
}

#[test]
fn without_a_demand_a_share_of_the_estimated_capacity_comes_and_the_screen_says_so() {
    for map in ["motorway_3_lanes", "right_before_left", "town"] {
        let folder = Folder::new();
        let run = folder.laneweave(&format!("run MAPS/{map}.osm --duration 1 --record 0"));
        let summary: Value = serde_json::from_str(&folder.read("out/summary.json")).unwrap();
        let [demand, capacity, queues_from] =
            ["demand_veh_h", "estimated_capacity_veh_h", "queues_from_veh_h"].map(|it| number(&summary, it));
        // Whole vehicles per hour at each entrance.
        let usual = (0.63 * capacity).min(0.8 * queues_from);
        assert!((demand / usual - 1.0).abs() < 0.02, "{map}: {demand} of {capacity}");
        let share = 100.0 * demand / capacity;
        let bottleneck = summary["bottleneck"].as_str().unwrap();
        let said = format!(
            "demand: {demand:.0} veh/h, {share:.0} % of the estimated capacity of {capacity:.0} veh/h (bottleneck: {bottleneck})\n"
        );
        assert!(run.errors().ends_with(&said), "{}", run.errors());
        let screen =
            format!("{demand:.0} veh/h; estimated capacity {capacity:.0} veh/h (bottleneck: {bottleneck})\n");
        assert!(run.text().contains(&screen), "{}", run.text());
    }
}

#[test]
fn on_a_closed_map_the_demand_is_a_share_of_the_estimate_as_well() {
    let folder = Folder::new().with("ring.osm", &closed());
    let summary = folder.summary("ring.osm --duration 1 --record 0");
    let [demand, capacity, queues_from] =
        ["demand_veh_h", "estimated_capacity_veh_h", "queues_from_veh_h"].map(|it| number(&summary, it));
    let usual = (0.63 * capacity).min(0.8 * queues_from);
    assert!(queues_from > 0.0 && (demand / usual - 1.0).abs() < 0.02, "{demand}, {usual}");
}

#[test]
fn a_demand_above_the_estimate_is_warned_of_with_its_bottleneck() {
    let folder = Folder::new();
    let line = "run MAPS/right_before_left.osm --duration 1 --record 0 --demand";
    let capacity = number(&folder.summary(&line[4..].replace(" --demand", "")), "queues_from_veh_h");
    let told = folder.laneweave(&format!("{line} 4000")).errors();
    let warning = format!(
        "warning: demand: 4000 veh/h is above {capacity:.0} veh/h: as long as this lasts, queues grow at the junction at lanelet \
         25\n"
    );
    assert!(told.ends_with(&warning), "{told}");
    for quiet in ["900", "4000 --quiet"] {
        let told = folder.laneweave(&format!("{line} {quiet}")).errors();
        assert!(!told.contains("demand"), "{told}");
    }
}

#[test]
fn steps_that_change_the_traffic_are_warned_of() {
    let map = crate::command::program::maps().join("ramps.osm");
    let scenario =
        |step: f64| format!("map = \"{}\"\n[run]\nstep_s = {step}\nduration_s = 2\n", map.display());
    let folder = Folder::new().with("half.toml", &scenario(0.5)).with("long.toml", &scenario(1.0));
    let told = |file: &str| folder.laneweave(&format!("run {file} --record 0")).errors();
    assert!(!told("half.toml").contains("warning"));
    let warned = "warning: run.step_s = 1: above 0.5 s drivers need larger gaps, so delays grow by a third or more, and there are \
                  fewer lane changes; set 0.5 or less\n";
    assert!(told("long.toml").contains(warned), "{}", told("long.toml"));
}

#[test]
fn a_demand_that_is_not_given_is_found_again_when_a_run_is_repeated() {
    let folder = Folder::new();
    let first = folder.summary("MAPS/ramps.osm --duration 30 --record 0");
    let again = folder.summary("out/scenario.toml --out again");
    assert_eq!(again["state_hash"], first["state_hash"]);
    let told = folder.laneweave(&format!(
        "run MAPS/ramps.osm --duration 30 --record 0 --demand {} --out given --json",
        first["demand_veh_h"]
    ));
    let given: Value = serde_json::from_str(&told.text()).unwrap();
    assert_eq!(given["state_hash"], first["state_hash"]);
}
