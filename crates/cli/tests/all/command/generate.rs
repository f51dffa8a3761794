//! `laneweave generate`.

use laneweave::generate::{Hazard, random};
use laneweave::maps::lanelet2;
use serde_json::{Value, json};

use crate::command::program::Folder;

#[test]
fn a_map_that_was_made_can_be_driven() {
    let folder = Folder::new();
    let line = "generate motorway --lanes 2 --length 3000 --on-ramp-at 800 --off-ramp-at 2000 --speed-limit 100 \
                --driving-side left own.osm";
    let run = folder.laneweave(line);
    assert_eq!((run.code(), run.errors().as_str()), (0, ""));
    let summary = folder.summary("own.osm --duration 60");
    assert_eq!(summary["demand_veh_h"], 2228.0);
    assert!(summary["on_road"].as_u64().unwrap() > 10);
}

#[test]
fn what_cannot_be_built_is_refused_and_not_written() {
    let folder = Folder::new();
    for (options, message) in [
        ("--length -5 own.osm", "a length of -5 m; choose 10 to 40000000 m"),
        ("--length nan own.osm", "a length of NaN m; choose 10 to 40000000 m"),
        ("--lanes 0 own.osm", "0 lanes; choose 1 to 12"),
        ("--on-ramp-at 4900 own.osm", "but its length is 5000 m; move it or lengthen the road"),
        ("own.txt", "own.txt: this is not a valid name for a map file; use a name that ends in .osm"),
        ("own.xml", "own.xml: this is not a valid name for a map file; use a name that ends in .osm"),
        ("own.osm.gz", "own.osm.gz: this is not a valid name for a map file"),
        ("none/own.osm", "none/own.osm: cannot be written"),
    ] {
        let run = folder.laneweave(&format!("generate motorway {options}"));
        assert_eq!(run.code(), 2, "{options}");
        assert!(run.errors().contains(message), "{}", run.errors());
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn a_random_map_is_named_with_what_is_hard_about_it() {
    let folder = Folder::new();
    let run = folder.laneweave("generate random --seed 17 own.osm");
    assert_eq!((run.code(), run.errors().as_str()), (0, ""));
    let text = run.text();
    let hazards = text.trim_end().strip_prefix("random map 17: ").expect("it is named");
    let known = |it: &str| Hazard::ALL.iter().any(|hazard| hazard.name() == it);
    assert!(hazards.split(", ").all(known), "{hazards}");
    let drawn = std::fs::read_to_string(folder.path().join("own.osm")).unwrap();
    assert!(drawn == lanelet2::write(&random(17).drawing));
}

#[test]
fn every_kind_of_map_is_made_and_has_no_problems() {
    let folder = Folder::new();
    for (options, entrances, rules) in [
        ("weaving --length 300", 2, json!({})),
        ("grid --rows 2 --columns 3 --lanes 1", 10, json!({ "traffic_light": 24 })),
        ("grid --rows 1 --columns 1 --control priority", 4, json!({ "right_of_way": 2 })),
        ("grid --rows 1 --columns 1 --control right-before-left", 4, json!({})),
        ("grid --rows 1 --columns 2 --control all-way-stop", 6, json!({ "all_way_stop": 2 })),
        ("arterial --junctions 3 --block-length 250 --speed-limit 60", 8, json!({ "traffic_light": 18 })),
        ("roundabout", 4, json!({ "right_of_way": 4 })),
        ("approach --driving-side left", 1, json!({ "right_of_way": 1 })),
        ("town", 15, json!({ "all_way_stop": 1, "right_of_way": 11, "traffic_light": 24 })),
    ] {
        let run = folder.laneweave(&format!("generate {options} own.osm"));
        assert_eq!((run.code(), run.errors().as_str()), (0, ""), "{options}");
        let report: Value = serde_json::from_str(&folder.laneweave("check own.osm --json").text()).unwrap();
        assert_eq!(report["problems"], json!([]), "{options}");
        assert_eq!(report["entrances"].as_array().unwrap().len(), entrances, "{options}");
        assert_eq!(report["rules"], rules, "{options}");
    }
}

#[test]
fn numbers_of_towns_out_of_range_are_refused_with_the_range() {
    let folder = Folder::new();
    for (options, message) in [
        ("grid --rows 0 --columns 2", "generate grid: 0 rows; choose 1 to 50"),
        ("grid --rows 2 --columns 2 --lanes 4", "generate grid: 4 lanes in a direction; choose 1 to 3"),
        (
            "grid --rows 2 --columns 2 --block-length 20",
            "generate grid: a block length of 20 m; choose 80 to 1000 m",
        ),
        ("arterial --junctions 99", "generate arterial: 99 junctions; choose 1 to 50"),
        ("weaving --length 2000", "generate weaving: a weaving section of 2000 m; choose 100 to 1000 m"),
        ("weaving --lanes 0", "generate weaving: 0 lanes; choose 1 to 12"),
        ("grid --rows 2 --columns 2 --control police", "invalid value 'police'"),
    ] {
        let run = folder.laneweave(&format!("generate {options} own.osm"));
        assert_eq!(run.code(), 2, "{options}");
        assert!(run.errors().contains(message), "{}", run.errors());
    }
    assert!(!folder.holds("own.osm"));
}
