//! `check` names the same entrances and exits that a run uses.

use std::path::{Path, PathBuf};

use laneweave::Simulation;
use laneweave::scenario::{MapOptions, Origin, Scenario, open_map};
use laneweave::sim::Place;
use laneweave_studies::check::Report;

/// The maps in a folder beside the crates, if it exists.
fn maps(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let files = std::fs::read_dir(folder).into_iter().flatten().flatten();
    files.map(|it| it.path()).filter(|it| it.extension().is_some_and(|it| it == "osm")).collect()
}

#[test]
fn a_report_names_the_entrances_and_exits_of_a_run() {
    let own = maps("../../maps");
    assert!(own.len() > 10);
    // Large maps take long in tests.
    let small = |it: &PathBuf| std::fs::metadata(it).is_ok_and(|it| it.len() < 2_000_000);
    for map in own.into_iter().chain(maps("../../../shared/data/lanelet2").into_iter().filter(small)) {
        let simulation = Simulation::from_scenario(&Scenario::of_map(map.clone()), &Origin::default());
        let Ok(simulation) = simulation else { continue };
        let report = Report::of(&open_map(&map, &MapOptions::default()).expect("it was read before"));
        let [origins, destinations] = simulation.places();
        let gates = |places: &mut dyn Iterator<Item = &Place>| -> Vec<(i64, usize)> {
            let gates = places.filter(|it| matches!(it, Place::Gate(_)));
            gates.map(|it| (it.id(), it.chains().len())).collect()
        };
        let named = |openings: &[laneweave_studies::check::Opening]| -> Vec<(i64, usize)> {
            openings.iter().map(|it| (it.id, it.lanes)).collect()
        };
        let entrances = gates(&mut origins.iter().copied());
        assert_eq!(named(&report.entrances), entrances, "{}", map.display());
        assert_eq!(named(&report.exits), gates(&mut destinations.iter().copied()), "{}", map.display());
        assert_eq!(report.entrances.len() + report.inner_places, origins.len(), "{}", map.display());
    }
}
