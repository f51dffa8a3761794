//! In free traffic, drivers in a wrong lane reach a right one.

use std::collections::HashMap;

use laneweave::network::ChainIndex;
use laneweave::study::poisson_interval;
use laneweave::style::Population;
use laneweave_sim::{Class, Demand, Event, Placement, Setup, World};

use crate::approach::roads::Approach;

const STEP_S: f64 = 0.1;
const SEEDS: u64 = 10;
const SECONDS: u32 = 300;
/// Seconds between two drivers in a wrong lane.
const HEADWAY: u32 = 6;
/// Free traffic beside them [veh/h].
const BESIDE: f64 = 600.0;

/// Number of drivers who entered in a wrong lane and completed their trips, and the number of them who left
/// elsewhere. The wrong lane is A for the straight road's own exit, or C for the left road's.
fn missed(seed: u64) -> (u64, u64) {
    let Approach { network, lanes: [a, _, c], exits: [north, south, _] } = Approach::drawn();
    let Population { driver_parameters, shares } = Population::usual(seed).expect("built-in styles");
    let drivers = driver_parameters.len() as u32;
    let demand = Demand::even(&network, BESIDE, 0.1, shares);
    let gates: Vec<Vec<ChainIndex>> = network.exits.iter().map(|it| it.chains.clone()).collect();
    let setup = Setup { step: STEP_S, seed, threads: 1 };
    let mut world = World::new(network, driver_parameters, demand, setup).expect("a world");
    let mut come = HashMap::new();
    let (mut left, mut elsewhere) = (0, 0);
    for step in 0..SECONDS * 10 {
        let number = step / (10 * HEADWAY);
        if step % (10 * HEADWAY) == 0 {
            let (chain, exit) = if number.is_multiple_of(2) { (a, south) } else { (c, north) };
            let is_free = world.scene().motions(chain).first().is_none_or(|it| it.rear() > 40.0);
            if is_free {
                let parameters = (number * 7919 + seed as u32) % drivers;
                let (class, destination) = (Class::Car, Some(exit));
                let id = world
                    .place(Placement { chain, x: 5.0, speed: 12.0, class, parameters, destination })
                    .expect("it fits on the road");
                come.insert(id, (exit, chain));
            }
        }
        world.step();
        for it in world.vehicles() {
            come.entry(it.id()).and_modify(|(_, at)| *at = it.spot.chain);
        }
        for event in world.events() {
            let Event::Left { vehicle, .. } = event else { continue };
            let Some((exit, at)) = come.remove(vehicle) else { continue };
            left += 1;
            elsewhere += u64::from(!gates[usize::from(exit)].contains(&at));
        }
    }
    let counters = world.counters();
    assert_eq!((counters.collisions, world.counters().overlaps, counters.stuck), (0, 0, 0));
    (left, elsewhere)
}

#[test]
fn drivers_in_a_wrong_lane_reach_theirs_in_98_of_100_cases_in_free_traffic() {
    let counts: Vec<(u64, u64)> = (1..=SEEDS).map(missed).collect();
    let left: u64 = counts.iter().map(|it| it.0).sum();
    let elsewhere: u64 = counts.iter().map(|it| it.1).sum();
    let most = poisson_interval(elsewhere).upper / left as f64;
    eprintln!("{elsewhere} of {left} drivers in a wrong lane missed their turn, at most {most:.4}");
    assert!(left >= 300, "{left} drivers are too few");
    assert!(most <= 0.02, "{most}");
}
