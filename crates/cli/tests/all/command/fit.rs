//! `fit`: driving styles from recordings.

use std::path::Path;
use std::sync::LazyLock;

use laneweave_test_data::{data, size};
use serde_json::Value;

use crate::command::golden::assert_golden;
use crate::command::program::{Folder, at_home};

/// The tutorial, and the folder of its figures.
const TUTORIAL: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/src/how-to/from-a-recording");

/// What the commands of the tutorial leave: the folder in which they ran, what they printed, and the report of the fit.
struct Fitted {
    folder: Folder,
    printed: String,
    report: Value,
}

static FITTED: LazyLock<Fitted> = LazyLock::new(|| {
    let (folder, mut printed) = (at_home(), String::new());
    for line in commands(&tutorial()) {
        let run = folder.laneweave(&line);
        assert_eq!(run.code(), 0, "{line}: {}", run.errors());
        printed += &run.text();
    }
    let report = serde_json::from_str(&folder.read("fit/fit.json")).expect("it is JSON");
    Fitted { folder, printed, report }
});

fn tutorial() -> String {
    std::fs::read_to_string(Path::new(TUTORIAL).with_extension("md")).expect("the tutorial")
}

/// The commands of a page, without the name of the program.
fn commands(page: &str) -> Vec<String> {
    page.lines().filter_map(|it| it.strip_prefix("laneweave ")).map(str::to_owned).collect()
}

/// The text of the blocks without a language: what commands print.
fn shown(page: &str) -> Vec<&str> {
    let blocks = page.split("```").skip(1).step_by(2).filter_map(|it| it.strip_prefix('\n'));
    blocks.flat_map(str::lines).collect()
}

/// A fit to the recording of the tutorial that takes less time.
const FIT: &str = "fit tracks.csv --map maps/motorway_2_lanes.osm --draws 20 --repetitions 1";

fn json(folder: &Folder, line: &str) -> Value {
    let run = folder.laneweave(line);
    assert_eq!((run.code(), run.errors().as_str()), (0, ""), "{line}");
    serde_json::from_str(&run.text()).expect("it is JSON")
}

fn refusal(line: &str) -> String {
    let run = FITTED.folder.laneweave(line);
    assert_eq!(run.code(), 2, "{line}: {}", run.text());
    run.errors()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(f64::NAN)
}

#[test]
fn every_lane_change_is_used_or_has_a_reason() {
    let report = &FITTED.report;
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
    let report = &FITTED.report;
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
    let known = ["speed", "route", "comfort", "courtesy", "keeping", "theta", "alpha", "beta", "classes"];
    assert!(open.iter().all(|it| known.contains(it)), "{open:?}");
    assert!(["route", "alpha", "classes"].iter().all(|it| open.contains(it)), "{open:?}");
    let models: Vec<&Value> =
        report["held_out"].as_array().expect("a list").iter().map(|it| &it["model"]).collect();
    assert_eq!(models, ["constant", "places", "mcdm", "mobil", "lmrs", "raw", "shuffled"]);
    assert_eq!(report["classes"].as_array().map(Vec::len), Some(1));
}

#[test]
fn what_is_not_identified_drives_at_the_prior() {
    let style: toml::Table = FITTED.folder.read("fit/fitted.toml").parse().expect("it is TOML");
    let weights = FITTED.report["weights"].as_array().expect("a list");
    for weight in weights.iter().filter(|it| it["name"] != "route") {
        let told = weight["is_identified"].as_bool().expect("yes or no");
        let value = number(if told { &weight["estimate"] } else { &weight["prior"] });
        assert_eq!(number(&weight["value"]), value, "{weight}");
        let driven = &style["change"][weight["name"].as_str().expect("a name")]["weight"];
        assert_eq!(driven.as_float(), Some(value), "{weight}");
        let interval = weight["interval"].as_array().expect("a pair");
        let excludes_0 = number(&interval[0]) > 0.0 || number(&interval[1]) < 0.0;
        assert_eq!(weight["matters"].as_bool(), Some(excludes_0), "{weight}");
    }
}

#[test]
fn the_fitted_style_drives_and_the_folder_has_nothing_else_that_looks_like_one() {
    let folder = &FITTED.folder;
    let files = std::fs::read_dir(folder.path().join("fit")).expect("a folder");
    let mut names: Vec<String> =
        files.map(|it| it.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    let styles_and_figures =
        ["density.svg", "fit.html", "fit.json", "fitted.toml", "prediction.svg", "world.svg"];
    assert_eq!(names, styles_and_figures);
    let run = folder.laneweave(
        "run maps/motorway_2_lanes.osm --style fit/fitted.toml=1 --duration 20 --quiet --out again",
    );
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
fn the_tutorial_shows_what_its_commands_print_and_draw() {
    for line in shown(&tutorial()) {
        let is_printed = FITTED.printed.lines().any(|it| it.trim_end() == line.trim_end());
        assert!(is_printed, "nothing prints: {line}\n{}", FITTED.printed);
    }
    for figure in ["prediction.svg", "world.svg"] {
        assert_golden(&Path::new(TUTORIAL).join(figure), &FITTED.folder.read(&format!("fit/{figure}")));
    }
}

#[test]
fn the_second_claim_is_measured_at_a_recorded_site() {
    // It takes half a minute.
    if !size().pick(false, true) {
        return;
    }
    let run = FITTED
        .folder
        .laneweave("reproduce C2 --site tracks.csv --map maps/motorway_2_lanes.osm --seeds 1 --out claim");
    assert_eq!(run.code(), 0, "{}", run.errors());
    assert!(run.text().contains("follow the recorded rate"), "{}", run.text());
    let rows = FITTED.folder.read("claim/C2_site.csv");
    // Two designs, three classes of density, five models.
    assert_eq!(rows.lines().count(), 1 + 2 * 3 * 5, "{rows}");
    for figure in ["C2_site", "C2_site_snapshots"] {
        assert!(
            FITTED.folder.read(&format!("claim/{figure}.svg")).contains("Density of the lane"),
            "{figure}"
        );
    }
}

#[test]
fn the_same_fit_is_the_same_again_but_for_the_thetas_that_judging_moves() {
    let mut report = FITTED.report.clone();
    let judged = report.as_object_mut().and_then(|it| it.remove("judged")).expect("it was judged");
    let mut again = json(&FITTED.folder, &format!("{FIT} --json --out same"));
    let [moved, likely] = [&mut report, &mut again].map(|it| it["classes"][0]["theta"].take());
    let by = number(&judged["theta_moved_by"]);
    assert!(by != 0.0 && (number(&moved) - number(&likely) - by).abs() < 1e-9, "{moved} {likely} {by}");
    assert_eq!(again, report);
}

#[test]
fn a_fit_is_judged_beside_recorded_traffic_that_it_has_not_seen() {
    let judged = &FITTED.report["judged"];
    let models: Vec<&Value> =
        judged["models"].as_array().expect("a list").iter().map(|it| &it["model"]).collect();
    assert_eq!(models, ["fitted", "null", "mobil", "lmrs", "default"]);
    assert!(number(&judged["fitted_s"]) > 190.0 && number(&judged["simulated_s"]) > 90.0, "{judged}");
    let snapshots = &judged["snapshots"];
    assert_eq!(snapshots["simulations"], 2, "100 s have two snapshots of 40 s");
    assert!(snapshots["measures"].as_array().is_some_and(|it| !it.is_empty()));
    let measures = judged["measures"].as_array().expect("a list");
    let measure = |key: &str| measures.iter().find(|it| it["key"] == key).expect("it is measured");
    for key in ["rate", "faster_share_pct", "lead_gap_m", "duration_s", "speed_kmh", "pace_s_per_km"] {
        let predicted = measure(key)["simulated"].as_array().expect("a list");
        assert_eq!(predicted.len(), models.len());
        for it in predicted {
            let interval = [&it["interval"][0], &it["interval"][1]].map(number);
            let median = number(&it["median"]);
            assert!(interval[0] <= median && median <= interval[1], "{key}: {it}");
            assert!(
                (number(&it["width"]) - (interval[1] - interval[0])).abs() < 1e-9
                    && number(&it["crps"]) >= 0.0
            );
        }
    }
    // The true style, with the recorded demand: rate, durations and speed are predicted, and speed better than by a
    // constant chance. For one rate of 100 s that chance, which has the rate of the rest, is as good.
    for key in ["rate", "duration_s", "speed_kmh"] {
        assert_eq!(measure(key)["simulated"][0]["recorded_is"], "inside", "{key}: {}", measure(key));
    }
    let score = |model: usize| number(&measure("speed_kmh")["simulated"][model]["crps"]);
    assert!(score(0) < score(1), "{}", measure("speed_kmh"));
}

#[test]
fn draws_of_parameters_say_how_much_of_the_spread_is_not_chance() {
    let draws: Value = serde_json::from_str(&FITTED.folder.read("again/draws.json")).expect("it is JSON");
    assert_eq!((&draws["draws"], &draws["per_draw"]), (&5.into(), &2.into()));
    let measures = draws["measures"].as_array().expect("a list");
    let speed = measures.iter().find(|it| it["measure"] == "mean_speed_kmh").expect("it is measured");
    assert_eq!(speed["values"].as_array().map(Vec::len), Some(10));
    assert!((0.0..=1.0).contains(&number(&speed["from_parameters"])), "{speed}");
    let run = "run maps/motorway_2_lanes.osm --duration 10 --out more --draw-parameters";
    assert!(refusal(&format!("{run} 3")).contains("no style of the scenario has draws of its parameters"));
    let told = refusal(&format!("{run} 21 --style fit/fitted.toml=1"));
    assert!(told.contains("has 20 draws of its parameters, but 21 are asked for"), "{told}");
    assert!(!FITTED.folder.path().join("more").exists());
}

#[test]
fn a_plan_fits_nothing_and_says_what_would_be_needed() {
    let plan =
        json(&FITTED.folder, "fit tracks.csv --map maps/motorway_2_lanes.osm --plan --json --out planned");
    assert_eq!(plan["events"], FITTED.report["events"]);
    let expected = plan["expected"].as_array().expect("a list");
    assert!(expected.iter().any(|it| it["name"] == "courtesy" && number(&it["events_for_a_quarter"]) > 1.0));
    assert!(!FITTED.folder.path().join("planned").exists());
    let text = FITTED.folder.laneweave("fit tracks.csv --map maps/motorway_2_lanes.osm --plan").text();
    assert!(text.contains("lane changes") && text.contains("for ± 25 %"), "{text}");
}

/// What a fit to the recording of the tutorial finds with the paper's procedure beside it, and corrected for errors of
/// positions.
static CORRECTED: LazyLock<Value> = LazyLock::new(|| {
    let line = format!("{FIT} --procedure paper --position-error 0.1 --out corrected --json");
    json(&FITTED.folder, &line)
});

#[test]
fn the_papers_procedure_stands_beside_ours_when_it_is_asked_for() {
    let report = &CORRECTED;
    let groups: Vec<&Value> =
        report["by_paper"].as_array().expect("a list").iter().map(|it| &it["group"]).collect();
    assert_eq!(groups, ["aggressive", "conservative"]);
    assert_eq!(report["events_used"], FITTED.report["events_used"]);
    assert!(FITTED.report["by_paper"].is_null());
}

#[test]
fn weights_are_corrected_for_errors_of_positions_whose_size_is_given() {
    let (plain, usual) = (&FITTED.report, &CORRECTED);
    assert!(plain["correction"].is_null());
    assert_eq!(number(&usual["correction"]["position_error_m"]), 0.1);
    // Errors of a micrometre change nothing.
    let small = size().pick(None, Some(format!("{FIT} --position-error 1e-6 --out small --json")));
    let small = small.map(|it| json(&FITTED.folder, &it));
    for (at, weight) in plain["weights"].as_array().expect("a list").iter().enumerate() {
        let [estimate, error] = ["estimate", "standard_error"].map(|it| number(&weight[it]));
        let of = |report: &Value| number(&report["weights"][at]["estimate"]);
        assert_eq!(number(&usual["correction"]["uncorrected"][at]["estimate"]), estimate, "{weight}");
        assert!(error == 0.0 || of(usual) != estimate, "{weight}");
        if let Some(small) = &small {
            assert!((of(small) - estimate).abs() < 0.05 * error, "{weight} {small}");
        }
    }
    let style = FITTED.folder.read("corrected/fitted.toml");
    let courtesy = number(&usual["weights"][3]["estimate"]);
    assert!(style.contains(&format!("{courtesy}")), "{courtesy} {style}");
}

#[test]
fn sites_are_held_out_where_there_are_several() {
    let Some(data) = data("recordings/ngsim_commonroad") else { return };
    let names = ["USA_US101-26_1_T-1", "USA_US101-6_1_T-1", "USA_Lanker-1_3_T-1"];
    let files = names.map(|it| data.join(format!("{it}.xml")).display().to_string()).join(" ");
    let report = json(&FITTED.folder, &format!("fit {files} --draws 0 --repetitions 1 --out sites --json"));
    for model in report["held_out"].as_array().expect("a list") {
        let elsewhere = &model["elsewhere"];
        assert!(number(&elsewhere["over_constant"]).is_finite(), "{model}");
        let is_constant = model["model"] == "constant";
        assert_eq!(number(&elsewhere["over_constant"]) == 0.0, is_constant, "{model}");
    }
    assert!(FITTED.report["held_out"][2]["elsewhere"].is_null());
}

#[test]
fn mistakes_are_refused_with_their_place_and_their_remedy() {
    let told = [
        ("fit tracks.csv", "tracks.csv: a recording needs the map of its location; add --map MAP"),
        ("fit nothing.csv --map maps/motorway_2_lanes.osm", "nothing.csv: cannot be read"),
        ("fit tracks.csv --map maps/town.osm", "most of the recording lies outside all lanelets"),
        ("fit tracks.csv --map maps/motorway_2_lanes.osm --prior cautios", "did you mean \"cautious\"?"),
        (
            "fit tracks.csv --map maps/motorway_2_lanes.osm --prior mobil",
            "does not decide by weighted incentives",
        ),
        ("fit tracks.csv --map maps/motorway_2_lanes.osm --classes many", "choose auto, or 1 to 6"),
        ("fit tracks.csv --map maps/motorway_2_lanes.osm --lead 30", "choose 0 to 10 s"),
        (
            "fit tracks.csv --map maps/motorway_2_lanes.osm --position-error 0",
            "choose more than 0, and 1 m at most",
        ),
        (
            "fit tracks.csv --map maps/motorway_2_lanes.osm --reading exact",
            "[possible values: literal, repaired]",
        ),
    ];
    for (line, expected) in told {
        let error = refusal(line);
        assert!(error.contains(expected), "{line}: {error}");
    }
}
