//! Storage space beyond a junction: no vehicle blocks others, and drivers who wait for each other's space go
//! together.

use std::collections::HashMap;
use std::f64::consts::FRAC_PI_2;

use laneweave_models::Style;
use laneweave_models::follow::{FollowingModel, Idm};
use laneweave_network::{ChainIndex, Network, Touch};
use laneweave_sim::{Class, Placement, VehicleId, World};

use crate::junctions::town::{
    Arm, Comer, assert_sound, empty, exit_to, has_gone, lane_from, lane_to, put, run_until,
};
use crate::roads::{drivers, network};

/// A driver who hardly moves in an hour.
fn immobile() -> Style {
    let idm = Idm { acceleration: 1e-9, ..Idm::default() };
    Style { follow: FollowingModel::Idm(idm), ..drivers::conservative() }
}

/// Whether part of a vehicle stands where lanes cross or merge: on its chain, or on the one before.
fn is_in_the_way(
    network: &Network,
    chain: ChainIndex,
    x: f64,
    length: f64,
    before: Option<ChainIndex>,
) -> bool {
    let stands_in = |chain: ChainIndex, x: f64| {
        let junctions = &network.junctions;
        junctions.on(chain).crossings.iter().any(|crossing| {
            let reach = junctions.reach(*crossing);
            let is_tight = junctions.zones[crossing.zone.at()].touch != Touch::Any;
            !is_tight && x > reach.start && x - length < reach.end.min(network.chain(chain).length)
        })
    };
    stands_in(chain, x) || before.is_some_and(|it| stands_in(it, network.chain(it).length + x))
}

#[test]
fn nobody_stands_within_a_junction_whose_exit_is_full() {
    for name in ["priority.osm", "right_before_left.osm", "all_way_stop.osm"] {
        let mut world = empty(network(name), vec![drivers::conservative(), immobile()]);
        let chain = lane_to(world.network(), Arm::North);
        let destination = Some(exit_to(world.network(), Arm::North));
        // The blocker leaves space for one car.
        let blocker = Placement { chain, x: 14.0, speed: 0.0, class: Class::Car, parameters: 1, destination };
        world.place(blocker).expect("it fits on the road");
        for from in [Arm::East, Arm::West, Arm::South] {
            for place in 0..4 {
                let to = if place % 2 == 0 { Arm::North } else { from.turned(2) };
                let distance = 15.0 + 15.0 * f64::from(place);
                put(&mut world, Comer { from, to, distance, speed: 5.0, parameters: 0 });
            }
        }
        let mut ways: HashMap<VehicleId, [Option<ChainIndex>; 2]> = HashMap::new();
        let mut standing: HashMap<VehicleId, u32> = HashMap::new();
        run_until(&mut world, 120.0, |world| {
            for vehicle in world.vehicles() {
                let (id, chain) = (vehicle.id(), vehicle.spot.chain);
                let way = ways.entry(id).or_insert([None, Some(chain)]);
                if way[1] != Some(chain) {
                    *way = [way[1], Some(chain)];
                }
                let length = f64::from(vehicle.motion.length);
                let stands = vehicle.speed() < 0.05
                    && is_in_the_way(world.network(), chain, vehicle.x(), length, way[0]);
                let steps = standing.entry(id).or_default();
                *steps = if stands { *steps + 1 } else { 0 };
                // A short stop that lets another go first does not count.
                assert!(*steps < 50, "{name}: {id} stands at {:.1} m of {chain:?}", vehicle.x());
            }
            false
        });
        // Vehicles behind the first one to the north wait with it.
        let waiting = world.vehicles().filter(|it| it.speed() < 0.05 && it.driver.parameters == 0).count();
        assert!(waiting >= 3, "{name}: {waiting} wait");
        assert_sound(&world);
    }
}

/// The lanes of the roundabout, from one without a zone on.
fn ring(network: &Network) -> Vec<ChainIndex> {
    let is_in_ring = |first: ChainIndex| {
        let (mut open, mut seen) = (vec![first], Vec::new());
        while let Some(here) = open.pop() {
            for next in &network.chain(here).following {
                if *next == first {
                    return true;
                }
                if !seen.contains(next) {
                    seen.push(*next);
                    open.push(*next);
                }
            }
        }
        false
    };
    let all = (0..network.chains.len() as u32).map(ChainIndex);
    let has_no_zone = |it: &ChainIndex| network.junctions.on(*it).crossings.is_empty();
    let first = all.clone().find(|it| is_in_ring(*it) && has_no_zone(it)).expect("there is a ring");
    let mut ring = vec![first];
    while let Some(next) =
        network.chain(ring[ring.len() - 1]).following.iter().find(|it| is_in_ring(**it) && **it != first)
    {
        ring.push(*next);
    }
    ring
}

/// Places in the roundabout in which cars of `length` [m] block nobody.
fn free_places(network: &Network, ring: &[ChainIndex], length: f64) -> Vec<(ChainIndex, f64)> {
    /// Distance between cars at rest, and before a zone [m].
    const GAP: f64 = 2.2;
    let mut places = Vec::new();
    // The roundabout has two chains from one zone to the next.
    for pair in ring.chunks(2) {
        let [before, at_zone] = pair else { continue };
        let zone = network.junctions.on(*at_zone).crossings[0];
        let (from, start) = (network.chain(*before).length, network.junctions.reach(zone).start);
        let mut front = start - GAP;
        while from + front - length > 0.0 {
            places.push(if front > 0.0 { (*at_zone, front) } else { (*before, from + front) });
            front -= length + GAP;
        }
    }
    places
}

#[test]
fn a_full_ring_turns() {
    let mut world = empty(network("roundabout.osm"), vec![drivers::conservative()]);
    let lanes = ring(world.network());
    let places = free_places(world.network(), &lanes, Class::Car.body().length);
    assert_eq!(places.len(), 8);
    for (chain, x) in places {
        // All vehicles want to leave at the exit that they have just passed.
        let at = world.network().chain(chain).centre.at(x);
        let quarter = at.y.atan2(at.x).div_euclid(FRAC_PI_2).rem_euclid(4.0) as usize;
        let destination = Some(exit_to(world.network(), Arm::ALL[quarter]));
        world
            .place(Placement { chain, x, speed: 0.0, class: Class::Car, parameters: 0, destination })
            .expect("it fits on the road");
    }
    let time = run_until(&mut world, 90.0, |world| world.on_road() == 0);
    assert!(time.is_some(), "{} are still there", world.on_road());
    assert_sound(&world);
}

#[test]
fn who_stands_behind_another_who_came_before_it_does_not_keep_a_junction_from_others() {
    let mut world = empty(network("priority.osm"), vec![drivers::conservative(), immobile()]);
    // It has its reservation, far from the junction, before another vehicle stops in front of it.
    let comer =
        |from: Arm, distance, speed| Comer { from, to: from.turned(2), distance, speed, parameters: 0 };
    put(&mut world, comer(Arm::East, 60.0, 12.0));
    let has_passed_on = |world: &World, id, from| has_gone(world, id, lane_from(world.network(), from));
    run_until(&mut world, 0.5, |_| false);
    put(&mut world, Comer { parameters: 1, ..comer(Arm::East, 20.0, 0.0) });
    run_until(&mut world, 15.0, |_| false);
    let crossing = put(&mut world, comer(Arm::North, 60.0, 10.0));
    assert!(run_until(&mut world, 60.0, |world| has_passed_on(world, crossing, Arm::North)).is_some());
    assert_sound(&world);
}
