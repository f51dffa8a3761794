//! `laneweave branch`: the same traffic with one thing changed.

use crate::program::Folder;
use crate::report::{assert_needs_nothing, figures, has_units, texts};

#[test]
fn what_differs_is_told_and_lies_in_tables_and_on_a_page() {
    let folder = Folder::new();
    folder.summary("MAPS/ramps.osm --demand 4000 --duration 200 --record 0 --format csv");
    let told = folder.laneweave("branch out --at 80 --set style.speed.weight=2");
    assert_eq!((told.code(), told.errors().as_str()), (0, ""));
    for file in ["differences.csv", "instants.csv", "report.html"] {
        assert!(told.text().contains(&format!("out/branch/{file}")), "{}", told.text());
    }
    // A row for each second, and its header.
    assert_eq!(folder.read("out/branch/instants.csv").lines().count(), 1 + 120);

    let page = folder.read("out/branch/report.html");
    assert_needs_nothing(&page);
    texts(&page);
    let figures = figures(&page);
    assert_eq!(figures.len(), 6);
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
}

#[test]
fn with_nothing_changed_nothing_differs_and_nothing_is_written() {
    let folder = Folder::new();
    folder.summary("MAPS/lane_drop.osm --demand 3000 --duration 60 --record 0");
    let told = folder.laneweave("branch out --at 20");
    assert_eq!(told.code(), 0);
    assert!(told.text().contains("none: both twins are the same to the last bit"), "{}", told.text());
    assert!(!folder.holds("out/branch"));
}
