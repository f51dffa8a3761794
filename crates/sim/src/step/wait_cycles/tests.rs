use std::sync::Arc;

use laneweave_generate::own_maps;
use laneweave_maps::regulations;
use laneweave_network::{Touch, Zone, ZoneIndex, ZoneKind};

use super::*;
use crate::demand::{Demand, Share};
use crate::junction::reservations::Holder;
use crate::state::lane::VehicleId;
use crate::state::setup::{Placement, Setup};
use crate::state::some_style::some_style;
use crate::state::vehicle::Class;
use crate::step::world::World;

#[test]
fn rings_are_found_wherever_one_begins_to_look() {
    // 0 → 1 → 2 → 1, 3 → 4 → 3, 5 → none, 6 → itself.
    let next = [Some(1), Some(2), Some(1), Some(4), Some(3), None, Some(6)];
    assert_eq!(wait_cycles(&next), [vec![1, 2], vec![3, 4], vec![6]]);
    assert_eq!(wait_cycles(&[None, None]), Vec::<Vec<usize>>::new());
}

/// A vehicle comes from an entrance to an exit, `distance` before the end of its lane [m].
fn put(world: &mut World, [from, to]: [usize; 2], distance: f64) -> VehicleId {
    let network = world.network();
    let chain = network.entrances[from].chains[0];
    let x = network.chain(chain).length - distance;
    let destination = Some(to as u16);
    let place = Placement { chain, x, speed: 8.0, class: Class::Car, parameters: 0, destination };
    world.place(place).unwrap()
}

/// How often the second of two vehicles gets a reservation of a crossing that the first one has not left, from all
/// entrances to all exits. The first may lack storage space.
fn counts_on(lacks_space: bool) -> u32 {
    let (_, drawing) = own_maps().unwrap().into_iter().find(|it| it.0 == "right_before_left.osm").unwrap();
    let map = drawing.build().unwrap();
    let rules = regulations(&map);
    let network = Arc::new(map.network.regulated(&rules));
    let ways = |from: usize| (0..network.exits.len()).map(move |to| [from, to]);
    let pairs =
        ways(0).flat_map(|one| (1..network.entrances.len()).flat_map(ways).map(move |two| [one, two]));
    let mut count = 0;
    for [one, two] in pairs {
        let population = vec![Share { weight: 1.0, first: 0, count: 1 }];
        let nobody = Demand::even(&network, 0.0, 0.0, population);
        let setup = Setup { step: 0.1, seed: 1, threads: 1 };
        let mut world = World::new(network.clone(), vec![some_style()], nobody, setup).unwrap();
        let first = put(&mut world, one, 25.0);
        let mut second = None;
        let mut was_first_alone = vec![false; network.junctions.zones.len()];
        for step in 0..100 {
            if step == 15 {
                second = Some(put(&mut world, two, 35.0));
            }
            world.step();
            for (zone, was_alone) in (0..).map(ZoneIndex).zip(&mut was_first_alone) {
                let reservations = world.junctions.reservations_mut();
                let order: Vec<(Holder, VehicleId)> =
                    reservations.order(zone).map(|(holder, it)| (*holder, it.vehicle)).collect();
                let Zone { kind, touch, .. } = network.junctions.zones[zone.at()];
                if let [(one, _), (other, id)] = order[..] {
                    let cross = kind == ZoneKind::Crossing && touch == Touch::Any && one.side != other.side;
                    count += u32::from(cross && *was_alone && Some(id) == second);
                }
                *was_alone = matches!(order[..], [(_, id)] if id == first);
                if *was_alone && lacks_space {
                    reservations.goes_in_wait_cycle(order[0].0.slot);
                }
            }
        }
    }
    count
}

#[test]
fn nobody_counts_on_a_vehicle_that_lacks_space_to_leave_a_crossing() {
    assert!(counts_on(false) > 0);
    assert_eq!(counts_on(true), 0);
}
