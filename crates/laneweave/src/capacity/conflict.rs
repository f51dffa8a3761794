//! How full junctions without lights are.

use std::collections::BTreeMap;

use laneweave_network::{ChainIndex, Network};

use super::movement::{Movement, movements};
use super::{Bottleneck, Load, Roads};

/// The loads of junctions without lights: of movements that all get in each other's way, of which only one can be on the junction (the
/// conflict technique of Wu, 2000, Brilon and Wu, 2001), and of the lanes from which drivers give way.
pub(super) fn loads(roads: &Roads) -> Vec<Load> {
    let movements = movements(roads);
    let at =
        |movement: &Movement| Bottleneck::Junction(roads.lanelet(movement.chain, movement.start.max(0.0)));
    let together = (0..movements.len()).map(|first| {
        let share = clique(&movements, first).into_iter().map(|it| movements[it].share()).sum();
        Load { share, of: at(&movements[first]) }
    });
    let from_a_lane = by_approach(roads.network, &movements);
    let giving_way =
        from_a_lane.iter().map(|all| Load { share: giving_way(&movements, all), of: at(&movements[all[0]]) });
    together.chain(giving_way).collect()
}

/// The movements, by the lane from which they start.
fn by_approach(network: &Network, movements: &[Movement]) -> Vec<Vec<usize>> {
    let approach = |it: &Movement| match network.chain(it.chain).previous[..] {
        [before] => before,
        _ => it.chain,
    };
    let mut groups: BTreeMap<ChainIndex, Vec<usize>> = BTreeMap::new();
    for (movement, number) in movements.iter().zip(0..) {
        groups.entry(approach(movement)).or_default().push(number);
    }
    groups.into_values().collect()
}

/// How full the lane is from which `all` of some movements start: each takes gaps in the streams that go before it (Siegloch, 1973),
/// and on one lane they take turns (Harders, 1968).
fn giving_way(movements: &[Movement], all: &[usize]) -> f64 {
    const HALVINGS: u32 = 50;
    // By the growth of all flows, how full the lane is.
    let load = |growth: f64| -> f64 { all.iter().map(|it| taken_up(movements, *it, growth, RANKS)).sum() };
    if all.iter().all(|it| movements[*it].flow == 0.0) {
        return 0.0;
    }
    let (mut low, mut high) = (0.0, 1.0);
    while load(high) < 1.0 {
        (low, high) = (high, 2.0 * high);
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if load(middle) < 1.0 { low = middle } else { high = middle }
    }
    1.0 / high
}

/// So many movements one after the other give way to the next.
const RANKS: u32 = 3;

/// Of all the time, what a movement needs for its vehicles when all flows are `growth` times as large. It takes a gap only while none of
/// those wait who go before it and give way to others (the impedance of the Highway Capacity Manual, from memory); up to `ranks` of
/// them wait for each other.
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

/// Movements that all get in each other's way: the `first`, and as many of the others as can be, those that take most of the time
/// before the others.
fn clique(movements: &[Movement], first: usize) -> Vec<usize> {
    let mut members = vec![first];
    for rival in &movements[first].rivals {
        if members.iter().all(|it| movements[*it].rivals.contains(rival)) {
            members.push(*rival);
        }
    }
    members
}
