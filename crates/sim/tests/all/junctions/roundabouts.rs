//! Roundabouts of one and two lanes: who drives on which lane, and that nobody waits for ever.

use std::f64::consts::{FRAC_PI_6, TAU};

use laneweave_generate::{Roundabout, roundabout};
use laneweave_network::{ChainIndex, Network};
use laneweave_sim::{PerimeterControl, Rate, Setup, World};
use laneweave_test_data::size;

use crate::junctions::town::{STEP, assert_sound};
use crate::roads::{drivers, regulated};

fn ring(wanted: &Roundabout) -> Network {
    regulated(roundabout(wanted).expect("it can be drawn").build().expect("the drawing is sound")).0
}

/// The number of the arm, counter-clockwise from the east, at which a chain begins or ends far from the middle.
fn arm(network: &Network, chain: ChainIndex, arms: usize) -> usize {
    let centre = &network.chain(chain).centre;
    let [begin, end] = [0.0, centre.length()].map(|it| centre.at(it));
    let far = if begin.x.hypot(begin.y) > end.x.hypot(end.y) { begin } else { end };
    let angle = far.y.atan2(far.x) + FRAC_PI_6;
    (angle.rem_euclid(TAU) / TAU * arms as f64) as usize
}

/// Traffic around a roundabout: vehicles per hour from each arm to each other one.
fn traffic(wanted: &Roundabout, trucks: f64, seed: u64, flow: impl Fn(usize, usize) -> f64) -> World {
    let network = ring(wanted);
    let arm_of = |chains: &[ChainIndex]| arm(&network, chains[0], wanted.arms);
    let mut demand = drivers::demand(&network, 1.0, trucks, &[0.12, 0.88]);
    let exits: Vec<usize> = demand.destinations.iter().map(|it| arm_of(it.chains())).collect();
    for origin in &mut demand.origins {
        let from = arm_of(origin.place.chains());
        origin.weights = exits.iter().map(|to| flow(from, *to)).collect();
        origin.rate = Rate::constant(origin.weights.iter().sum());
    }
    let driver_parameters = vec![drivers::aggressive(), drivers::conservative()];
    World::new(network, driver_parameters, demand, Setup { step: STEP, seed, threads: 1 })
        .expect("the set-up makes sense")
}

#[test]
fn drivers_choose_the_lane_of_a_roundabout_by_their_exit() {
    let wanted = Roundabout { lanes: 2, ..Roundabout::default() };
    // Onto the ring on the right lane, of those who leave at the first exit, and at the last one.
    for (to, is_right) in [(0, true), (2, false)] {
        let mut world = traffic(&wanted, 0.0, 1, |from, it| if (from, it) == (3, to) { 300.0 } else { 0.0 });
        let mut entries = [0; 2];
        let mut known = std::collections::BTreeSet::new();
        for _ in 0..12_000 {
            world.step();
            let network = world.network();
            let on_ring = world.vehicles().filter(|it| network.junctions.is_in_roundabout(it.spot.chain));
            for vehicle in on_ring.filter(|it| known.insert(it.id())) {
                let chain = network.chain(vehicle.spot.chain);
                let at = chain.centre.at(vehicle.x());
                entries[usize::from(at.x.hypot(at.y) > 23.0)] += 1;
            }
        }
        let [inner, outer] = entries;
        let chosen = if is_right { outer } else { inner };
        assert!(chosen > 80 && chosen * 10 >= 9 * (inner + outer), "{inner} inside, {outer} outside");
    }
}

#[test]
fn around_rings_at_their_capacity_everybody_moves() {
    for seed in 0..size().pick(6, 24) {
        let dice = |number: u64, choices: u64| ((seed * 7 + number * 5 + seed * number) % choices) as usize;
        let wanted = Roundabout { arms: 3 + dice(0, 4), lanes: 1 + dice(1, 2), ..Roundabout::default() };
        // As many as an arm can take with an even flow around.
        let an_arm = [520.0, 850.0][wanted.lanes - 1] * 4.0 / wanted.arms as f64;
        let weight = |from: usize, to: usize| {
            if from == to { 0.0 } else { 1.0 + dice((from + 7 * to) as u64, 3) as f64 }
        };
        let total = |from: usize| (0..wanted.arms).map(|to| weight(from, to)).sum::<f64>();
        let mut world =
            traffic(&wanted, 0.2, seed, |from, to| an_arm * weight(from, to) / total(from)).audited();
        (0..600 * size().pick(20, 60)).for_each(|_| world.step());
        assert_sound(&world);
        assert!(world.counts().left > 300, "{wanted:?}: {} left", world.counts().left);
    }
}

#[test]
fn a_roundabout_is_no_town() {
    let large = Roundabout { arms: 6, lanes: 2, radius_m: Some(60.0), ..Roundabout::default() };
    assert!(PerimeterControl::new(&ring(&large)).is_none());
}
