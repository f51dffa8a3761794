//! The loads of junctions without lights.

use std::collections::BTreeMap;

use laneweave_network::{ChainIndex, Network, Position};

use super::movement::Movement;
use super::{Bottleneck, Load, Roads};

/// The loads of junctions without lights. There are two kinds: groups of movements that all conflict with each other,
/// so that only one of them can be on the junction (the conflict technique of Wu, 2000, Brilon and Wu, 2001); and the
/// lanes from which drivers give way.
pub(super) fn loads(roads: &Roads, movements: &[Movement]) -> Vec<Load> {
    let place = |number: usize| {
        let Movement { chain, start, .. } = movements[number];
        Position::new(chain, start.max(0.0))
    };
    let load = |share: f64, members: &[usize]| {
        let at: Vec<Position> = members.iter().copied().map(place).collect();
        Load::new(share, Bottleneck::Junction(roads.lanelet(at[0].chain, at[0].x)), at)
    };
    let together = (0..movements.len()).map(|first| {
        let members = clique(movements, first);
        let others = |it: usize| members.iter().copied().filter(move |other| *other != it);
        let share_of = |it: &usize| movements[*it].share_beside(others(*it));
        let whole = load(members.iter().map(share_of).sum(), &members);
        // Who has priority over all others passes, however many the others are.
        let (mut order, prior): (Vec<usize>, Vec<usize>) =
            members.iter().partition(|it| movements[**it].before > 0.0);
        if order.is_empty() {
            return whole;
        }
        let (waits, [waiting, first]) =
            (order.len(), [&order, &prior].map(|it| it.iter().map(share_of).sum::<f64>()));
        order.extend(prior);
        let at = order.into_iter().map(place).collect();
        Load { at, passing: ((1.0 - first).max(0.0) / waiting).min(1.0), waits, ..whole }
    });
    let approaches = approaches(roads.network, movements);
    let giving_way = approaches.iter().map(|it| {
        let before = it.movements.iter().flat_map(|it| &movements[*it].rivals);
        let all: Vec<usize> = it.movements.iter().chain(before).copied().collect();
        let passing = (1.0 / it.fullness(movements, 1.0)).clamp(0.0, 1.0);
        Load { passing, waits: it.movements.len(), ..load(it.share(movements), &all) }
    });
    together.chain(giving_way).collect()
}

/// A lane from which movements start.
pub(super) struct Approach {
    pub(super) chain: ChainIndex,
    /// Their indices.
    movements: Vec<usize>,
}

/// The lanes from which movements start.
pub(super) fn approaches(network: &Network, movements: &[Movement]) -> Vec<Approach> {
    let approach = |it: &Movement| match network.chain(it.chain).previous[..] {
        [before] => before,
        _ => it.chain,
    };
    let mut groups: BTreeMap<ChainIndex, Vec<usize>> = BTreeMap::new();
    for (movement, number) in movements.iter().zip(0..) {
        groups.entry(approach(movement)).or_default().push(number);
    }
    groups.into_iter().map(|(chain, movements)| Approach { chain, movements }).collect()
}

impl Approach {
    /// Its flow, and the part of this flow that gives way [veh/s].
    pub(super) fn flows(&self, movements: &[Movement]) -> [f64; 2] {
        let sum = |of: fn(&&Movement) -> bool| {
            self.movements.iter().map(|it| &movements[*it]).filter(of).map(|it| it.flow).sum()
        };
        [sum(|_| true), sum(|it| it.before > 0.0)]
    }

    /// Its load when all flows are `growth` times as large. Each of its movements takes gaps in the streams with
    /// priority over it (Siegloch, 1973); on one lane the movements take turns (Harders, 1968).
    pub(super) fn fullness(&self, movements: &[Movement], growth: f64) -> f64 {
        self.movements.iter().map(|it| taken_up(movements, *it, growth, RANKS)).sum()
    }

    /// Its load: the inverse of the growth of all flows that fills it.
    fn share(&self, movements: &[Movement]) -> f64 {
        const HALVINGS: u32 = 50;
        if self.movements.iter().all(|it| movements[*it].flow == 0.0) {
            return 0.0;
        }
        let (mut low, mut high) = (0.0, 1.0);
        while self.fullness(movements, high) < 1.0 {
            (low, high) = (high, 2.0 * high);
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if self.fullness(movements, middle) < 1.0 { low = middle } else { high = middle }
        }
        1.0 / high
    }
}

/// Longest sequence of movements in which each gives way to the next.
const RANKS: u32 = 3;

/// The share of time that a movement needs for its vehicles when all flows are `growth` times as large. It takes a
/// gap only while no vehicle waits that has priority over it and gives way to others (the impedance of the Highway
/// Capacity Manual, from memory); up to `ranks` movements wait for each other.
fn taken_up(movements: &[Movement], number: usize, growth: f64, ranks: u32) -> f64 {
    let Movement { flow, before, gap, follow_up, ref waits_for, .. } = movements[number];
    if flow == 0.0 {
        return 0.0;
    }
    let gaps = libm::exp(-growth * before * (gap - 0.5 * follow_up));
    let impeding = waits_for.iter().filter(|_| ranks > 0);
    let is_free = |it: &usize| (1.0 - taken_up(movements, *it, growth, ranks - 1)).max(0.0);
    let free: f64 = impeding.map(is_free).product();
    growth * flow * follow_up / (gaps * free)
}

/// Movements that all conflict with each other: the `first`, and as many of the others as possible, those with the
/// largest shares of time first.
fn clique(movements: &[Movement], first: usize) -> Vec<usize> {
    let mut members = vec![first];
    for rival in &movements[first].rivals {
        if members.iter().all(|it| movements[*it].rivals.contains(rival)) {
            members.push(*rival);
        }
    }
    members
}
