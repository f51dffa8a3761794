//! Worlds of a template are those that are made one by one, and what one of them changes concerns no other.

use laneweave_models::Parameter;
use laneweave_network::Id;
use laneweave_sim::{Command, Setup, Template, World};

use crate::roads::{drivers, network};

/// A world at its start, with guidance where there is a choice of routes.
fn world(map: &str, seed: u64) -> World {
    let network = network(map);
    let demand = drivers::demand(&network, 2000.0, 0.1, &[0.3, 0.7]);
    let driver_parameters = vec![drivers::aggressive(), drivers::conservative()];
    let setup = Setup { step: 0.1, seed, threads: 1 };
    let world = World::new(network, driver_parameters, demand, setup).expect("the set-up makes sense");
    world.guided(30.0).expect("few destinations").with_trip_log().warming_up(300)
}

/// A hash of the traffic, and all state as bytes, after so many steps.
fn driven(mut world: World, steps: u32) -> (u64, Vec<u8>) {
    (0..steps).for_each(|_| world.step());
    (world.state_hash(), world.save().expect("there is memory"))
}

#[test]
fn a_spawned_world_and_one_that_was_reset_are_worlds_of_their_seed() {
    for map in ["on_ramp.osm", "roundabout.osm", "grid.osm"] {
        let template = Template::from(world(map, 1));
        let mut used = template.spawn(9, 2).expect("the system has two threads");
        (0..700).for_each(|_| used.step());
        for seed in [1, 5, u64::MAX] {
            let alone = driven(world(map, seed), 900);
            assert!(driven(template.spawn(seed, 1).unwrap(), 900) == alone, "{map}: spawned with {seed}");
            used.reset(&template, seed);
            (0..900).for_each(|_| used.step());
            assert!((used.state_hash(), used.save().unwrap()) == alone, "{map}: reset to {seed}");
        }
    }
}

#[test]
fn what_a_user_changes_in_a_world_stays_in_it_until_the_world_is_reset() {
    let template = Template::from(world("motorway_2_lanes.osm", 1));
    let untouched = driven(template.spawn(3, 1).unwrap(), 600);
    let mut changed = template.spawn(3, 1).unwrap();
    let ids: Vec<Id> = changed.network().lanelets.iter().map(|it| it.id).collect();
    let mut closed = ids.into_iter().map(|lanelet| Command::CloseLanelet { lanelet, is_closed: true });
    assert!(closed.any(|it| changed.command(it).is_ok()), "one of them can be closed");
    let style = drivers::aggressive().name;
    let slow = Command::SetParameter { style, parameter: Parameter::SpeedFactor, value: 0.5 };
    changed.command(slow).expect("the style has it");
    (0..600).for_each(|_| changed.step());
    assert_ne!(changed.state_hash(), untouched.0);
    assert!(driven(template.spawn(3, 1).unwrap(), 600) == untouched);
    changed.reset(&template, 3);
    assert!(driven(changed, 600) == untouched);
}
