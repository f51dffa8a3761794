//! Entrances and exits of a map.

use std::fmt::Write;

use serde_json::{Value, json};

use crate::command::program::Folder;

/// A map of straight lines at these heights, each from one place to another [m], and of lanelets between two lines,
/// each with its id.
fn map(lines: &[(i64, [f64; 2], f64)], lanelets: &[(i64, i64, i64)]) -> String {
    let mut text = String::from("<osm>");
    let nodes = |line: i64| [10 * line, 10 * line + 1];
    for (line, [from, to], y) in lines {
        for (node, x) in nodes(*line).into_iter().zip([from, to]) {
            write!(text, "<node id='{node}' x='{x}' y='{y}'/>").unwrap();
        }
    }
    for (line, ..) in lines {
        let [a, b] = nodes(*line);
        write!(
            text,
            "<way id='{line}'><nd ref='{a}'/><nd ref='{b}'/><tag k='type' v='line_thin'/><tag k='subtype' v='dashed'/></way>"
        )
        .unwrap();
    }
    for (id, left, right) in lanelets {
        write!(
            text,
            "<relation id='{id}'><member type='way' ref='{left}' role='left'/><member type='way' ref='{right}' role='right'/>\
             <tag k='type' v='lanelet'/><tag k='subtype' v='highway'/><tag k='speed_limit' v='100'/></relation>"
        )
        .unwrap();
    }
    text + "</osm>"
}

#[test]
fn a_lanelet_alone_is_neither_entrance_nor_exit() {
    let road = [0.0, 300.0];
    let lines = [(1, road, 4.0), (2, road, 0.0), (5, road, 54.0), (6, road, 50.0)];
    let two_roads = map(&lines, &[(101, 1, 2), (103, 5, 6)]);
    // The first road continues.
    let onward = "<node id='30' x='600' y='4'/><node id='40' x='600' y='0'/><way id='3'><nd ref='11'/><nd ref='30'/></way>\
                  <way id='4'><nd ref='21'/><nd ref='40'/></way><relation id='102'><member type='way' ref='3' role='left'/>\
                  <member type='way' ref='4' role='right'/><tag k='type' v='lanelet'/><tag k='subtype' v='highway'/>\
                  <tag k='speed_limit' v='100'/></relation></osm>";
    let folder = Folder::new().with("m.osm", &two_roads.replace("</osm>", onward));
    let report: Value = serde_json::from_str(&folder.laneweave("check m.osm --json").text()).unwrap();
    assert_eq!(report["entrances"], json!([{ "id": "101", "lanes": 1 }]));
    assert_eq!(report["exits"], json!([{ "id": "102", "lanes": 1 }]));
    assert_eq!(report["lane_drops"], json!([]));
    let summary = folder.summary("m.osm --duration 100 --record 0");
    assert!(summary["completed"].as_u64().unwrap() > 5);
    assert_eq!(summary["trips_of_one_lanelet"], 0);
}

#[test]
fn a_road_may_end_with_a_short_lanelet() {
    let lines = [(1, [0.0, 300.0], 4.0), (2, [0.0, 300.0], 0.0)];
    let onward = "<node id='30' x='301' y='4'/><node id='40' x='301' y='0'/><way id='3'><nd ref='11'/><nd ref='30'/></way>\
                  <way id='4'><nd ref='21'/><nd ref='40'/></way><relation id='102'><member type='way' ref='3' role='left'/>\
                  <member type='way' ref='4' role='right'/><tag k='type' v='lanelet'/><tag k='subtype' v='highway'/>\
                  <tag k='speed_limit' v='100'/></relation></osm>";
    let folder = Folder::new().with("m.osm", &map(&lines, &[(101, 1, 2)]).replace("</osm>", onward));
    let report: Value = serde_json::from_str(&folder.laneweave("check m.osm --json").text()).unwrap();
    assert_eq!(report["exits"], json!([{ "id": "102", "lanes": 1 }]));
    let summary = folder.summary("m.osm --duration 100 --record 0");
    assert!(summary["completed"].as_u64().unwrap() > 5, "{summary}");
}

#[test]
fn lanelets_that_meet_but_share_no_points_continue_one_another_on_request() {
    let [first, second] = [[0.0, 300.0], [300.2, 600.0]];
    let lines = [(1, first, 4.0), (2, first, 0.0), (3, second, 4.0), (4, second, 0.0)];
    let scenario = "map = 'm.osm'\nmap_options.joins_ends = true\n[run]\nduration_s = 200.0";
    let folder =
        Folder::new().with("m.osm", &map(&lines, &[(101, 1, 2), (102, 3, 4)])).with("s.toml", scenario);
    let summary = folder.summary("s.toml --demand 600 --format csv");
    assert!(summary["completed"].as_u64().unwrap() > 10, "{summary}");
    let trips = folder.read("out/trips.csv");
    let header: Vec<&str> = trips.lines().next().unwrap().split(',').collect();
    let [from, to] =
        ["from_lanelet", "to_lanelet"].map(|name| header.iter().position(|it| *it == name).unwrap());
    for trip in trips.lines().skip(1) {
        let cells: Vec<&str> = trip.split(',').collect();
        // A vehicle on the road has not arrived.
        let is_known = cells[from] == "101" && ["102", ""].contains(&cells[to]);
        assert!(is_known, "{trip}");
    }
}

#[test]
fn trips_of_one_lanelet_are_counted_and_left_out_of_means() {
    let road = [0.0, 500.0];
    let lines = [(1, road, 8.0), (2, road, 4.0), (3, road, 0.0)];
    let folder = Folder::new().with("m.osm", &map(&lines, &[(101, 1, 2), (102, 2, 3)]));
    let summary = folder.summary("m.osm --duration 300 --demand 2400 --record 0 --format csv");
    let trips = folder.read("out/trips.csv");
    let header: Vec<&str> = trips.lines().next().unwrap().split(',').collect();
    let column = |name: &str| header.iter().position(|it| *it == name).unwrap();
    let [from, to, duration] = ["from_lanelet", "to_lanelet", "duration_s"].map(column);
    let (mut of_one, mut others) = (0, Vec::new());
    for line in trips.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        match cells[duration].parse::<f64>() {
            Ok(_) if cells[from] == cells[to] => of_one += 1,
            Ok(duration) => others.push(duration),
            Err(_) => {}
        }
    }
    assert!(of_one > 50 && others.len() > 5, "{of_one} and {}", others.len());
    assert_eq!(summary["trips_of_one_lanelet"], of_one);
    assert_eq!(summary["completed"], of_one + others.len() as u64);
    let mean = others.iter().sum::<f64>() / others.len() as f64;
    assert!((summary["mean_trip_duration_s"].as_f64().unwrap() - mean).abs() < 1e-6);
}
