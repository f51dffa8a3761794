//! Traffic below the capacity of a junction flows.

use laneweave_sim::{Setup, World};

use crate::junctions::town::{STEP, assert_sound};
use crate::roads::{drivers, network};

#[test]
fn at_a_junction_that_is_not_too_busy_everybody_gets_through() {
    const MINUTES: u32 = 15;
    let demands = [
        ("priority.osm", 1000.0),
        ("right_before_left.osm", 1000.0),
        ("all_way_stop.osm", 1000.0),
        ("roundabout.osm", 800.0),
    ];
    for ((name, total), seed) in demands.into_iter().zip(1..) {
        let network = network(name);
        let demand = drivers::demand(&network, total, 0.1, &[0.3, 0.7]);
        let driver_parameters = vec![drivers::aggressive(), drivers::conservative()];
        let setup = Setup { step: STEP, seed, threads: 1 };
        let mut world =
            World::new(network, driver_parameters, demand, setup).expect("the set-up makes sense");
        (0..MINUTES * 600).for_each(|_| world.step());
        assert_sound(&world);
        assert!(world.on_road() < 30 && world.waiting() == 0, "{name}: {} on the road", world.on_road());
        assert!(world.counts().left as f64 > 0.7 * total / 4.0, "{name}: {} left", world.counts().left);
    }
}

/// A map with a demand of 4000 veh/h.
fn crowded(name: &str) -> World {
    let network = network(name);
    let demand = drivers::demand(&network, 4000.0, 0.1, &[0.3, 0.7]);
    let driver_parameters = vec![drivers::aggressive(), drivers::conservative()];
    let setup = Setup { step: STEP, seed: 1, threads: 1 };
    World::new(network, driver_parameters, demand, setup).expect("the set-up makes sense")
}

#[test]
fn a_roundabout_to_which_far_more_come_than_it_can_take_keeps_turning() {
    const MINUTES: u32 = 15;
    let mut world = crowded("roundabout.osm");
    (0..MINUTES * 600).for_each(|_| world.step());
    assert_sound(&world);
    assert!(world.counts().left > 300, "{} left", world.counts().left);
}

#[test]
fn a_junction_without_lights_to_which_far_more_come_than_it_can_take_lets_many_through() {
    for (name, least) in [("right_before_left.osm", 1200), ("all_way_stop.osm", 1350)] {
        let mut world = crowded(name);
        (0..10 * 600).for_each(|_| world.step());
        let before = world.counts().left;
        (0..15 * 600).for_each(|_| world.step());
        assert_sound(&world);
        let an_hour = 4 * (world.counts().left - before);
        assert!(an_hour > least, "{name}: {an_hour} an hour");
    }
}

#[test]
fn a_full_town_keeps_moving_and_its_queue_stands_at_its_edge() {
    const QUARTERS: u32 = 3;
    let mut world = crowded("town.osm");
    let mut left = 0;
    for quarter in 0..QUARTERS {
        (0..15 * 600).for_each(|_| world.step());
        assert_sound(&world);
        let leaves = world.counts().left - left;
        assert!(leaves > 300, "{leaves} left in quarter {quarter}");
        left += leaves;
    }
    assert!(world.waiting() > world.on_road(), "{} wait, {} drive", world.waiting(), world.on_road());
}
