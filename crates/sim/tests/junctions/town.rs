//! Traffic on the maps that come with the program.

use laneweave_generate::own_maps;
use laneweave_maps::{Map, regulations};
use laneweave_models::Style;
use laneweave_network::{ChainIndex, Network};
use laneweave_sim::{Class, Placement, Setup, VehicleId, World};

use crate::drivers;

/// Length of a step [s].
pub(crate) const STEP: f64 = 0.1;

/// An arm of a single junction, seen from its centre.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Arm {
    East,
    North,
    West,
    South,
}

impl Arm {
    /// All arms, counter-clockwise.
    pub(crate) const ALL: [Arm; 4] = [Arm::East, Arm::North, Arm::West, Arm::South];

    /// The arm that follows counter-clockwise after so many quarter turns.
    pub(crate) fn turned(self, quarters: usize) -> Arm {
        Arm::ALL[(self as usize + quarters) % 4]
    }

    /// The arm to which the end of the map at (`x`, `y`) belongs.
    fn at(x: f64, y: f64) -> Arm {
        match (x.abs() > y.abs(), x + y > 0.0) {
            (true, true) => Arm::East,
            (false, true) => Arm::North,
            (true, false) => Arm::West,
            (false, false) => Arm::South,
        }
    }
}

/// The network of a map in the folder `maps`, with its junctions.
pub(crate) fn network(name: &str) -> Network {
    let maps = own_maps().expect("they can be drawn");
    let (_, drawing) = maps.into_iter().find(|it| it.0 == name).expect("there is one of this name");
    let map = drawing.build().expect("the drawing is sound");
    let regulations = regulations(&map);
    let Map { network, .. } = map;
    network.regulated(&regulations)
}

/// An empty world without demand.
pub(crate) fn empty(network: Network, driver_parameters: Vec<Style>) -> World {
    let demand = drivers::demand(&network, 0.0, 0.0, &[1.0]);
    let setup = Setup { step: STEP, seed: 1, threads: 1 };
    World::new(network, driver_parameters, demand, setup).expect("the set-up makes sense")
}

/// The lane that leads from an arm to the only junction.
pub(crate) fn lane_from(network: &Network, arm: Arm) -> ChainIndex {
    let lanes = network.entrances.iter().flat_map(|it| it.chains.iter().copied());
    let mut from_there = lanes.filter(|it| {
        let start = network.chain(*it).centre.at(0.0);
        Arm::at(start.x, start.y) == arm
    });
    from_there.next().expect("a lane comes from there")
}

/// The lane that leads from the only junction to an arm.
pub(crate) fn lane_to(network: &Network, arm: Arm) -> ChainIndex {
    network.exits[usize::from(exit_to(network, arm))].chains[0]
}

/// The destination beyond an arm.
pub(crate) fn exit_to(network: &Network, arm: Arm) -> u16 {
    let leads_there = |lane: &ChainIndex| {
        let chain = network.chain(*lane);
        let end = chain.centre.at(chain.length);
        Arm::at(end.x, end.y) == arm
    };
    network.exits.iter().position(|it| it.chains.iter().any(leads_there)).expect("a lane leads there") as u16
}

/// A vehicle that comes from an arm.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Comer {
    pub(crate) from: Arm,
    pub(crate) to: Arm,
    /// Distance from its front to the end of the lane [m].
    pub(crate) distance: f64,
    pub(crate) speed: f64,
    pub(crate) parameters: u32,
}

/// Places the vehicle on the road.
pub(crate) fn put(world: &mut World, comer: Comer) -> VehicleId {
    let network = world.network();
    let chain = lane_from(network, comer.from);
    let x = network.chain(chain).length - comer.distance;
    let destination = Some(exit_to(network, comer.to));
    let Comer { speed, parameters, .. } = comer;
    world
        .place(Placement { chain, x, speed, class: Class::Car, parameters, destination })
        .expect("it fits on the road")
}

/// Steps until `is_over` holds, for `longest` [s] at most. Returns the time that it took [s].
pub(crate) fn run_until(
    world: &mut World,
    longest: f64,
    mut is_over: impl FnMut(&World) -> bool,
) -> Option<f64> {
    let steps = (longest / STEP).round() as u32;
    (1..=steps)
        .find(|_| {
            world.step();
            is_over(world)
        })
        .map(|steps| f64::from(steps) * STEP)
}

/// Whether a vehicle has left the lane on which it came.
pub(crate) fn has_gone(world: &World, id: VehicleId, lane: ChainIndex) -> bool {
    world.vehicles().all(|it| it.id() != id || it.spot.chain != lane)
}

/// Asserts that there were no collisions or overlaps, and that no vehicle is stuck.
pub(crate) fn assert_sound(world: &World) {
    let counters = world.counters();
    assert_eq!((counters.collisions, counters.overlaps, counters.stuck), (0, 0, 0));
}
