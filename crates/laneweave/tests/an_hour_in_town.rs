//! An hour on real maps with more traffic than they bear: nobody is stuck, and traffic goes on.

use std::path::Path;

use laneweave::scenario::{Origin, Scenario, prepare};

/// Vehicles that left in an hour at 1,500 veh/h on a map of the shared data, if it is there; nobody was stuck.
fn left(map: &str, seed: u64) -> Option<u64> {
    let map = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/lanelet2").join(map);
    if !map.exists() {
        eprintln!("skipped: {} is not there", map.display());
        return None;
    }
    let mut scenario = Scenario::of_map(map);
    scenario.run.seed = seed;
    scenario.demand.vehicles_per_hour = Some(1500.0);
    let mut world = prepare(&scenario, &Origin::default()).expect("the map is sound").world;
    (0..36_000).for_each(|_| world.step());
    let (tally, counts) = (world.tally(), world.counts());
    assert_eq!((tally.stuck, tally.collisions, counts.overlaps), (0, 0, 0));
    Some(counts.left)
}

#[test]
fn a_truck_that_light_after_light_finds_others_before_it_gets_its_turn() {
    if let Some(left) = left("intersection.osm", 2) {
        assert!(left > 1000, "{left}");
    }
}

#[test]
fn who_changes_lanes_before_one_who_has_its_passage_locks_nothing() {
    if let Some(left) = left("town10.osm", 2) {
        assert!(left > 1200, "{left}");
    }
}
