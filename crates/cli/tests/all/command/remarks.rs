//! The remarks of `check` and `run` on maps on which traffic looks odd.

use std::fs;

use serde_json::Value;

use crate::command::program::{Folder, closed};

/// The remarks of `check` on a map of `generate`, with some of its text replaced.
fn remarks(generate: &str, replaced: &[(&str, &str)]) -> Vec<String> {
    let folder = Folder::new();
    assert_eq!(folder.laneweave(&format!("generate {generate} m.osm")).code(), 0, "{generate}");
    let text = replaced.iter().fold(folder.read("m.osm"), |text, (from, to)| {
        assert!(text.contains(from), "{generate}: {from}");
        text.replace(from, to)
    });
    fs::write(folder.path().join("m.osm"), text).unwrap();
    of(&folder)
}

/// The remarks on the map `m.osm`; a run prints the same, unless it is quiet.
fn of(folder: &Folder) -> Vec<String> {
    let report: Value = serde_json::from_str(&folder.laneweave("check m.osm --json").text()).unwrap();
    let words = |it: &Value| format!("{}; {}", it["what"].as_str().unwrap(), it["remedy"].as_str().unwrap());
    let found: Vec<String> = report["remarks"].as_array().unwrap().iter().map(words).collect();
    let text = folder.laneweave("check m.osm").text();
    let run = folder.laneweave("run m.osm --duration 1 --record 0 --demand 100");
    assert_eq!(run.code(), 0, "{}", run.errors());
    for remark in &found {
        assert!(text.contains(&format!("\n  {remark}\n")), "{text}");
        assert!(run.errors().contains(&format!("warning: map: {remark}\n")), "{}", run.errors());
    }
    assert_eq!(run.errors().lines().count(), found.len(), "{}", run.errors());
    assert_eq!(folder.laneweave("run m.osm --duration 1 --record 0 --quiet").errors(), "");
    found
}

const LIMIT: &str = "k=\"speed_limit\" v=\"120\"";

#[test]
fn nothing_is_said_of_a_motorway() {
    assert_eq!(remarks("motorway --length 2000", &[]), [""; 0]);
}

#[test]
fn limits_that_only_the_law_gives_are_counted() {
    let found = remarks("motorway --length 400 --lanes 2", &[("k=\"speed_limit\"", "k=\"note\"")]);
    assert_eq!(
        found,
        [
            "8 of 8 lanelets have no speed limit: that of the traffic law applies (130 km/h on 8); add speed_limit to them, or \
             choose the law (--law, or map_options.law in a scenario)"
        ]
    );
}

#[test]
fn limits_that_are_hardly_meant_are_named() {
    for (limit, shown) in [("8", "8 km/h"), ("250", "250 km/h")] {
        let found = remarks("motorway --length 800", &[(LIMIT, &format!("k=\"speed_limit\" v=\"{limit}\""))]);
        assert_eq!(found.len(), 1, "{found:?}");
        let expected = format!(
            "have a speed limit up to 10 or above 200 km/h (lanelet 1: {shown}), and drivers keep to it"
        );
        assert!(found[0].contains(&expected), "{found:?}");
    }
}

#[test]
fn limits_that_jump_are_counted() {
    // At the on-ramp 80 km/h meets the limit of the road.
    assert_eq!(remarks("motorway --length 3000 --on-ramp-at 1000", &[]), [""; 0]);
    let slow = ("k=\"speed_limit\" v=\"80\"", "k=\"speed_limit\" v=\"50\"");
    let found = remarks("motorway --length 3000 --on-ramp-at 1000", &[slow]);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(
        found[0].starts_with("in 1 places the speed limit changes by more than half at once (lanelet "),
        "{found:?}"
    );
    assert!(found[0].contains(": 50 km/h to 120 km/h): vehicles bunch or spread there; "), "{found:?}");
}

#[test]
fn a_lane_that_turns_back_at_one_point_is_named() {
    let node = |(id, x, y): (i64, f64, f64)| format!("<node id='{id}' x='{x}' y='{y}'/>");
    let points =
        [(1, 0.0, 4.0), (2, 100.0, 4.0), (3, 0.0, 0.0), (4, 100.0, 0.0), (5, 60.0, 4.5), (6, 60.0, 9.0)];
    let nodes: String = points.into_iter().chain([(7, 104.0, 6.0)]).map(node).collect();
    let way = |(id, nodes): (i64, &[i64])| {
        let nodes: String = nodes.iter().map(|it| format!("<nd ref='{it}'/>")).collect();
        format!("<way id='{id}'>{nodes}</way>")
    };
    let ways = [(11, &[1, 2][..]), (12, &[3, 4]), (13, &[2, 5]), (14, &[4, 7, 6])].map(way).concat();
    let lanelet = |(id, left): (i64, i64)| {
        let member = |it: i64, role: &str| format!("<member type='way' ref='{it}' role='{role}'/>");
        let tags = "<tag k='type' v='lanelet'/><tag k='speed_limit' v='50'/>";
        format!("<relation id='{id}'>{}{}{tags}</relation>", member(left, "left"), member(left + 1, "right"))
    };
    let folder = Folder::new();
    let text = format!("<osm>{nodes}{ways}{}</osm>", [(21, 11), (22, 13)].map(lanelet).concat());
    fs::write(folder.path().join("m.osm"), text).unwrap();
    let expected = "in 1 places a lane turns by more than 90° at one point (lanelet 21 to 22: 105°): vehicles turn on the spot there; draw \
                    the bend, or disconnect the lanelets if nobody can drive there";
    assert!(of(&folder).iter().any(|it| it == expected), "{:?}", of(&folder));
}

#[test]
fn a_narrow_lane_that_ends_is_named_as_closed_to_long_vehicles() {
    // The lane of the on-ramp of this map is 2.3 m wide.
    let found = remarks("random --seed 3", &[]);
    let expected = "1 narrower than 2.55 m and end beside others: closed to long vehicles, which could not leave them (as at \
                    lanelet 52)";
    assert!(found.iter().any(|it| it.contains(expected)), "{found:?}");
}

#[test]
fn a_lane_alone_has_nothing_to_change_to() {
    let found = remarks("motorway --lanes 1 --length 1000", &[]);
    assert_eq!(
        found,
        [
            "lane changes are possible nowhere: styles differ in car-following only; mark lane lines that may be crossed as dashed, \
             or choose another map"
        ]
    );
}

#[test]
fn lanes_that_are_too_short_for_a_change_are_measured() {
    // 150 m at 33.3 m/s.
    let found = remarks("motorway --lanes 2 --length 150", &[]);
    assert_eq!(
        found,
        [
            "lane changes are possible on 300 m of lane, at most 150 m (4.5 s) without interruption: there will be hardly any \
             discretionary lane changes; to study lane changes, choose a map with longer lanes"
        ]
    );
    // At 90 km/h it takes 6 s.
    let slower = (LIMIT, "k=\"speed_limit\" v=\"90\"");
    assert_eq!(remarks("motorway --lanes 2 --length 150", &[slower]), [""; 0]);
}

#[test]
fn bends_are_held_against_the_limit_for_drivers_who_do_not_slow_down() {
    // A turn to the right has a radius of 10 m: (50/3.6)²/10 = 19.3 m/s².
    assert_eq!(remarks("grid --rows 1 --columns 1", &[]), [""; 0]);
    let folder = Folder::new();
    folder.laneweave("generate grid --rows 1 --columns 1 m.osm");
    let run =
        "run m.osm --duration 1 --record 0 --demand 100 --style paper-conservative=1 --style cautious=1";
    let said = folder.laneweave(run).errors();
    assert!(
        said.starts_with(
            "warning: map: 8 of 64 lanelets have bends in which the speed limit gives a lateral acceleration above 4 m/s² (lanelet "
        ),
        "{said}"
    );
    assert!(
        said.ends_with(
            ": 19 m/s² at 50 km/h): paper-conservative drivers do not slow down for bends; if this matters, give the style a \
             lateral_acceleration, or reduce speed_limit there\n"
        ),
        "{said}"
    );
}

#[test]
fn entrances_before_a_stop_are_held_against_the_braking_way() {
    // From 130 km/h it takes (130/3.6)²/(2 × 2 m/s²) = 326 m to stop; the arms of a junction are 80 m long.
    let found = remarks("grid --rows 1 --columns 1 --block-length 80 --speed-limit 130", &[]);
    let said = found.iter().find(|it| it.starts_with("entrance ")).unwrap_or_else(|| panic!("{found:?}"));
    assert!(
        said.contains(" (and 3 more) is ")
            && said.contains(" at a speed limit of 130 km/h: vehicles enter more slowly"),
        "{said}"
    );
    assert!(!remarks("grid --rows 1 --columns 1", &[]).iter().any(|it| it.starts_with("entrance ")));
}

#[test]
fn a_closed_map_is_called_so() {
    let found = of(&Folder::new().with("m.osm", &closed()));
    assert_eq!(
        found[0],
        "closed map (no entrance or no exit): trips start from rest and end on 4 lanelets; for through traffic, make roads begin \
         and end with a lanelet of 10 m or more"
    );
}

#[test]
fn trips_with_too_little_road_for_their_lane_changes_are_left_out_and_driven_if_they_are_named() {
    // From the on-ramp, 52, to the end of the motorway, 50: 100 m at 150 km/h are 2.4 s.
    const FAULT: &str = "there is too little road for the lane changes of 1 trip (52 to 50)";
    let make = "weaving --length 100 --speed-limit 150";
    let found = remarks(make, &[]);
    let [.., last] = &found[..] else { panic!("no remark") };
    let remedy =
        "name them in demand.od to have them all the same, or let drivers change lanes on a longer stretch";
    assert_eq!(*last, format!("{FAULT}: the demand leaves them out, unless it names them; {remedy}"));
    let folder = Folder::new();
    assert_eq!(folder.laneweave(&format!("generate {make} m.osm")).code(), 0);
    let report: Value = serde_json::from_str(&folder.laneweave("check m.osm --json").text()).unwrap();
    assert_eq!(
        report["late_trips"],
        serde_json::json!([{"from": "52", "to": "50", "classes": ["car", "truck"]}])
    );
    let trips = |run: &str| {
        let run = folder.laneweave(&format!("run {run} --duration 300 --record 0 --format csv"));
        assert_eq!(run.code(), 0, "{}", run.errors());
        let column = |rows: &str, name: &str| rows.split(',').position(|it| it == name).unwrap();
        let text = folder.read("out/trips.csv");
        let [from, to] = ["origin", "destination"].map(|it| column(text.lines().next().unwrap(), it));
        let trip = |row: &str| row.split(',').nth(from) == Some("52") && row.split(',').nth(to) == Some("50");
        (text.lines().filter(|it| trip(it)).count(), run.errors())
    };
    assert_eq!(trips("m.osm --demand 1000").0, 0);
    let named = "map = \"m.osm\"\n[[demand.od]]\nfrom = \"52\"\nto = \"50\"\nvehicles_per_hour = 200\n";
    fs::write(folder.path().join("named.toml"), named).unwrap();
    let (count, errors) = trips("named.toml");
    assert!(count > 5, "{count}");
    assert!(errors.contains(&format!("warning: map: {FAULT}: the demand has them")), "{errors}");
}
