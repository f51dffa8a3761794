//! Cut-ins of the drivers that come with laneweave: some close in fast, and nobody collides.

use laneweave::{Event, Simulation};
use laneweave_models::Parameter;
use laneweave_scenario::scenario::{Origin, Scenario};
use laneweave_sim::{Command, World};

/// The usual drivers on a motorway with ramps, at its capacity.
fn ramps(seed: u64) -> Scenario {
    let mut scenario = Scenario::of_map(laneweave_test_data::map("ramps.osm"));
    scenario.demand.vehicles_per_hour = Some(4500.0);
    (scenario.run.warmup_s, scenario.run.duration_s) = (300.0, 900.0);
    scenario.run.seed = seed;
    scenario
}

#[test]
fn some_drivers_cut_in_with_less_than_three_seconds_to_a_collision_and_nobody_collides() {
    let mut closing = Vec::new();
    for seed in 1..=2 {
        let mut simulation =
            Simulation::from_scenario(&ramps(seed), &Origin::default()).expect("the map is sound");
        for _ in 0..12_000 {
            for event in simulation.step() {
                let Event::LaneChange(it) = event else { continue };
                closing.extend(it.ttc_behind_s.filter(|_| it.is_completed));
            }
        }
        assert_eq!(simulation.counters().overlaps + simulation.counters().collisions, 0);
    }
    let short = closing.iter().filter(|it| **it < 3.0).count();
    // T_th of a driver is at least 1 s.
    assert!(short >= 3 && closing.iter().all(|it| *it >= 1.0), "{short} of {}", closing.len());
}

/// The world of [`ramps`], whose conservative drivers have errors of that size in what they see.
fn misperceiving(size: f64) -> World {
    let scenario = ramps(1);
    let mut world =
        laneweave_scenario::scenario::prepare(&scenario, &Origin::default()).expect("sound").world;
    let command = Command::SetParameter {
        style: "conservative".into(),
        parameter: Parameter::Misperception,
        value: size,
    };
    world.command(command).expect("there is such a style");
    world
}

#[test]
fn errors_of_perception_change_traffic_and_a_restored_world_has_the_same_ones() {
    let [mut exact, mut usual] = [0.0, 1.0].map(misperceiving);
    for _ in 0..3000 {
        exact.step();
        usual.step();
    }
    assert_ne!(exact.state_hash(), usual.state_hash());
    let saved = usual.save().expect("it can be saved");
    let mut restored = misperceiving(0.0);
    restored.restore(&saved).expect("it is the same world");
    for _ in 0..600 {
        usual.step();
        restored.step();
    }
    assert_eq!(restored.state_hash(), usual.state_hash());
    assert!(usual.on_road() > 100);
}
