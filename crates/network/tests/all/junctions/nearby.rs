//! Where vehicles on different chains may touch: the list for the search for overlaps.

use laneweave_network::{ChainIndex, DrivingSide, Junctions, Nearby, Regulations};

use crate::junctions::drawn::{Lanes, WIDTH, crossing, straight};

fn junctions(lanes: &Lanes) -> Junctions {
    lanes.network(DrivingSide::Right).regulated(&Regulations::default()).junctions
}

/// All that is near, on any of so many chains.
fn all(junctions: &Junctions, chains: u32) -> Vec<(u32, Nearby)> {
    let on = |chain: u32| junctions.nearby(ChainIndex(chain)).iter().map(move |it| (chain, *it));
    (0..chains).flat_map(on).collect()
}

#[test]
fn chains_that_cross_are_near_each_other_from_the_place_to_a_vehicles_length_beyond_it() {
    let found = all(&junctions(&crossing(0.0)), 2);
    // Each pair of chains is listed once.
    assert!(
        !found.is_empty() && found.iter().all(|(here, it)| (*here, it.chain) == (0, ChainIndex(1))),
        "{found:?}"
    );
    let covers = |front: [f64; 2]| {
        let holds = |[from, to]: [f64; 2], front: f64| (from..=to).contains(&front);
        found.iter().any(|(_, it)| holds(it.here, front[0]) && holds(it.there, front[1]))
    };
    // Paths cross after 100 m. Three cases: the bumper is in front of the crossing, in the middle of it, or the rear
    // of the longest vehicle, 12 m long, is in it.
    for here in [98.0, 100.0, 104.0, 112.0] {
        for there in [98.0, 100.0, 104.0, 112.0] {
            assert!(covers([here, there]), "{here}, {there}: {found:?}");
        }
    }
    assert!(!covers([90.0, 100.0]) && !covers([100.0, 120.0]), "{found:?}");
}

#[test]
fn a_front_beyond_the_end_of_a_chain_is_looked_for_on_the_chain_that_follows() {
    // The chain that crosses is crossed 2 m before its end: then its vehicles have their fronts on the next chain.
    let lanes = Lanes::default()
        .with(straight((-100.0, 0.0), (100.0, 0.0)), &[])
        .with(straight((0.0, -100.0), (0.0, 2.0)), &[2, 3])
        .with(straight((0.0, 2.0), (0.0, 100.0)), &[])
        .with(straight((0.0, 2.0), (-30.0, 100.0)), &[]);
    let found = all(&junctions(&lanes), 4);
    let is_named = |one: u32, front: f64, other: u32, beyond: f64| {
        let holds = |[from, to]: [f64; 2], front: f64| (from..=to).contains(&front);
        found.iter().any(|(here, it)| {
            *here == one && it.chain == ChainIndex(other) && holds(it.here, front) && holds(it.there, beyond)
        })
    };
    assert!(is_named(0, 100.0, 1, 100.0), "{found:?}");
    assert!([2, 3].iter().all(|next| is_named(0, 100.0, *next, 5.0)), "{found:?}");
}

#[test]
fn chains_on_bridges_and_on_roads_apart_are_not_near_and_lanes_of_one_road_are_if_vehicles_could_lean_over() {
    assert_eq!(all(&junctions(&crossing(6.0)), 2), []);
    let side_by_side = |apart: f64| {
        Lanes::default()
            .with(straight((0.0, 0.0), (100.0, 0.0)), &[])
            .with(straight((0.0, apart), (100.0, apart)), &[])
    };
    assert_eq!(all(&junctions(&side_by_side(WIDTH)), 2), []);
    let close = all(&junctions(&side_by_side(2.6)), 2);
    // In pieces of 20 m, so that the whole of one lane is not compared with the whole of the other.
    assert!(close.len() >= 5 && close.iter().all(|(_, it)| it.there[1] - it.there[0] < 45.0), "{close:?}");
}
