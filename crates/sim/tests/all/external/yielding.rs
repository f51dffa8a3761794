//! An external vehicle at a junction asks for the right of way as its driver would, and lets others go if it stands.

use laneweave_sim::{Lateral, Longitudinal, VehicleId, World};

use crate::external::lanes::drive;
use crate::external::worlds::world;

/// The vehicle that is next to drive onto a conflict area, from 20 to 40 m away, and is first in its lane.
fn next_to_cross(world: &World) -> Option<VehicleId> {
    let (network, scene) = (world.network(), world.scene());
    let comes = |it: &laneweave_sim::Vehicle| {
        let chain = network.chain(it.spot.chain);
        let to_go = chain.length - it.x();
        let leads_to_zones =
            |next: &laneweave_network::ChainIndex| !network.junctions.on(*next).crossings.is_empty();
        let is_first = it.spot.index + 1 == scene.motions(it.spot.chain).len();
        (20.0..40.0).contains(&to_go) && is_first && chain.following.iter().any(leads_to_zones)
    };
    world.vehicles().find(comes).map(|it| it.id())
}

/// Simulates until there is such a vehicle.
fn first(world: &mut World, find: impl Fn(&World) -> Option<VehicleId>) -> VehicleId {
    let mut steps = (0..6000).map(|_| {
        world.step();
        find(world)
    });
    steps.find_map(|it| it).expect("one comes")
}

#[test]
fn one_that_stands_before_a_junction_lets_all_others_go() {
    for map in ["all_way_stop.osm", "priority.osm", "right_before_left.osm"] {
        let passed = |is_blocked: bool| {
            let mut world = world(map, 600.0, 3, 1);
            (0..1200).for_each(|_| world.step());
            let ego = first(&mut world, next_to_cross);
            if is_blocked {
                drive(&mut world, ego, Longitudinal::Speed(0.0), Lateral::Keep);
            }
            let before = world.counts().left;
            (0..6000).for_each(|_| world.step());
            assert_eq!(world.counters().stuck, 0, "{map}");
            world.counts().left - before
        };
        let [free, blocked] = [false, true].map(passed);
        // Its own arm is closed: no more than half of the traffic comes from there.
        assert!(2 * blocked > free, "{map}: {blocked} of {free} vehicles");
    }
}

#[test]
fn nobody_is_stuck_because_of_one_that_stands_in_a_junction() {
    let mut world = world("all_way_stop.osm", 600.0, 3, 1);
    (0..1200).for_each(|_| world.step());
    let inside = |world: &World| {
        let network = world.network();
        let is_inside = |it: &laneweave_sim::Vehicle| {
            !network.junctions.on(it.spot.chain).crossings.is_empty()
                && network.chain(it.spot.chain).length < 30.0
        };
        world.vehicles().find(is_inside).map(|it| it.id())
    };
    let ego = first(&mut world, inside);
    drive(&mut world, ego, Longitudinal::Speed(0.0), Lateral::Keep);
    (0..6000).for_each(|_| world.step());
    let standing = world.vehicles().filter(|it| it.speed() < 0.1).count();
    assert!(standing > 30 && world.counters().stuck == 0, "{standing}: {}", world.counters().stuck);
}
