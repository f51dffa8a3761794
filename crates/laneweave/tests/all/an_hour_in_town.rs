//! An hour on real maps with a demand above their capacity: nobody is stuck, and traffic keeps moving.

use laneweave_scenario::scenario::{Origin, Scenario, prepare};
use laneweave_sim::World;
use laneweave_test_data::data;

/// The vehicles after an hour at 1,500 veh/h on a map of the real data, if this machine has it; no vehicle was stuck.
fn an_hour(map: &str, seed: u64) -> Option<World> {
    let mut scenario = Scenario::of_map(data(&format!("lanelet2/{map}"))?);
    scenario.run.seed = seed;
    scenario.demand.vehicles_per_hour = Some(1500.0);
    let mut world = prepare(&scenario, &Origin::default()).expect("the map is sound").world;
    (0..36_000).for_each(|_| world.step());
    assert_eq!((world.counters().stuck, world.counters().collisions, world.counters().overlaps), (0, 0, 0));
    Some(world)
}

#[test]
fn a_truck_that_light_after_light_finds_others_before_it_gets_its_turn() {
    if let Some(world) = an_hour("intersection.osm", 2) {
        assert!(world.counts().left > 1000, "{:?}", world.counts());
    }
}

#[test]
fn who_changes_lanes_before_one_who_has_its_passage_locks_nothing() {
    if let Some(world) = an_hour("town10.osm", 2) {
        assert!(world.counts().left > 1200, "{:?}", world.counts());
    }
}

#[test]
fn few_trust_in_a_lane_change_on_the_first_metres_after_a_turn() {
    if let Some(world) = an_hour("town10.osm", 1) {
        let share = world.counters().missed_turns as f64 / world.counts().entered as f64;
        assert!(share < 0.015, "{share}");
    }
}

#[test]
fn nobody_who_has_just_driven_off_brakes_hard_before_a_zone_at_yellow() {
    for (map, seed) in [("crossroads_with_stoplines.osm", 2), ("tianjin.osm", 3)] {
        if let Some(world) = an_hour(map, seed) {
            assert_eq!(world.counters().emergency_brakings, 0, "{map}");
        }
    }
}

#[test]
fn ways_too_short_for_a_truck_behind_a_car_do_not_lock() {
    for seed in [22, 32, 37] {
        if let Some(world) = an_hour("crossroads_with_stoplines.osm", seed) {
            assert!(world.counts().left > 600, "seed {seed}: {:?}", world.counts());
        }
    }
}

#[test]
fn who_enters_a_junction_counts_on_those_beyond_to_drive_on() {
    if let Some(world) = an_hour("kashiwanoha.osm", 1) {
        assert!(world.counts().entered > 530, "{:?}", world.counts());
    }
}

#[test]
fn who_finds_somebody_waiting_in_front_in_an_endless_stream_gets_its_turn_all_the_same() {
    let Some(map) = data("cases/ring_exit.osm") else { return };
    for seed in 1..=4 {
        let mut scenario = Scenario::of_map(map.clone());
        scenario.run.seed = seed;
        scenario.run.audit = true;
        scenario.demand.vehicles_per_hour = Some(1800.0);
        let mut world = prepare(&scenario, &Origin::default()).expect("the map is sound").world;
        (0..9000).for_each(|_| world.step());
        let counters = world.counters();
        assert_eq!((counters.stuck, counters.collisions, counters.overlaps), (0, 0, 0), "seed {seed}");
    }
}
