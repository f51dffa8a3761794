//! Entrances and exits: where vehicles come onto the map and leave it.

use crate::chain::{Chain, ChainIndex};
use crate::lanelet::{Lanelet, LaneletIndex, Side};

/// Lanelets shorter than this are neither entrance nor exit [m].
pub const MINIMUM_GATE_LENGTH: f64 = 10.0;

/// Lanes side by side at which vehicles enter, or leave, the map.
#[derive(Clone, Debug, PartialEq)]
pub struct Gate {
    /// The smallest id of its lanelets: its name.
    pub id: i64,
    /// Its chains, ordered by the ids of their lanelets at the gate.
    pub chains: Vec<ChainIndex>,
}

/// The groups of open lanelets, joined by permitted changes, that are all at least [`MINIMUM_GATE_LENGTH`] long.
/// A lanelet whose group holds one that is not open is a lane that begins, or ends, beside a continuing one.
pub(crate) fn gates(
    lanelets: &[Lanelet],
    chain_of: &[ChainIndex],
    is_open: impl Fn(LaneletIndex) -> bool,
) -> Vec<Gate> {
    let mut seen = vec![false; lanelets.len()];
    let beside = neighbours(lanelets);
    let mut found = Vec::new();
    for first in (0..lanelets.len()).map(|i| LaneletIndex(i as u32)) {
        if seen[first.at()] || !is_open(first) {
            continue;
        }
        seen[first.at()] = true;
        let mut group = vec![first];
        let mut next = 0;
        while next < group.len() {
            for neighbour in &beside[group[next].at()] {
                if !std::mem::replace(&mut seen[neighbour.at()], true) {
                    group.push(*neighbour);
                }
            }
            next += 1;
        }
        if group.iter().all(|it| is_open(*it) && lanelets[it.at()].length() >= MINIMUM_GATE_LENGTH) {
            group.sort_by_key(|it| lanelets[it.at()].id);
            found.push(Gate {
                id: lanelets[group[0].at()].id,
                chains: group.iter().map(|it| chain_of[it.at()]).collect(),
            });
        }
    }
    found.sort_by_key(|gate| gate.id);
    found
}

/// Neighbours by a permitted change in either direction.
fn neighbours(lanelets: &[Lanelet]) -> Vec<Vec<LaneletIndex>> {
    let mut beside = vec![Vec::new(); lanelets.len()];
    for (here, lanelet) in lanelets.iter().enumerate() {
        for there in Side::BOTH.into_iter().filter_map(|side| lanelet.beside(side)) {
            beside[here].push(there);
            beside[there.at()].push(LaneletIndex(here as u32));
        }
    }
    beside
}

/// Chains that have no following one and are no exit: lane drops.
pub(crate) fn lane_drops(chains: &[Chain], exits: &[Gate]) -> Vec<ChainIndex> {
    let mut leaves = vec![false; chains.len()];
    exits.iter().flat_map(|gate| &gate.chains).for_each(|index| leaves[index.at()] = true);
    (0..chains.len())
        .map(|i| ChainIndex(i as u32))
        .filter(|index| chains[index.at()].following.is_empty() && !leaves[index.at()])
        .collect()
}
