//! Maps of one's own.

use crate::program::Folder;

#[test]
fn a_map_that_was_made_can_be_driven() {
    let folder = Folder::new();
    let line = "generate motorway --lanes 2 --length 3000 --on-ramp-at 800 --off-ramp-at 2000 --speed-limit 100 \
                --driving-side left own.osm";
    let run = folder.laneweave(line);
    assert_eq!((run.code(), run.errors().as_str()), (0, ""));
    let summary = folder.summary("own.osm --duration 60");
    assert_eq!(summary["demand_veh_h"], 3000.0);
    assert!(summary["on_road"].as_u64().unwrap() > 10);
}

#[test]
fn what_cannot_be_built_is_refused_and_not_written() {
    let folder = Folder::new();
    for (options, message) in [
        ("--length -5 own.osm", "a length of -5 m; choose 10 to 40000000 m"),
        ("--length nan own.osm", "a length of NaN m; choose 10 to 40000000 m"),
        ("--lanes 0 own.osm", "0 lanes; choose 1 to 12"),
        ("--on-ramp-at 4900 own.osm", "of 5000 m; move it or lengthen the road"),
        ("own.txt", "own.txt: this is no name of a map file; let it end in .osm"),
        ("none/own.osm", "none/own.osm: cannot be written"),
    ] {
        let run = folder.laneweave(&format!("generate motorway {options}"));
        assert_eq!(run.code(), 2, "{options}");
        assert!(run.errors().contains(message), "{}", run.errors());
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}
