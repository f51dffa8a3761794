//! `check` names the same entrances and exits that a run uses.

use laneweave_network::Id;
use std::path::{Path, PathBuf};

use laneweave::Simulation;
use laneweave::scenario::{MapOptions, Origin, Scenario, open_map};
use laneweave::sim::Place;
use laneweave_studies::check::Report;
use laneweave_test_data::{data, maps};

/// The maps in a folder.
fn osm_files(folder: &Path) -> Vec<PathBuf> {
    let files = std::fs::read_dir(folder).expect("a folder").flatten();
    files.map(|it| it.path()).filter(|it| it.extension().is_some_and(|it| it == "osm")).collect()
}

#[test]
fn a_report_names_the_entrances_and_exits_of_a_run() {
    let own = osm_files(&maps());
    assert!(own.len() > 10);
    // Large maps take long in tests.
    let is_small = |it: &PathBuf| std::fs::metadata(it).is_ok_and(|it| it.len() < 2_000_000);
    let real = data("lanelet2").map(|it| osm_files(&it)).unwrap_or_default();
    for map in own.into_iter().chain(real.into_iter().filter(is_small)) {
        let simulation = Simulation::from_scenario(&Scenario::of_map(map.clone()), &Origin::default());
        let Ok(simulation) = simulation else { continue };
        let report = Report::of(&open_map(&map, &MapOptions::default()).expect("it was read before"));
        let [origins, destinations] = simulation.places();
        let gates = |places: &mut dyn Iterator<Item = &Place>| -> Vec<(Id, usize)> {
            let gates = places.filter(|it| matches!(it, Place::Gate(_)));
            gates.map(|it| (it.id(), it.chains().len())).collect()
        };
        let named = |openings: &[laneweave_studies::check::Opening]| -> Vec<(Id, usize)> {
            openings.iter().map(|it| (it.id, it.lanes)).collect()
        };
        let entrances = gates(&mut origins.iter().copied());
        assert_eq!(named(&report.entrances), entrances, "{}", map.display());
        assert_eq!(named(&report.exits), gates(&mut destinations.iter().copied()), "{}", map.display());
        assert_eq!(report.entrances.len() + report.inner_places, origins.len(), "{}", map.display());
    }
}
