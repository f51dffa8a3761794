//! `check` names the same entrances and exits that a run uses.

use std::path::{Path, PathBuf};

use laneweave::check::Report;
use laneweave::scenario::{MapOptions, Origin, Scenario, open_map, prepare};
use laneweave::sim::Place;

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
        let Ok(prepared) = prepare(&Scenario::of_map(map.clone()), &Origin::default()) else { continue };
        let report = Report::of(&open_map(&map, &MapOptions::default()).expect("it was read before"));
        let demand = prepared.world.demand();
        let gates = |places: &mut dyn Iterator<Item = &Place>| -> Vec<(i64, usize)> {
            let gates = places.filter(|it| matches!(it, Place::Gate(_)));
            gates.map(|it| (it.id(), it.chains().len())).collect()
        };
        let named = |openings: &[laneweave::check::Opening]| -> Vec<(i64, usize)> {
            openings.iter().map(|it| (it.id, it.lanes)).collect()
        };
        let entrances = gates(&mut demand.origins.iter().map(|it| &it.place));
        assert_eq!(named(&report.entrances), entrances, "{}", map.display());
        assert_eq!(named(&report.exits), gates(&mut demand.destinations.iter()), "{}", map.display());
        assert_eq!(report.entrances.len() + report.inner_places, demand.origins.len(), "{}", map.display());
    }
}
