//! A vehicle whose user does what its driver intends moves like one without a user, bit for bit.

use laneweave_sim::{Command, Control, VehicleId, World};
use laneweave_test_data::size;

use crate::external::worlds::world;

/// The maps with their demand [veh/h].
const MAPS: [(&str, f64); 3] = [("motorway_3_lanes.osm", 4500.0), ("ramps.osm", 4000.0), ("town.osm", 900.0)];
/// Steps of a run: five minutes.
const STEPS: u32 = 3000;

/// Gives every vehicle that `is_driven` the control that its driver intends.
fn echo(world: &mut World, is_driven: impl Fn(VehicleId) -> bool) -> usize {
    let ids: Vec<VehicleId> = world.vehicles().map(|it| it.id()).filter(|it| is_driven(*it)).collect();
    for id in &ids {
        let intention = world.intention(*id).expect("it is on the road");
        world.command(Command::Control(*id, intention.control())).expect("it is possible");
    }
    ids.len()
}

fn assert_echoes(map: &str, demand: f64, seed: u64, is_driven: impl Fn(VehicleId) -> bool + Copy) {
    let [mut free, mut driven] = [1, 1].map(|threads| world(map, demand, seed, threads));
    let mut events = 0;
    for step in 0..STEPS {
        let count = echo(&mut driven, is_driven);
        free.step();
        driven.step();
        assert_eq!(driven.events(), free.events(), "{map}, seed {seed}, step {step}, {count} driven");
        assert_eq!(driven.commands().len(), count);
        events += free.events().len();
        if step % 50 == 0 {
            assert_eq!(driven.state_hash(), free.state_hash(), "{map}, seed {seed}, step {step}");
        }
    }
    assert_eq!(driven.state_hash(), free.state_hash());
    assert_eq!((driven.counters(), driven.counts()), (free.counters(), free.counts()));
    assert!(events > 100, "{map}: {events} events only");
}

#[test]
fn a_vehicle_that_is_given_back_its_own_intention_changes_nothing() {
    for (map, demand) in MAPS {
        for seed in 1..=size().pick(4, 20) {
            assert_echoes(map, demand, seed, |id| id == 40);
        }
    }
}

#[test]
fn all_vehicles_that_are_given_back_their_own_intentions_change_nothing() {
    for (map, demand) in MAPS {
        for seed in 1..=size().pick(4, 20) {
            assert_echoes(map, demand, seed, |_| true);
        }
    }
}

#[test]
fn a_vehicle_left_to_its_driver_is_no_external_vehicle() {
    let mut world = world("ramps.osm", 2000.0, 1, 1);
    (0..600).for_each(|_| world.step());
    let id = world.vehicles().next().expect("there is traffic").id();
    world.command(Command::Control(id, Control::DRIVER)).expect("it is possible");
    world.step();
    assert_eq!((world.externals().count(), world.control_of(id)), (0, Control::DRIVER));
}
