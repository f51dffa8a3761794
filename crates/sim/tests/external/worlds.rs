//! Worlds for these tests.

use laneweave_generate::own_maps;
use laneweave_maps::{Map, regulations};
use laneweave_models::{Attention, Style};
use laneweave_network::Network;
use laneweave_sim::{Setup, World};

use crate::drivers;

/// The network of a map of our own, with its junctions.
pub(crate) fn network(name: &str) -> Network {
    let maps = own_maps().expect("they can be drawn");
    let (_, drawing) = maps.into_iter().find(|it| it.0 == name).expect("there is one of this name");
    let map = drawing.build().expect("the drawing is sound");
    let regulations = regulations(&map);
    let Map { network, .. } = map;
    network.regulated(&regulations)
}

/// An aggressive style, and a conservative style that is inattentive at times.
pub(crate) fn styles() -> Vec<Style> {
    let attention = Attention { concentrated_for: 20.0, inattentive_for: 20.0, ..Attention::default() };
    vec![drivers::aggressive(), Style { attention, ..drivers::conservative() }]
}

/// A world on a map of our own with a demand [veh/h].
pub(crate) fn world(map: &str, demand: f64, seed: u64, threads: usize) -> World {
    let network = network(map);
    let demand = drivers::demand(&network, demand, 0.1, &[0.3, 0.7]);
    World::new(network, styles(), demand, Setup { step: 0.1, seed, threads }).expect("the set-up makes sense")
}
