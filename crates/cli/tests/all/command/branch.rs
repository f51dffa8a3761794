//! `laneweave branch`: the same traffic with one thing changed.

use crate::command::program::Folder;
use crate::command::report::{assert_downloads, assert_needs_nothing, figures, has_units, texts};
use crate::command::run::rows;

#[test]
fn what_differs_is_told_and_lies_in_tables_and_on_a_page() {
    let folder = Folder::new();
    folder.summary("MAPS/ramps.osm --demand 4000 --duration 200 --record 0 --format csv");
    let told = folder.laneweave("branch out --at 80 --set style.speed.weight=2");
    assert_eq!((told.code(), told.errors().as_str()), (0, ""));
    for file in ["differences.csv", "instants.csv", "report.html"] {
        assert!(told.text().contains(&format!("out/branch/{file}")), "{}", told.text());
    }
    let differing = rows(&folder.read("out/branch/differences.csv"));
    let completed = |run: &str| differing.iter().any(|it| !it[&format!("{run}_completed_s")].is_empty());
    assert!(completed("base") && completed("branch"));
    // A row for each second, and its header.
    assert_eq!(folder.read("out/branch/instants.csv").lines().count(), 1 + 120);

    let page = folder.read("out/branch/report.html");
    assert_needs_nothing(&page);
    assert_downloads(&page);
    texts(&page);
    let figures = figures(&page);
    assert_eq!(figures.len(), 5);
    assert!(figures.iter().all(|it| has_units(it)), "{figures:?}");
    let lines: Vec<(String, String)> = told
        .text()
        .lines()
        .filter(|it| !it.contains("out/branch"))
        .map(|it| (it[2..19].trim().to_owned(), it[19..].to_owned()))
        .collect();
    assert_eq!(lines.len(), 7, "{lines:?}");
    for (name, value) in lines {
        assert!(page.contains(&format!("<dt>{name}</dt><dd>{value}</dd>")), "{name}: {value}");
    }

    // There is no difference now, and the output names none.
    assert_eq!(folder.laneweave("branch out --at 80").code(), 0);
    assert!(!folder.holds("out/branch") && folder.holds("out/report.html"));
}

#[test]
fn what_differs_between_two_whole_seconds_is_seen() {
    let folder = Folder::new();
    folder.summary("MAPS/ramps.osm --demand 4000 --duration 60.5 --record 0 --format csv");
    let told = folder.laneweave("branch out --at 60.2 --set style.follow.time_gap=3").text();
    assert!(told.contains("at 60.3 s"), "{told}");
    assert_eq!(folder.read("out/branch/instants.csv").lines().count(), 2, "the last one");
}

#[test]
fn what_cannot_be_set_is_refused_even_if_some_styles_could_have_it() {
    let folder = Folder::new();
    let styles = "--style paper-aggressive=1 --style conservative=1 --style lmrs=1";
    folder.summary(&format!("MAPS/ramps.osm --duration 20 --record 0 {styles}"));
    let refused = |setting: &str| {
        let run = folder.laneweave(&format!("branch out --at 10 --set {setting}"));
        assert_eq!(run.code(), 2, "{setting}");
        run.errors()
    };
    // The threshold rule could work without noise; the rule with the logit cannot.
    assert!(refused("style.sigma=0").contains("a logit rule without choice noise"));
    assert!(refused("style.speeed.weight=2").contains("did you mean \"speed\"?"));
    assert!(refused("style.theta=high").contains("not a number"));
    assert!(!folder.holds("out/branch"));
    assert_eq!(folder.laneweave("branch out --at 10 --set style.speed.weight=2").code(), 0);
    assert!(
        folder
            .laneweave("branch out --at 10 --into out")
            .errors()
            .contains("choose another folder with --into")
    );
}

#[test]
fn with_nothing_changed_nothing_differs_and_nothing_is_written() {
    let folder = Folder::new();
    folder.summary("MAPS/lane_drop.osm --demand 3000 --duration 60 --record 0");
    let told = folder.laneweave("branch out --at 20");
    assert_eq!(told.code(), 0);
    assert!(told.text().contains("none: both runs are the same to the last bit"), "{}", told.text());
    assert!(!folder.holds("out/branch"));
    let refused = folder.laneweave("branch out --at nan");
    assert_eq!(refused.code(), 2);
    assert!(refused.errors().contains("choose a time before its end"), "{}", refused.errors());
}

#[test]
fn commands_of_users_can_be_changed_and_what_is_not_possible_is_told() {
    let map = crate::command::program::maps().join("motorway_2_lanes.osm");
    let scenario = format!(
        "map = \"{}\"\n[demand]\nvehicles_per_hour = 900\n[run]\nduration_s = 40\n[[external]]\ntime_s = 10\nlanelet = 5\n\
         position_m = 60\nspeed_mps = 20\nstyle = \"aggressive\"\nheld_speed_mps = 5\n",
        map.display()
    );
    let other = "time_s,act,values\n30,remove,1000000000\n31,remove,1000000000\n";
    let folder = Folder::new().with("own.toml", &scenario).with("other.csv", other);
    let run = folder.laneweave("run own.toml --record 0 --format csv");
    assert_eq!((run.code(), run.errors().as_str()), (0, ""));
    let rows = rows(&folder.read("out/commands.csv"));
    assert_eq!(rows.iter().map(|it| it["act"].as_str()).collect::<Vec<_>>(), ["insert", "control"]);

    let same = folder.laneweave("branch out --at 20 --set commands=out/commands.csv").text();
    assert!(same.contains("none: both runs are the same to the last bit"), "{same}");
    let changed = folder.laneweave("branch out --at 20 --set commands=other.csv");
    assert_eq!(changed.code(), 0);
    let differing = crate::command::run::rows(&folder.read("out/branch/differences.csv"));
    let removed = differing.iter().find(|it| it["vehicle"] == "1000000000").unwrap();
    assert_eq!(removed["since_s"], "30.1");
    let told = changed.errors();
    assert!(
        told.starts_with(
            "warning: commands: other.csv, row 2 (at 31 s): vehicle 1000000000 is not on the road"
        ),
        "{told}"
    );
    let refused = folder.laneweave("branch out --at 20 --set commands=nowhere.csv");
    assert_eq!(refused.code(), 2);
    assert!(refused.errors().contains("nowhere.csv: cannot be read"), "{}", refused.errors());
    // Without its table a run cannot be repeated.
    assert_eq!(folder.laneweave("explain out --summary").code(), 0);
    std::fs::remove_file(folder.path().join("out/commands.csv")).unwrap();
    assert_eq!(folder.laneweave("explain out --summary").code(), 2);
}
