//! Something stands in a lane, and who goes round it could not get back to its way: it takes another.

use laneweave_generate::{Arterial, arterial};
use laneweave_network::{Chain, ChainIndex, LaneletIndex, Network, Position};
use laneweave_sim::{InnerPlace, Place, Setup, World};

use crate::external::worlds::styles;
use crate::roads::{Road, drivers, regulated};

/// A quarter of an hour on `network`, with `inside` as one more destination, and an obstacle of the size of a car with
/// its far end at each of these places.
///
/// # Panics
/// If vehicles collide, or are stuck.
fn drive(network: Network, flow: f64, inside: Option<Place>, obstacles: &[Position]) -> World {
    let mut demand = drivers::demand(&network, flow, 0.1, &[0.3, 0.7]);
    if let Some(place) = inside {
        demand.destinations.push(place);
        demand.origins.iter_mut().for_each(|it| it.weights = vec![1.0, 1.0]);
    }
    let setup = Setup { step: 0.1, seed: 1, threads: 1 };
    let mut world = World::new(network, styles(), demand, setup).expect("the set-up makes sense").audited();
    for (it, number) in obstacles.iter().zip(0..) {
        let (lanelet, x) = world.network().lanelet_at(*it);
        let ground = world.obstacle_in_lane(lanelet.id, x, [4.5, 1.8]).expect("it is possible");
        world.put_obstacle(number, &ground).expect("its place is free");
    }
    (0..9000).for_each(|_| world.step());
    let counters = world.counters();
    let bad = [counters.collisions, counters.overlaps, counters.stuck, counters.lost];
    assert_eq!(bad, [0; 4], "with obstacles at {obstacles:?}");
    world
}

#[test]
fn who_cannot_reach_its_trip_end_behind_an_obstacle_takes_another() {
    for before_end in [5.0, 30.0, 100.0] {
        let network = Road { lanes: 2, limit: 50.0 / 3.6, ..Road::default() }.network();
        let Position { chain, x } = network.start_of(LaneletIndex(2));
        let end = Place::Inside(InnerPlace { id: 3.into(), chain, station: x + 300.0 });
        let world = drive(network, 500.0, Some(end), &[Position::new(chain, x + 300.0 - before_end)]);
        let left = world.counts().left;
        assert!(left > 90, "{left} with an obstacle {before_end} m before");
    }
}

/// Lanes before junctions that may not be left any more shortly before them.
fn approaches(network: &Network) -> Vec<(ChainIndex, &Chain)> {
    let is_solid = |it: &Chain| {
        let ends = it.left.iter().chain(&it.right).map(|it| it.end);
        ends.reduce(f64::max).is_some_and(|end| end < it.length - 20.0)
    };
    let chains = (0..).map(ChainIndex).zip(&network.chains);
    chains.filter(|(_, it)| it.following.len() > 1 && is_solid(it)).collect()
}

#[test]
fn an_obstacle_shortly_before_a_junction_is_passed_where_lanes_may_still_be_changed() {
    let plan = Arterial { junctions: 2, ..Arterial::default() };
    let map = arterial(&plan).expect("it can be made").build().expect("the drawing is sound");
    let network = regulated(map).0;
    let free = drive(network.clone(), 1200.0, None, &[]).counts().left;
    let lanes = approaches(&network);
    assert!(lanes.len() >= 4, "{}", lanes.len());
    for (chain, lane) in lanes {
        let place = Position::new(chain, lane.length - 8.0);
        let left = drive(network.clone(), 1200.0, None, &[place]).counts().left;
        assert!(left as f64 > 0.9 * free as f64, "{left} of {free} with an obstacle at {place:?}");
    }
}
