//! Drivers who are guided by measured travel times.

use laneweave_generate::{Motorway, motorway};
use laneweave_network::Network;
use laneweave_sim::{Setup, World};

use crate::junctions::town::STEP;
use crate::roads::{drivers, network};

const INTERVAL: f64 = 30.0;

/// A world with dense traffic, guided or not.
fn world(network: Network, threads: usize, is_guided: bool) -> World {
    let demand = drivers::demand(&network, 16_000.0, 0.1, &[0.3, 0.7]);
    let driver_parameters = vec![drivers::aggressive(), drivers::conservative()];
    let setup = Setup { step: STEP, seed: 1, threads };
    let world = World::new(network, driver_parameters, demand, setup).expect("the set-up makes sense");
    if is_guided { world.guided(INTERVAL).expect("few destinations") } else { world }
}

fn driven(mut world: World, seconds: f64) -> World {
    (0..(seconds / STEP) as u32).for_each(|_| world.step());
    world
}

#[test]
fn v29_guided_drivers_are_the_same_on_any_number_of_threads_and_in_any_order_of_storage() {
    let first = driven(world(network("grid.osm"), 1, true), 180.0);
    assert!(first.counters().route_changes > 20, "{} route changes", first.counters().route_changes);
    let hash = first.state_hash();
    assert_eq!(driven(world(network("grid.osm"), 2, true), 180.0).state_hash(), hash);
    assert_eq!(driven(world(network("grid.osm").with_chains_reversed(), 1, true), 180.0).state_hash(), hash);
    assert_ne!(driven(world(network("grid.osm"), 1, false), 180.0).state_hash(), hash);
}

#[test]
fn who_leaves_its_route_touches_nobody_and_arrives_where_it_wanted() {
    for name in ["grid.osm", "town.osm", "approach.osm"] {
        let world = driven(world(network(name), 1, true), 600.0);
        let (counters, counts) = (world.counters(), world.counts());
        assert_eq!((counters.collisions, counters.overlaps), (0, 0), "{name}");
        assert!(counts.left > 100, "{name}: {} left", counts.left);
    }
}

#[test]
fn guidance_changes_nothing_where_there_is_one_way() {
    let road = Motorway {
        length_m: 3000.0,
        on_ramp_at: vec![1000.0],
        off_ramp_at: vec![2200.0],
        ..Motorway::default()
    };
    let network = || motorway(&road).expect("a road").build().expect("a network").network;
    let [guided, free] = [true, false].map(|it| driven(world(network(), 1, it), 200.0));
    assert!(guided.counts().route_changes > 0 && guided.state_hash() == free.state_hash());
    assert_eq!(guided.counters().route_changes, 0);
}
