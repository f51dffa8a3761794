//! Threads and the order of chains change no bit, also at junctions.

use laneweave_network::Network;
use laneweave_sim::{Setup, World};

use crate::junctions::town::STEP;
use crate::roads::{drivers, network};

/// Hash of the state after two minutes of dense traffic, which is enough to be shared among threads.
fn hash(network: Network, threads: usize) -> u64 {
    let demand = drivers::demand(&network, 16_000.0, 0.1, &[0.3, 0.7]);
    let driver_parameters = vec![drivers::aggressive(), drivers::conservative()];
    let setup = Setup { step: STEP, seed: 1, threads };
    let mut world = World::new(network, driver_parameters, demand, setup).expect("the set-up makes sense");
    (0..1200).for_each(|_| world.step());
    assert!(world.on_road() > 310, "{} on the road", world.on_road());
    assert!(world.counts().left > 0);
    world.state_hash()
}

#[test]
fn v29_a_grid_of_lights_is_the_same_on_any_number_of_threads_and_in_any_order_of_storage() {
    let first = hash(network("grid.osm"), 1);
    assert_eq!(hash(network("grid.osm"), 2), first);
    assert_eq!(hash(network("grid.osm").with_chains_reversed(), 1), first);
}
