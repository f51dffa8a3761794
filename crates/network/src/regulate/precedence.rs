//! Which side has priority in a zone. In this order: signs; the circulating lane of a roundabout; vehicles that do
//! not turn across oncoming traffic; vehicles from the side of the road on which traffic drives (in Germany the
//! right).

use std::f64::consts::PI;

use super::kinship::Kinship;
use crate::chain::ChainIndex;
use crate::junction::{Precedence, Reach, Regulations, StopKind, Touch, Zone};
use crate::lanelet::LaneletIndex;
use crate::network::Network;

/// A lane that leads out of a ring has left it after this length [m] (ours).
const LEAVES_WITHIN: f64 = 15.0;

/// Stop signs that the drivers on a lanelet obey.
#[derive(Clone, Copy, Default, PartialEq, Eq)]
struct Marks {
    stops: bool,
    all_stop: bool,
}

/// Determines which side has priority in each zone.
pub(super) fn settle(
    network: &Network,
    kinship: &Kinship,
    regulations: &Regulations,
    in_ring: &[bool],
    zones: &mut [Zone],
) {
    if zones.is_empty() {
        return;
    }
    let mut marks = vec![Marks::default(); network.lanelets.len()];
    for rule in &regulations.stops {
        for lanelet in &rule.lanelets {
            marks[lanelet.at()].stops |= rule.kind == StopKind::StopSign;
            marks[lanelet.at()].all_stop |= rule.kind == StopKind::AllWayStop;
        }
    }
    let orders = orders(network, regulations);
    // Who leaves it is still in it: where an inner lane is left across the outer one, who comes first goes first.
    let is_in_roundabout = |side: &Reach| {
        let comes_out = || network.chain(side.chain).previous.iter().any(|it| in_ring[it.at()]);
        in_ring[side.chain.at()] || side.start < LEAVES_WITHIN && comes_out()
    };
    for zone in zones.iter_mut() {
        let chains = zone.sides.map(|it| it.chain);
        zone.precedence = by_priority(network, kinship, &orders, chains)
            .or_else(|| by_stop_signs(network, kinship, &marks, chains))
            .or_else(|| first_of(zone.sides.each_ref().map(is_in_roundabout)))
            .unwrap_or_else(|| by_shape(network, zone));
    }
}

/// For each lanelet the rules that give it priority, and those by which it gives way.
fn orders(network: &Network, regulations: &Regulations) -> Vec<[Vec<usize>; 2]> {
    let mut orders = vec![[Vec::new(), Vec::new()]; network.lanelets.len()];
    for (number, rule) in regulations.priorities.iter().enumerate() {
        rule.first.iter().for_each(|it| orders[it.at()][0].push(number));
        rule.yielding.iter().for_each(|it| orders[it.at()][1].push(number));
    }
    orders
}

fn by_priority(
    network: &Network,
    kinship: &Kinship,
    orders: &[[Vec<usize>; 2]],
    chains: [ChainIndex; 2],
) -> Option<Precedence> {
    let rules = |chain: ChainIndex, role: usize| -> Vec<usize> {
        lineage(network, kinship, chain)
            .flat_map(|it: LaneletIndex| orders[it.at()][role].iter().copied())
            .collect()
    };
    let goes_before = |one: ChainIndex, other: ChainIndex| {
        let first = rules(one, 0);
        !first.is_empty() && rules(other, 1).iter().any(|it| first.contains(it))
    };
    first_of([goes_before(chains[0], chains[1]), goes_before(chains[1], chains[0])])
}

fn by_stop_signs(
    network: &Network,
    kinship: &Kinship,
    marks: &[Marks],
    chains: [ChainIndex; 2],
) -> Option<Precedence> {
    let has =
        |chain, mark: fn(&Marks) -> bool| lineage(network, kinship, chain).any(|it| mark(&marks[it.at()]));
    let all_stop = chains.map(|it| has(it, |it| it.all_stop));
    let stops = chains.map(|it| has(it, |it| it.stops));
    match (all_stop, stops) {
        ([true, true], _) | (_, [true, true]) => Some(Precedence::Arrival),
        (_, stops) => first_of(stops.map(|it| !it)),
    }
}

/// The side that has priority, where exactly one of the two has it.
fn first_of(goes_first: [bool; 2]) -> Option<Precedence> {
    match goes_first {
        [true, false] => Some(Precedence::Side(0)),
        [false, true] => Some(Precedence::Side(1)),
        _ => None,
    }
}

/// Distance before a zone at which the direction of a path is taken [m].
const COMES_FROM: f64 = 15.0;
/// Paths whose directions differ by less than the first come from one road, by more than the second from opposite
/// ones [rad].
const ONE_ROAD: f64 = PI / 6.0;
const OPPOSITE: f64 = 0.75 * PI;
/// A vehicle that turns by more than this gives way to oncoming traffic [rad].
pub(super) const TURNS: f64 = PI / 6.0;

fn by_shape(network: &Network, zone: &Zone) -> Precedence {
    let near_sign = network.driving_side.overtaking().sign();
    let from = zone.sides.map(|it| {
        let centre = &network.chain(it.chain).centre;
        centre.heading((it.start - COMES_FROM).max(0.0))
    });
    let turns = [0, 1].map(|side| {
        let reach = &zone.sides[side];
        let chain = network.chain(reach.chain);
        near_sign * turned(from[side], chain.centre.heading((reach.end + COMES_FROM).min(chain.length)))
    });
    let between = near_sign * turned(from[0], from[1]);
    if between.abs() < ONE_ROAD || zone.touch != Touch::Any {
        Precedence::Arrival
    } else if between.abs() > OPPOSITE {
        first_of(turns.map(|it| it < TURNS)).unwrap_or_default()
    } else {
        Precedence::FromTheRight(u8::from(between > 0.0))
    }
}

/// Angle from one direction to another, counter-clockwise, −π…π.
pub(super) fn turned(from: f64, to: f64) -> f64 {
    let angle = (to - from).rem_euclid(2.0 * PI);
    if angle > PI { angle - 2.0 * PI } else { angle }
}

/// The lanelets near a chain whose rules its drivers follow: its own and those that lead to it.
fn lineage<'a>(
    network: &'a Network,
    kinship: &'a Kinship,
    chain: ChainIndex,
) -> impl Iterator<Item = LaneletIndex> + 'a {
    let before = kinship.ancestors(chain).iter().map(|it| it.0);
    std::iter::once(chain).chain(before).flat_map(|it| network.chain(it).lanelets.iter().copied())
}
