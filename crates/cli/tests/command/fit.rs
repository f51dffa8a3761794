//! `fit`: driving styles from recordings.

use std::sync::LazyLock;

use serde_json::Value;

use crate::program::Folder;

/// A folder with a recording of a motorway, `observed.csv`, and with what a fit to it found, in `fit`.
static FITTED: LazyLock<(Folder, Value)> = LazyLock::new(|| {
    let folder = Folder::new();
    for line in [
        "run MAPS/ramps.osm --duration 90 --demand 4000 --warmup 60 --record 0 --quiet --out driven",
        "observe driven --rate 10",
    ] {
        let run = folder.laneweave(line);
        assert_eq!(run.code(), 0, "{}", run.errors());
    }
    let report = json(&folder, FIT);
    (folder, report)
});

const FIT: &str = "fit observed.csv --map MAPS/ramps.osm --draws 3 --repetitions 1 --json";

fn json(folder: &Folder, line: &str) -> Value {
    let run = folder.laneweave(line);
    assert_eq!((run.code(), run.errors().as_str()), (0, ""), "{line}");
    serde_json::from_str(&run.text()).expect("it is JSON")
}

fn refusal(line: &str) -> String {
    let run = FITTED.0.laneweave(line);
    assert_eq!(run.code(), 2, "{line}: {}", run.text());
    run.errors()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(f64::NAN)
}

#[test]
fn every_lane_change_is_used_or_has_a_reason() {
    let report = &FITTED.1;
    let count = |key: &str| report[key].as_u64().expect("a number");
    let sum = |key: &str| {
        let counts = report[key].as_object().expect("counts").values();
        counts.map(|it| it.as_u64().expect("a number")).sum::<u64>()
    };
    assert!(count("events_used") > 5 && count("drivers") > 60 && count("observations") > 1000, "{report}");
    assert_eq!(count("events"), count("events_used") + sum("unused"));
    assert_eq!(count("events"), sum("events_by_kind"));
    assert!(report["censored"]["first_seen_in_a_change"].is_u64());
}

#[test]
fn a_fit_says_what_it_knows_and_what_it_does_not() {
    let report = &FITTED.1;
    let weights = report["weights"].as_array().expect("a list");
    let names: Vec<&Value> = weights.iter().map(|it| &it["name"]).collect();
    assert_eq!(names, ["speed", "route", "comfort", "courtesy", "keeping"]);
    for weight in weights.iter().chain([&report["theta"]]) {
        let interval = weight["interval"].as_array().expect("a pair");
        assert!(number(&interval[0]) <= number(&interval[1]), "{weight}");
        assert!(
            number(&weight["estimate"]).is_finite() && number(&weight["standard_error"]) >= 0.0,
            "{weight}"
        );
    }
    let open: Vec<&str> =
        report["not_identified"].as_array().expect("a list").iter().filter_map(Value::as_str).collect();
    let known = ["speed", "route", "comfort", "courtesy", "alpha", "beta", "classes"];
    assert!(open.iter().all(|it| known.contains(it)), "{open:?}");
    assert!(["route", "alpha", "classes"].iter().all(|it| open.contains(it)), "{open:?}");
    let models: Vec<&Value> =
        report["held_out"].as_array().expect("a list").iter().map(|it| &it["model"]).collect();
    assert_eq!(models, ["constant", "places", "mcdm", "mobil", "lmrs", "raw", "shuffled"]);
    assert_eq!(report["classes"].as_array().map(Vec::len), Some(1));
}

#[test]
fn the_fitted_style_drives_and_the_folder_has_nothing_else_that_looks_like_one() {
    let (folder, _) = &*FITTED;
    let files = std::fs::read_dir(folder.path().join("fit")).expect("a folder");
    let mut names: Vec<String> =
        files.map(|it| it.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    assert_eq!(names, ["fit.html", "fit.json", "fitted.toml"]);
    let run =
        folder.laneweave("run MAPS/ramps.osm --style fit/fitted.toml=1 --duration 20 --quiet --out again");
    assert_eq!(run.code(), 0, "{}", run.errors());
    let style = folder.read("fit/fitted.toml");
    for part in ["sigma = 1.0", "[fit]", "draws_of", "[fit.intervals]", "# The recordings do not tell: route"]
    {
        assert!(style.contains(part), "{part}: {style}");
    }
    let page = folder.read("fit/fit.html");
    assert!(page.starts_with("<!doctype html>") && page.contains("Not identified"), "{page}");
}

#[test]
fn the_same_fit_is_the_same_again() {
    assert_eq!(json(&FITTED.0, FIT), FITTED.1);
}

#[test]
fn a_plan_fits_nothing_and_says_what_would_be_needed() {
    let plan = json(&FITTED.0, "fit observed.csv --map MAPS/ramps.osm --plan --json --out planned");
    assert_eq!(plan["events"], FITTED.1["events"]);
    let expected = plan["expected"].as_array().expect("a list");
    assert!(expected.iter().any(|it| it["name"] == "courtesy" && number(&it["events_for_a_quarter"]) > 1.0));
    assert!(!FITTED.0.path().join("planned").exists());
    let text = FITTED.0.laneweave("fit observed.csv --map MAPS/ramps.osm --plan").text();
    assert!(text.contains("lane changes") && text.contains("for ± 25 %"), "{text}");
}

#[test]
fn the_papers_procedure_stands_beside_ours_when_it_is_asked_for() {
    let report = json(
        &FITTED.0,
        "fit observed.csv --map MAPS/ramps.osm --draws 0 --repetitions 1 --procedure paper --out paper --json",
    );
    let groups: Vec<&Value> =
        report["by_paper"].as_array().expect("a list").iter().map(|it| &it["group"]).collect();
    assert_eq!(groups, ["aggressive", "conservative"]);
    assert_eq!(report["events_used"], FITTED.1["events_used"]);
    assert!(FITTED.1["by_paper"].is_null());
}

#[test]
fn mistakes_are_refused_with_their_place_and_their_remedy() {
    let told = [
        ("fit observed.csv", "observed.csv: a recording needs the map of its location; add --map MAP"),
        ("fit nothing.csv --map MAPS/ramps.osm", "nothing.csv: cannot be read"),
        ("fit observed.csv --map MAPS/town.osm", "most of it lies outside all lanelets"),
        ("fit observed.csv --map MAPS/ramps.osm --prior cautios", "did you mean \"cautious\"?"),
        ("fit observed.csv --map MAPS/ramps.osm --prior mobil", "does not decide by weighted incentives"),
        ("fit observed.csv --map MAPS/ramps.osm --classes many", "choose auto, or 1 to 6"),
        ("fit observed.csv --map MAPS/ramps.osm --lead 30", "choose 0 to 10 s"),
        ("fit observed.csv --map MAPS/ramps.osm --reading exact", "[possible values: literal, repaired]"),
    ];
    for (line, expected) in told {
        let error = refusal(line);
        assert!(error.contains(expected), "{line}: {error}");
    }
}
