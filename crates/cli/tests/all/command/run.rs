//! Runs that succeed.

use std::collections::HashMap;

use serde_json::Value;

use crate::command::program::Folder;

/// The fields that users can rely on.
const FIELDS: &str = "entered completed on_road waiting_to_enter estimated_capacity_veh_h queues_from_veh_h bottleneck lane_changes \
    lane_changes_discretionary lane_changes_route_driven lane_changes_per_veh_km veh_km collisions overlaps incidents emergency_brakings stuck missed_turns \
    lost rerouted considerations updates wall_s load_s updates_per_s mean_speed_mps mean_trip_duration_s trips_of_one_lanelet peak_rss_mb \
    state_hash route_changes lane_changes_keeping hard_brakings";

const TRAJECTORIES: &str = "time_s,vehicle,class,style,lanelet,position_m,offset_m,x_m,y_m,z_m,heading_rad,\
    speed_mps,acceleration_mps2,length_m,width_m,state";

const LANE_CHANGES: &str = "time_s,started_s,duration_s,vehicle,style,class,from_lanelet,to_lanelet,x_m,y_m,side,\
    kind,speed_mps,speed_gain_mps,speed_yield,speed_weight,route_yield,route_weight,comfort_yield,comfort_weight,\
    courtesy_yield,courtesy_weight,urgency_yield,urgency_weight,keeping_yield,keeping_weight,g,theta,gap_ahead_m,\
    gap_behind_m,ttc_ahead_s,ttc_behind_s,outcome";

const TRIPS: &str = "vehicle,class,style,origin,destination,from_lanelet,to_lanelet,arrived_s,entered_s,\
    completed_s,insertion_delay_s,duration_s,free_s,delay_s,length_m,stops,standing_s,lane_changes,\
    route_changes,missed_turns,name";

const LANELETS: &str = "lanelet,sumo_lane,length_m,vehicles,flow_veh_h,density_veh_km,speed_mps,standing_s,entered,\
    completed,changes_to_left,changes_to_right,changes_from_left,changes_from_right";

pub(crate) fn number(summary: &Value, field: &str) -> f64 {
    summary[field].as_f64().unwrap_or_else(|| panic!("{field}: {}", summary[field]))
}

#[test]
fn a_bare_map_is_enough_and_leaves_tables_figures_and_a_summary() {
    let folder = Folder::new();
    let run = folder.laneweave("run MAPS/ramps.osm --duration 60");
    assert_eq!(run.code(), 0);
    assert!(run.errors().starts_with("demand: ") && run.errors().lines().count() == 1, "{}", run.errors());
    let tables = ["trajectories", "commands", "lane_changes", "incidents", "trips", "lanelets"]
        .map(|it| format!("{it}.parquet"));
    for file in tables.iter().map(String::as_str).chain(["summary.json"]) {
        assert!(folder.holds(&format!("out/{file}")), "{file}");
        assert!(run.text().contains(&format!("out/{file}")), "{}", run.text());
    }
    for figure in ["lane_change_rate.svg", "time_space.svg"] {
        let svg = folder.read(&format!("out/{figure}"));
        assert!(svg.starts_with("<svg") && svg.contains("<path"), "{figure}");
    }
    for entry in std::fs::read_dir(folder.path().join("out")).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        assert!(run.text().contains(&format!("out/{name}")), "{name} is not named: {}", run.text());
    }
}

#[test]
fn the_summary_has_all_its_fields_and_adds_up() {
    let folder = Folder::new();
    let summary = folder.summary("MAPS/ramps.osm --duration 120 --record 0");
    for field in FIELDS.split_whitespace() {
        assert!(!summary[field].is_null(), "{field}");
    }
    let of = |field: &str| number(&summary, field);
    assert_eq!(of("entered"), of("completed") + of("on_road"));
    let kinds = ["discretionary", "route_driven", "keeping"].map(|it| of(&format!("lane_changes_{it}")));
    assert_eq!(of("lane_changes"), kinds.iter().sum::<f64>());
    assert!(kinds.iter().all(|it| *it > 0.0), "{kinds:?}");
    assert!(of("entered") > 0.0 && of("lane_changes") > 0.0);
    assert_eq!(of("incidents"), of("collisions") + of("overlaps"));
    assert_eq!((of("incidents"), &summary["first_incident"]), (0.0, &Value::Null));
    assert_eq!(of("demand_veh_h"), 3012.0);
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
    assert_eq!(folder.laneweave("generate grid --rows 1 --columns 1 one.osm").code(), 0);
    let line = "run one.osm --demand 6000 --duration 300 --record 0";
    let summary = folder.summary(&line["run ".len()..]);
    let queues = summary["queues"].as_array().unwrap();
    let waiting: Vec<f64> = queues.iter().map(|it| number(it, "waiting")).collect();
    assert_eq!(waiting.iter().sum::<f64>(), number(&summary, "waiting_to_enter"));
    assert!(waiting.len() > 3 && waiting.is_sorted_by(|a, b| a >= b), "{waiting:?}");
    assert!(queues.iter().any(|it| number(&it["held_s"], "red_light") > 10.0));
    assert!(number(&summary, "mean_delay_s") > 0.0 && number(&summary, "mean_stops") > 0.0);
    let text = folder.laneweave(line).text();
    let first = format!("{} at lanelet {}", waiting[0], queues[0]["lanelet"].as_str().expect("an id"));
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

/// The rows of a CSV table, each as its cells by their columns.
pub(crate) fn rows(table: &str) -> Vec<HashMap<String, String>> {
    let mut lines = table.lines().map(|line| line.split(','));
    let names: Vec<&str> = lines.next().unwrap().collect();
    let row =
        |cells| names.iter().zip(cells).map(|(name, cell): (&&str, &str)| ((*name).into(), cell.into()));
    lines.map(|cells| row(cells.collect::<Vec<_>>()).collect()).collect()
}

#[test]
fn trips_have_a_row_each_also_those_that_began_before_the_measured_time_and_those_that_go_on() {
    let folder = Folder::new();
    let line = "MAPS/ramps.osm --duration 120 --warmup 60 --record 0 --format csv";
    let summary = folder.summary(line);
    let table = folder.read("out/trips.csv");
    assert_eq!(table.lines().next(), Some(TRIPS));
    let trips = rows(&table);
    let count = |summary: &Value, field: &str| summary[field].as_u64().unwrap() as usize;
    assert_eq!(trips.len(), count(&summary, "entered"));
    let of = |trip: &HashMap<String, String>, name: &str| trip[name].parse::<f64>();
    let (ended, on_road) = trips.split_at(count(&summary, "completed"));
    let durations: Vec<f64> = ended.iter().map(|it| of(it, "duration_s").unwrap()).collect();
    let mean = durations.iter().sum::<f64>() / durations.len() as f64;
    assert!((mean - number(&summary, "mean_trip_duration_s")).abs() < 1e-9);
    let delay = ended.iter().map(|it| of(it, "delay_s").unwrap()).sum::<f64>() / ended.len() as f64;
    assert!((delay - number(&summary, "mean_delay_s")).abs() < 0.05, "{delay}");
    for trip in ended {
        let [entered, completed, duration] =
            ["entered_s", "completed_s", "duration_s"].map(|it| of(trip, it).unwrap());
        assert!((completed - entered - duration).abs() < 1e-9 && completed > 60.0);
        // No vehicle is faster than on a free road, except for the effects of limits and of lane changes.
        assert!(
            of(trip, "delay_s").unwrap() > -5.0 && of(trip, "delay_s").unwrap() < 0.7 * duration,
            "{trip:?}"
        );
        assert!((1000.0..5100.0).contains(&of(trip, "length_m").unwrap()), "{trip:?}");
        assert!(!trip["origin"].is_empty() && !trip["to_lanelet"].is_empty());
    }
    assert!(ended.iter().any(|it| of(it, "entered_s").unwrap() < 60.0));
    for trip in on_road {
        let open = ["to_lanelet", "completed_s", "duration_s", "delay_s"].map(|it| trip[it].as_str());
        assert_eq!(open, [""; 4]);
    }
    assert!(on_road.is_sorted_by_key(|it| it["vehicle"].parse::<u32>().unwrap()));
}

#[test]
fn who_drives_onto_a_lanelet_drives_off_it_or_is_still_there() {
    let folder = Folder::new();
    let line = "MAPS/motorway_2_lanes.osm --duration 301 --demand 3000 --format csv";
    let summary = folder.summary(line);
    let table = folder.read("out/lanelets.csv");
    assert_eq!(table.lines().next(), Some(LANELETS));
    let lanelets = rows(&table);
    let count = |lanelet: &HashMap<String, String>, name: &str| lanelet[name].parse::<i64>().unwrap();
    let total = |name: &str| lanelets.iter().map(|it| count(it, name)).sum::<i64>();
    assert_eq!(
        [total("entered"), total("completed")].map(|it| it as u64),
        ["entered", "completed"].map(|it| summary[it].as_u64().unwrap())
    );
    let (away, onto) = (["changes_to_left", "changes_to_right"], ["changes_from_left", "changes_from_right"]);
    let changes =
        folder.read("out/lane_changes.csv").lines().filter(|it| it.ends_with(",completed")).count() as i64;
    assert_eq!([away, onto].map(|it| it.map(total).iter().sum::<i64>()), [changes; 2]);
    // The road is two rows of lanelets, numbered row by row: a vehicle between two of its ends has entered and has
    // not passed.
    let trajectories = rows(&folder.read("out/trajectories.csv"));
    let last: Vec<&HashMap<String, String>> =
        trajectories.iter().filter(|it| it["time_s"] == "301.0").collect();
    for row in lanelets.chunks(2) {
        let beyond: i64 = count(&row[1], "lanelet");
        let here = last.iter().filter(|it| it["lanelet"].parse::<i64>().unwrap() <= beyond).count() as i64;
        assert_eq!(
            total("entered") - row.iter().map(|it| count(it, "vehicles")).sum::<i64>(),
            here,
            "{row:?}"
        );
    }
    assert_eq!(last.len() as u64, summary["on_road"].as_u64().unwrap());
}

#[test]
fn files_as_sumo_writes_them_are_left_where_they_are_asked_for() {
    let maps = crate::command::program::maps();
    let scenario = format!(
        "map = \"{}/ramps.osm\"\n[run]\nduration_s = 60\n[output]\nsumo = [\"tripinfo\", \"fcd\"]\n",
        maps.display()
    );
    let folder = Folder::new().with("own.toml", &scenario);
    let summary = folder.summary("own.toml");
    let [fcd, trips] = ["fcd", "tripinfo"].map(|it| folder.read(&format!("out/{it}.xml")));
    assert!(fcd.contains("seed: 1\n") && fcd.contains("command: laneweave run own.toml <doubleminus>json\n"));
    assert!(
        fcd.contains("    <timestep time=\"60.00\">\n        <vehicle id=\"")
            && fcd.ends_with("</fcd-export>\n")
    );
    assert_eq!(trips.matches("<tripinfo id=").count() as u64, summary["completed"].as_u64().unwrap());
    assert!(!folder.holds("out/lanechanges.xml"));
    folder.summary("own.toml --out other --sumo lanechange --record 0");
    assert!(folder.holds("other/lanechanges.xml") && !folder.holds("other/fcd.xml"));
    let changes = folder.read("other/lanechanges.xml");
    let completed = changes.matches("<change id=").count();
    assert!(completed > 0 && changes.contains("dir=\"1\"") && changes.ends_with("</lanechanges>\n"));
}

#[test]
fn every_file_is_the_same_on_any_number_of_threads() {
    let folder = Folder::new();
    let run = |threads: u32| {
        let out = format!("out{threads}");
        let line = "MAPS/town.osm --duration 100 --demand 6000 --flows 30 --sumo fcd,tripinfo,lanechange";
        folder.summary(&format!("{line} --format csv --threads {threads} --out {out}"));
        let names = ["trajectories.csv", "lane_changes.csv", "trips.csv", "lanelets.csv", "flows.csv"];
        let xml = ["fcd.xml", "tripinfo.xml", "lanechanges.xml"];
        let after_comment =
            |text: String| text.split_once("-->").map_or(text.clone(), |(_, rest)| rest.into());
        let read = |name| after_comment(folder.read(&format!("{out}/{name}")));
        names.into_iter().chain(xml).map(read).collect::<Vec<String>>()
    };
    let one = run(1);
    assert!(one.iter().all(|it| it.len() > 1000));
    assert!([2, 3].map(run).iter().all(|it| *it == one));
}

#[cfg(target_os = "linux")]
#[test]
fn a_run_that_cannot_write_says_so_and_leaves_no_half_a_file() {
    let folder = Folder::new();
    std::fs::create_dir_all(folder.path().join("out")).unwrap();
    // There is no space for any output.
    std::os::unix::fs::symlink("/dev/full", folder.path().join("out/fcd.xml.partial")).unwrap();
    let run = folder.laneweave("run MAPS/ramps.osm --demand 6000 --duration 200 --sumo fcd");
    assert_eq!(run.code(), 2);
    assert!(
        run.errors().contains("out/fcd.xml: cannot be written: no space left on device"),
        "{}",
        run.errors()
    );
    let left: Vec<_> = std::fs::read_dir(folder.path().join("out")).unwrap().flatten().collect();
    // It depends on timing whether the report is written before the fault; a file with its final name is complete.
    let is_whole = |it: &std::fs::DirEntry| {
        it.path().extension().is_some_and(|it| ["html", "svg", "toml"].iter().any(|whole| it == *whole))
    };
    assert!(left.iter().all(is_whole), "{left:?}");
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
