//! `laneweave explain`: reasons of drivers, by repeating a run.

use crate::command::program::{Folder, maps};

/// A run of two minutes on the motorway with ramps, with CSV tables; and its first lane change: vehicle and time of the
/// crossing.
fn run() -> (Folder, String, f64) {
    let folder = Folder::new();
    folder.summary("MAPS/ramps.osm --duration 120 --warmup 60 --record 0 --format csv");
    let table = folder.read("out/lane_changes.csv");
    let cells: Vec<&str> = table.lines().nth(1).expect("there is a change").split(',').collect();
    let (vehicle, time) = (cells[3].to_string(), cells[0].parse().expect("a time"));
    (folder, vehicle, time)
}

#[test]
fn a_trip_is_told_from_its_beginning_with_every_change_of_the_table() {
    let (folder, vehicle, time) = run();
    let told = folder.laneweave(&format!("explain out --vehicle {vehicle}"));
    assert_eq!((told.code(), told.errors().as_str()), (0, ""));
    let text = told.text();
    assert!(text.lines().next().is_some_and(|it| it.contains("enters on lanelet")), "{text}");
    assert!(text.contains("wants to change to the"), "{text}");
    let across = text
        .lines()
        .find(|it| it.contains("has completed the change") && it.ends_with(&format!("at {time:.1} s")));
    assert!(across.is_some(), "{time}: {text}");
}

#[test]
fn a_moment_is_told_with_the_yields_that_the_table_holds_and_what_would_have_turned_it() {
    let (folder, ..) = run();
    let table = folder.read("out/lane_changes.csv");
    let column = |name: &str| table.lines().next().unwrap().split(',').position(|it| it == name).unwrap();
    let by_choice = table.lines().find(|it| it.contains("discretionary")).expect("there is one");
    let cell = |name: &str| by_choice.split(',').nth(column(name)).unwrap().to_string();
    let trip = folder.laneweave(&format!("explain out --vehicle {}", cell("vehicle"))).text();
    let wants = trip.lines().filter(|it| it.contains("wants to change")).rfind(|it| {
        it.trim_start()
            .split(' ')
            .next()
            .and_then(|it| it.parse::<f64>().ok())
            .is_some_and(|at| at < cell("started_s").parse::<f64>().unwrap())
    });
    let time =
        wants.expect("it wanted before it changed").trim_start().split(' ').next().unwrap().to_string();
    let told =
        folder.laneweave(&format!("explain out --vehicle {} --time {time} --flip", cell("vehicle"))).text();
    let gain: f64 = cell("g").parse().unwrap();
    assert!(told.contains(&format!("G {gain:.4}, θ 0.0070")), "{gain}: {told}");
    assert!(told.contains("would have changed it: "), "{told}");
}

#[test]
fn everybody_can_be_asked() {
    let (folder, ..) = run();
    let told = folder.laneweave("explain out --summary").text();
    assert!(told.contains("lane changes, by style and by the leading incentive"), "{told}");
    assert!(told.contains("no adjacent lane to which it may change"), "{told}");
    // Changes of the warm-up are left out, as in the table.
    let all: usize = told.split(' ').next().unwrap().parse().unwrap();
    let table = folder.read("out/lane_changes.csv");
    assert_eq!(all, table.lines().filter(|it| it.ends_with("completed")).count());
}

#[test]
fn who_needs_no_reason_stays_by_chance() {
    let folder = Folder::new();
    folder.summary("MAPS/motorway_2_lanes.osm --duration 60 --record 0 --model constant-hazard");
    let told = folder.laneweave("explain out --summary").text();
    assert!(
        told.contains("by chance: the desire did not occur") && !told.contains("the gain is too small"),
        "{told}"
    );
    let one = folder.laneweave("explain out --vehicle 5 --time 30").text();
    assert!(one.contains("stays by chance: G = 0.000"), "{one}");
    assert!(one.contains("the desire had the probability 0.01 and did not occur"), "{one}");
}

#[test]
fn what_cannot_be_told_is_refused_with_a_remedy() {
    let folder = Folder::new();
    std::fs::copy(maps().join("ramps.osm"), folder.path().join("own.osm")).unwrap();
    folder.summary("own.osm --duration 60 --record 0");
    let refused = |line: &str| {
        let run = folder.laneweave(line);
        assert_eq!(run.code(), 2, "{line}");
        run.errors()
    };
    assert!(refused("explain out --vehicle 99999").contains("no vehicle 99999 entered the road"));
    assert!(refused("explain out --vehicle 0 --time 61").contains("the run lasted from 0 to 60 s"));
    let early = refused("explain out --vehicle 20 --time 0");
    let times: Vec<f64> = early.split_whitespace().filter_map(|it| it.parse().ok()).collect();
    assert!(matches!(times[..], [.., from, until] if until > from), "{early}");
    assert!(refused("explain nowhere --vehicle 0").contains("no results of a run"));
    assert!(refused("explain out").contains("--vehicle"));
    let summary = folder.read("out/summary.json");
    for other in ["6000000.0", "-1.0", "1e300"] {
        let other = summary.replace("\"duration_s\": 60.0", &format!("\"duration_s\": {other}"));
        std::fs::write(folder.path().join("out/summary.json"), other).unwrap();
        let longer = folder.laneweave("explain out --vehicle 0").errors();
        assert!(longer.contains("summary.json: ") && longer.contains("the file was changed"), "{longer}");
    }
    std::fs::write(folder.path().join("out/summary.json"), summary).unwrap();
    let scenario = folder.read("out/scenario.toml");
    let other = scenario.replace("conservative = 7.4", "conservativ = 7.4");
    std::fs::write(folder.path().join("out/scenario.toml"), other).unwrap();
    let unknown = refused("explain out --vehicle 0");
    assert!(
        unknown.contains("scenario.toml:") && unknown.contains("unknown style \"conservativ\""),
        "{unknown}"
    );
    std::fs::write(folder.path().join("out/scenario.toml"), scenario).unwrap();
    let map = folder.read("own.osm").replacen("120", "110", 1);
    std::fs::write(folder.path().join("own.osm"), map).unwrap();
    let changed = refused("explain out --vehicle 0");
    assert!(changed.contains("has changed since this was run; run it again"), "{changed}");
}

#[test]
fn where_there_are_no_results_it_is_said_what_is_needed() {
    let folder = Folder::new().with("empty.txt", "");
    std::fs::create_dir(folder.path().join("empty")).unwrap();
    let needed =
        "give the results folder of a run (its --out), which contains summary.json and scenario.toml";
    for (place, what) in [
        ("nowhere", "this folder does not exist"),
        ("empty", "there is no summary.json in this folder"),
        ("empty.txt", "this is a file"),
    ] {
        for line in [format!("explain {place}"), format!("branch {place} --at 10")] {
            let run = folder.laneweave(&line);
            let expected = format!("error: {place}: no results of a run: {what}; {needed}\n");
            assert_eq!((run.code(), run.errors()), (2, expected), "{line}");
        }
    }
}

#[test]
fn what_is_kept_with_the_results_runs_again_to_the_same_end_with_styles_from_files() {
    let folder = Folder::new();
    folder.laneweave("styles new mine --from aggressive");
    let first =
        folder.summary("MAPS/ramps.osm --duration 60 --record 0 --style mine.toml=1 --style conservative=2");
    std::fs::remove_file(folder.path().join("mine.toml")).unwrap();
    let again = folder.summary("out/scenario.toml --out again");
    assert_eq!(again["state_hash"], first["state_hash"]);
    assert_eq!(again["fingerprint"], first["fingerprint"]);
}
