//! Runs that succeed.

use serde_json::Value;

use crate::program::Folder;

/// The fields that everybody can rely on.
const FIELDS: &str = "entered left on_road waiting entrance_capacity bottleneck lane_changes lane_changes_discretionary \
    lane_changes_route lane_changes_per_veh_km veh_km collisions overlaps emergency_brakings stuck missed_turns \
    rerouted considerations updates wall_s load_s updates_per_s mean_speed_mps mean_trip_duration_s peak_rss_mb \
    state_hash route_changes";

const TRAJECTORIES: &str = "time_s,vehicle,class,style,lanelet,position_m,offset_m,x_m,y_m,z_m,heading_rad,\
    speed_mps,acceleration_mps2,length_m,width_m,state";

const LANE_CHANGES: &str = "time_s,started_s,duration_s,vehicle,style,class,from_lanelet,to_lanelet,x_m,y_m,side,\
    kind,speed_mps,speed_gain_mps,speed_yield,speed_weight,route_yield,route_weight,comfort_yield,comfort_weight,\
    courtesy_yield,courtesy_weight,urgency_yield,urgency_weight,g,theta,gap_ahead_m,gap_behind_m,ttc_ahead_s,\
    ttc_behind_s,outcome";

fn number(summary: &Value, field: &str) -> f64 {
    summary[field].as_f64().unwrap_or_else(|| panic!("{field}: {}", summary[field]))
}

#[test]
fn a_bare_map_is_enough_and_leaves_tables_figures_and_a_summary() {
    let folder = Folder::new();
    let run = folder.laneweave("run MAPS/ramps.osm --duration 60");
    assert_eq!((run.code(), run.errors().as_str()), (0, ""));
    for file in ["trajectories.parquet", "lane_changes.parquet", "summary.json"] {
        assert!(folder.holds(&format!("out/{file}")), "{file}");
        assert!(run.text().contains(&format!("out/{file}")), "{}", run.text());
    }
    for figure in ["lane_change_rate.svg", "time_space.svg"] {
        let svg = folder.read(&format!("out/{figure}"));
        assert!(svg.starts_with("<svg") && svg.contains("<path"), "{figure}");
    }
    let left_over = std::fs::read_dir(folder.path().join("out")).unwrap().count();
    assert_eq!(left_over, 8);
}

#[test]
fn the_summary_has_all_its_fields_and_adds_up() {
    let folder = Folder::new();
    let summary = folder.summary("MAPS/ramps.osm --duration 120 --record 0");
    for field in FIELDS.split_whitespace() {
        assert!(!summary[field].is_null(), "{field}");
    }
    let of = |field| number(&summary, field);
    assert_eq!(of("entered"), of("left") + of("on_road"));
    assert_eq!(of("lane_changes"), of("lane_changes_discretionary") + of("lane_changes_route"));
    assert!(of("entered") > 0.0 && of("lane_changes") > 0.0);
    assert_eq!(of("demand_veh_h"), 4000.0);
    assert_eq!(of("duration_s"), 120.0);
    let mean_speed = of("veh_km") * 1000.0 / (of("updates") * 0.1);
    assert!((of("mean_speed_mps") / mean_speed - 1.0).abs() < 1e-12);
    let per_second = of("updates") / (of("wall_s") - of("load_s"));
    assert!((of("updates_per_s") / per_second - 1.0).abs() < 1e-9);
    assert_eq!(summary["state_hash"].as_str().unwrap().len(), 16);
    assert_eq!(summary, serde_json::from_str::<Value>(&folder.read("out/summary.json")).unwrap());
    assert!(!folder.holds("out/trajectories.parquet"));
}

#[test]
fn flows_are_measured_where_that_is_asked_for() {
    let folder = Folder::new();
    folder.summary("MAPS/motorway_2_lanes.osm --duration 90 --record 0 --flows 60 --format csv");
    let table = folder.read("out/flows.csv");
    let times: Vec<&str> = table.lines().skip(1).map(|it| it.rsplitn(5, ',').last().unwrap()).collect();
    assert!(times.iter().all(|it| ["0.0,60.0", "60.0,90.0"].contains(it)), "{}", times[0]);
    assert!(times.len() > 10 && times.contains(&"60.0,90.0"));
}

#[test]
fn queues_at_the_entrances_are_named_with_what_holds_them() {
    let folder = Folder::new();
    let line = "run MAPS/grid.osm --demand 9000 --duration 300 --record 0";
    let summary = folder.summary(&line["run ".len()..]);
    let queues = summary["queues"].as_array().unwrap();
    let waiting: Vec<f64> = queues.iter().map(|it| number(it, "waiting")).collect();
    assert_eq!(waiting.iter().sum::<f64>(), number(&summary, "waiting"));
    assert!(waiting.len() > 3 && waiting.is_sorted_by(|a, b| a >= b), "{waiting:?}");
    assert!(queues.iter().any(|it| number(&it["held_s"], "red_light") > 10.0));
    assert!(number(&summary, "mean_delay_s") > 0.0 && number(&summary, "mean_stops") > 0.0);
    let text = folder.laneweave(line).text();
    let first = format!("{} at lanelet {}", waiting[0], queues[0]["lanelet"]);
    assert!(text.contains(&first) && text.contains("a red light"), "{first}: {text}");
}

#[test]
fn the_number_of_threads_and_a_second_run_change_nothing() {
    let folder = Folder::new();
    let hash = |threads: u32| {
        let line = format!("MAPS/ramps.osm --duration 120 --record 0 --threads {threads}");
        folder.summary(&line)["state_hash"].clone()
    };
    let one = hash(1);
    assert_eq!([hash(1), hash(2), hash(4)], [one.clone(), one.clone(), one]);
}

#[test]
fn another_seed_is_another_run() {
    let folder = Folder::new();
    let hash = |seed| {
        folder.summary(&format!("MAPS/motorway_2_lanes.osm --duration 60 --seed {seed}"))["state_hash"]
            .clone()
    };
    assert_ne!(hash(1), hash(2));
}

#[test]
fn tables_have_the_columns_that_everybody_shares() {
    let folder = Folder::new();
    let run = folder.laneweave("run MAPS/ramps.osm --duration 60 --format csv --quiet --out results/first");
    assert_eq!((run.code(), run.text().as_str(), run.errors().as_str()), (0, "", ""));
    let trajectories = folder.read("results/first/trajectories.csv");
    assert_eq!(trajectories.lines().next(), Some(TRAJECTORIES));
    assert!(trajectories.lines().count() > 1000);
    let times: Vec<f64> =
        trajectories.lines().skip(1).map(|it| it.split(',').next().unwrap().parse().unwrap()).collect();
    assert!(times.iter().all(|it| (it - it.round()).abs() < 1e-9), "one row a second");
    let lane_changes = folder.read("results/first/lane_changes.csv");
    assert_eq!(lane_changes.lines().next(), Some(LANE_CHANGES));
    assert!(lane_changes.lines().skip(1).all(|it| it.ends_with(",completed") || it.ends_with(",aborted")));
}

#[test]
fn every_step_can_be_recorded() {
    let folder = Folder::new();
    folder.summary("MAPS/motorway_2_lanes.osm --duration 20 --step 0.2 --record 0.2 --format csv");
    let text = folder.read("out/trajectories.csv");
    let mut times: Vec<&str> = text.lines().skip(1).map(|it| it.split(',').next().unwrap()).collect();
    times.dedup();
    let steps: Vec<f64> = times.iter().map(|it| it.parse::<f64>().unwrap() / 0.2).collect();
    assert!(steps.len() > 50 && steps.windows(2).all(|pair| (pair[1] - pair[0] - 1.0).abs() < 1e-6));
}

#[test]
fn nothing_is_measured_before_the_warm_up_is_over() {
    let folder = Folder::new();
    let line = "MAPS/motorway_2_lanes.osm --duration 60 --warmup 120 --format csv";
    let summary = folder.summary(line);
    assert_eq!((number(&summary, "duration_s"), number(&summary, "warmup_s")), (60.0, 120.0));
    assert_eq!(number(&summary, "entered"), number(&summary, "left") + number(&summary, "on_road"));
    let text = folder.read("out/trajectories.csv");
    let first: f64 = text.lines().nth(1).unwrap().split(',').next().unwrap().parse().unwrap();
    assert_eq!(first, 121.0);
}

#[test]
fn options_go_before_what_the_scenario_says() {
    let scenario = "map = \"MAPS/motorway_2_lanes.osm\"\n[run]\nduration_s = 30\nseed = 5\n[styles]\nconservative = 1\n\
                    [demand]\nvehicles_per_hour = 500\n[output]\ndir = \"here\"\nrecord_s = 0\n";
    let maps = crate::program::maps();
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
    let maps = crate::program::maps();
    let scenario = format!(
        "map = \"{}/ramps.osm\"\n[run]\nduration_s = 60\n[demand]\nvehicles_per_hour = 2000\n\
         [demand.entrances]\n1 = 3000\n[demand.exits]\n",
        maps.display()
    );
    let folder = Folder::new().with("own.toml", &scenario);
    // Of 2000 veh/h a quarter is the ramp's, which has one of four lanes.
    assert_eq!(folder.summary("own.toml")["demand_veh_h"], 3500.0);
}

#[test]
fn tables_of_origins_and_destinations_and_rates_over_time_are_the_demand() {
    let maps = crate::program::maps();
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
    // Of 2000 veh/h a quarter is the ramp's, which keeps it.
    assert_eq!(demand(&("vehicles_per_hour = 2000\n".to_owned() + &row(1, 91, 900))), 1400.0);
    // Measured from 20 to 60 s.
    assert_eq!(demand("vehicles_per_hour = 2000\nprofile = [[0, 1], [30, 0.5]]"), 1250.0);
    assert_eq!(demand("vehicles_per_hour = 0\n[demand.entrances]\n95 = [[40, 600], [50, 0]]"), 150.0);
}

#[test]
fn headways_follow_the_law_of_the_scenario() {
    let maps = crate::program::maps();
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
    const TOWN: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data/lanelet2/town10.osm");
    if !std::path::Path::new(TOWN).exists() {
        eprintln!("skipped: town10.osm is not there");
        return;
    }
    let summary = Folder::new().summary(&format!("{TOWN} --demand 900 --duration 120 --quiet"));
    let count = |name: &str| summary[name].as_u64().unwrap();
    assert_eq!(number(&summary, "demand_veh_h").round(), 900.0);
    assert_eq!(count("entered"), count("left") + count("on_road"));
    assert!(count("left") > 5, "{summary}");
}

#[test]
fn without_arguments_the_demo_runs() {
    let folder = Folder::new();
    let run = folder.laneweave("");
    assert_eq!(run.code(), 0, "{}", run.errors());
    assert!(run.text().contains("maps/town.osm") && folder.holds("out/time_space.svg"), "{}", run.text());
}

/// Stops a run as Ctrl-C does.
#[cfg(unix)]
#[test]
fn an_interrupted_run_leaves_what_it_computed() {
    use std::process::{Command, Stdio};
    use std::thread::sleep;
    use std::time::Duration;

    let folder = Folder::new();
    let map = crate::program::maps().join("motorway_2_lanes.osm");
    let child = Command::new(env!("CARGO_BIN_EXE_laneweave"))
        .arg("run")
        .arg(map)
        .args(["--duration", "1e6", "--json", "--record", "0"])
        .current_dir(folder.path())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    while !folder.holds("out/lane_changes.parquet.partial") {
        sleep(Duration::from_millis(20));
    }
    sleep(Duration::from_millis(500));
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success());
    let summary: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(summary["interrupted"], true);
    let duration = number(&summary, "duration_s");
    assert!(duration > 0.0 && duration < 1e6, "{duration}");
    assert!(folder.holds("out/lane_changes.parquet") && folder.holds("out/time_space.svg"));
    assert!(!folder.holds("out/lane_changes.parquet.partial"));
}
