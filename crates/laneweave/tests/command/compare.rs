//! `laneweave compare`: lane-change models side by side.

use crate::program::Folder;

/// The cells of a table, by row, without its header.
fn rows(table: &str) -> Vec<Vec<&str>> {
    table.lines().skip(1).map(|it| it.split(',').collect()).collect()
}

#[test]
fn every_model_drives_with_every_seed_and_what_comes_out_is_what_a_run_gives() {
    let folder = Folder::new();
    let line = "compare MAPS/ramps.osm --seeds 2 --duration 90 --warmup 30 --demand 5000 --model mcdm --model mobil-lanes";
    let told = folder.laneweave(line);
    assert_eq!((told.code(), told.errors().as_str()), (0, ""));
    for word in ["mcdm", "mobil-lanes", "changes by choice [1/veh-km]", "2 seeds: means with 95 % intervals"]
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
    let per_km = found("discretionary_per_veh_km") + found("route_per_veh_km");
    let expected = |name: &str| summary[name].as_f64().unwrap();
    assert!((per_km - expected("lane_changes_per_veh_km")).abs() < 1e-12);
    assert_eq!(found("mean_delay_s"), expected("mean_delay_s"));
    assert_eq!(found("left"), expected("left"));
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
    assert!(refused("compare MAPS/ramps.osm --seeds 0").contains("1..=10000"));
    assert!(!folder.holds("comparison"));
}
