//! Entrances and exits: where vehicles come onto the map and leave it.

use crate::chain::{Chain, ChainIndex};
use crate::id::Id;
use crate::lanelet::{Lanelet, LaneletIndex, Side};

/// A lane shorter than this, up to its next fork or merge, is no entrance, and a road shorter than this has no exit
/// [m].
pub const MINIMUM_GATE_LENGTH: f64 = 10.0;

/// Lanes side by side at which vehicles enter, or leave, the map.
#[derive(Clone, Debug, PartialEq)]
pub struct Gate {
    /// The smallest id of its lanelets: its name.
    pub id: Id,
    /// Its chains, ordered by the ids of their lanelets at the gate.
    pub chains: Vec<ChainIndex>,
}

/// Whether the road that ends with this lanelet is at least [`MINIMUM_GATE_LENGTH`] long: it may end with a short one.
pub(crate) fn is_end_of_a_road(
    lanelets: &[Lanelet],
    previous: &[Vec<LaneletIndex>],
    end: LaneletIndex,
) -> bool {
    let mut open = vec![(end, 0.0)];
    let mut seen = vec![end];
    while let Some((lanelet, beyond)) = open.pop() {
        let length = beyond + lanelets[lanelet.at()].length();
        if length >= MINIMUM_GATE_LENGTH {
            return true;
        }
        for before in &previous[lanelet.at()] {
            if !seen.contains(before) {
                seen.push(*before);
                open.push((*before, length));
            }
        }
    }
    false
}

/// The groups of open lanelets, joined by permitted changes, that are all long enough. If a lanelet's group has one
/// that is not open, it is a lane that begins, or ends, beside a continuing one. A single lanelet without a link to any
/// other is no gate where there are others.
pub(crate) fn gates(
    lanelets: &[Lanelet],
    chain_of: &[ChainIndex],
    is_open: impl Fn(LaneletIndex) -> bool,
    is_long_enough: impl Fn(LaneletIndex) -> bool,
) -> Vec<Gate> {
    let mut seen = vec![false; lanelets.len()];
    let beside = neighbours(lanelets);
    let mut has_previous = vec![false; lanelets.len()];
    lanelets.iter().flat_map(|it| &it.following).for_each(|it| has_previous[it.at()] = true);
    let (mut found, mut alone) = (Vec::new(), Vec::new());
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
        let is_alone =
            group.len() == 1 && lanelets[first.at()].following.is_empty() && !has_previous[first.at()];
        let is_gate = |it: &LaneletIndex| is_open(*it) && is_long_enough(*it);
        if group.iter().all(is_gate) {
            group.sort_by_key(|it| lanelets[it.at()].id);
            let gate = Gate {
                id: lanelets[group[0].at()].id,
                chains: group.iter().map(|it| chain_of[it.at()]).collect(),
            };
            if is_alone { alone.push(gate) } else { found.push(gate) }
        }
    }
    let mut found = if found.is_empty() { alone } else { found };
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

/// Chains without a following one that are no exit: lane drops. A single lanelet is none.
pub(crate) fn lane_drops(chains: &[Chain], exits: &[Gate]) -> Vec<ChainIndex> {
    let mut leaves = vec![false; chains.len()];
    exits.iter().flat_map(|gate| &gate.chains).for_each(|index| leaves[index.at()] = true);
    let mut has_neighbour = vec![false; chains.len()];
    for (chain, here) in chains.iter().zip(0..) {
        for beside in chain.left.iter().chain(&chain.right) {
            has_neighbour[beside.chain.at()] = true;
            has_neighbour[here] = true;
        }
    }
    let is_alone = |index: usize| {
        let chain = &chains[index];
        chain.lanelets.len() == 1 && chain.previous.is_empty() && !has_neighbour[index]
    };
    (0..chains.len())
        .filter(|index| chains[*index].following.is_empty() && !leaves[*index] && !is_alone(*index))
        .map(|i| ChainIndex(i as u32))
        .collect()
}
