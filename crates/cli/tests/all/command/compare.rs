//! `laneweave compare`: lane-change models side by side.

use crate::command::program::Folder;
use crate::command::report::{assert_downloads, assert_needs_nothing, figures, has_units, texts};

/// The cells of a table, by row, without its header.
fn rows(table: &str) -> Vec<Vec<&str>> {
    table.lines().skip(1).map(|it| it.split(',').collect()).collect()
}

#[test]
fn every_model_drives_with_every_seed_and_what_comes_out_is_what_a_run_gives() {
    let folder = Folder::new();
    let line = "compare MAPS/ramps.osm --seeds 2 --duration 90 --warmup 30 --demand 5000 --model mcdm --model mobil-lanes --model mcdm";
    let told = folder.laneweave(line);
    assert_eq!((told.code(), told.errors().as_str()), (0, ""));
    for word in
        ["mcdm", "mobil-lanes", "discretionary lane changes [1/veh-km]", "2 seeds: means with 95 % intervals"]
    {
        assert!(told.text().contains(word), "{word}: {}", told.text());
    }
    let table = folder.read("comparison/runs.csv");
    let runs = rows(&table);
    let named: Vec<(&str, &str)> = runs.iter().map(|it| (it[1], it[2])).collect();
    assert_eq!(named, [("mcdm", "1"), ("mcdm", "2"), ("mobil-lanes", "1"), ("mobil-lanes", "2")]);
    let summary = folder.summary(
        "MAPS/ramps.osm --duration 90 --warmup 30 --demand 5000 --record 0 --model mobil-lanes --seed 2",
    );
    let column = |name: &str| table.lines().next().unwrap().split(',').position(|it| it == name).unwrap();
    let found = |name: &str| runs[3][column(name)].parse::<f64>().unwrap();
    let kinds = ["discretionary", "route", "keeping"];
    let per_km: f64 = kinds.iter().map(|it| found(&format!("{it}_per_veh_km"))).sum();
    let expected = |name: &str| summary[name].as_f64().unwrap();
    assert!((per_km - expected("lane_changes_per_veh_km")).abs() < 1e-12);
    for name in ["mean_delay_s", "completed", "waiting_to_enter"] {
        assert_eq!(found(name), expected(name), "{name}");
    }
}

#[test]
fn the_report_shows_every_model_on_every_input_with_its_interval() {
    let folder = Folder::new();
    let line = "compare MAPS/lane_drop.osm MAPS/town.osm --seeds 3 --duration 120 --demand 2000 --out both \
                --model mcdm --model lmrs --model constant-hazard";
    let told = folder.laneweave(line);
    assert_eq!((told.code(), told.errors().as_str()), (0, ""));
    let page = folder.read("both/report.html");
    assert_needs_nothing(&page);
    assert_downloads(&page);
    texts(&page);
    for text in
        ["<section id=\"input-1\">", "Models on town.osm", "<dt>Seeds</dt><dd>3 for each model: 1 to 3"]
    {
        assert!(page.contains(text), "{text}");
    }
    let figures = figures(&page);
    assert!(figures.len() >= 16, "{}", figures.len());
    assert!(figures.iter().all(|it| has_units(it)), "{figures:?}");
    // Each printed row is there, cell by cell.
    let rows = told.text();
    let rows: Vec<(&str, Vec<&str>)> = rows
        .lines()
        .filter_map(|row| row.split_once("  "))
        .map(|(name, cells)| (name, cells_of(cells)))
        .filter(|(name, _)| !name.is_empty())
        .collect();
    assert_eq!(rows.len(), 26);
    for (name, cells) in rows {
        assert_eq!(cells.len(), 3, "{name}");
        let numbers: String = ["mcdm", "lmrs", "constant-hazard"]
            .iter()
            .zip(&cells)
            .map(|(model, cell)| {
                format!("<td data-name=\"{model}\" class=\"number\">{}</td>", cell.replace("-", "–"))
            })
            .collect();
        assert!(page.contains(&format!("{name}</th>{numbers}")), "{name}: {numbers}");
    }
}

/// The contents of text columns, such as 0.1 ± 0.2.
fn cells_of(row: &str) -> Vec<&str> {
    row.split("  ").map(str::trim).filter(|it| !it.is_empty()).collect()
}

#[test]
fn what_cannot_be_compared_is_refused_with_a_remedy() {
    let folder = Folder::new();
    let refused = |line: &str| {
        let run = folder.laneweave(line);
        assert_eq!(run.code(), 2, "{line}");
        run.errors()
    };
    assert!(refused("compare nowhere.osm").contains("nowhere.osm"));
    assert!(refused("compare MAPS/ramps.osm --model mobl").contains("mobil"));
    assert!(refused("compare MAPS/ramps.osm --seeds 0").contains("choose a whole number, 1 to 10000"));
    // Nothing runs before everything has been checked.
    let run = folder.laneweave("compare MAPS/ramps.osm nowhere.osm --duration 10 --seeds 1");
    assert_eq!((run.code(), run.text().as_str()), (2, ""));
    let far = format!(
        "map = \"{}/ramps.osm\"\n[run]\nseed = {}\n",
        crate::command::program::maps().display(),
        i64::MAX - 3
    );
    let folder = folder.with("far.toml", &far);
    let refused = folder.laneweave("compare far.toml --seeds 4");
    assert!(
        refused.errors().contains("--seeds: 4 seeds from 9223372036854775804 on go beyond"),
        "{}",
        refused.errors()
    );
    assert!(!folder.holds("comparison"));
    let folder = folder.with("comparison", "a file");
    let run = folder.laneweave("compare MAPS/ramps.osm --duration 10 --seeds 1");
    assert_eq!((run.code(), run.text().as_str()), (2, ""));
}
