//! Which lights conflict.

use std::collections::BTreeSet;

use super::components::components;
use super::lanes::Lane;
use crate::junction::{Junctions, LightConflict, LightIndex, Precedence, ZoneIndex};

/// The pairs of lights that conflict.
pub(super) struct Conflicts {
    pub(super) found: Vec<LightConflict>,
    /// Number of pairs that were compared.
    pub(super) comparisons: u64,
}

/// For each light those that conflict with it.
pub(super) struct Rivals {
    /// All of them.
    pub(super) any: Vec<BTreeSet<LightIndex>>,
    /// Those with which it is never green together: somewhere neither side has priority.
    pub(super) hard: Vec<BTreeSet<LightIndex>>,
}

impl Rivals {
    /// Whether some light of `these` is never green together with one of `those`.
    pub(super) fn exclude(&self, these: &[LightIndex], those: &[LightIndex]) -> bool {
        these.iter().any(|it| those.iter().any(|other| self.hard[it.at()].contains(other)))
    }
}

/// The pairs of lights that conflict.
pub(super) fn between(junctions: &Junctions, lanes: &[Lane]) -> Conflicts {
    let is_ordered = |zone: ZoneIndex| matches!(junctions.zones[zone.at()].precedence, Precedence::Side(_));
    // The zones beyond each light, and the lights whose drivers reach each side of each zone.
    let mut beyond: Vec<BTreeSet<(ZoneIndex, u8)>> = vec![BTreeSet::new(); junctions.lights.len()];
    let mut reaching: Vec<[BTreeSet<usize>; 2]> = vec![Default::default(); junctions.zones.len()];
    for lane in lanes {
        for (zone, side) in lane.zones() {
            beyond[lane.light.at()].insert((zone, side));
            reaching[zone.at()][usize::from(side)].insert(lane.light.at());
        }
    }
    let conflict = |a: usize, b: usize| {
        let meet = |it: &&(ZoneIndex, u8)| beyond[b].contains(&(it.0, 1 - it.1));
        let (zone, side) = *beyond[a].iter().filter(meet).min_by_key(|it| is_ordered(it.0))?;
        Some(LightConflict {
            lights: [a, b].map(|it| LightIndex(it as u32)),
            zone,
            side,
            is_ordered: is_ordered(zone),
        })
    };
    let (mut found, mut comparisons) = (Vec::new(), 0);
    for (zones, a) in beyond.iter().zip(0..) {
        let opposite = |it: &(ZoneIndex, u8)| &reaching[it.0.at()][usize::from(1 - it.1)];
        let others: BTreeSet<usize> = zones.iter().flat_map(opposite).copied().collect();
        comparisons += others.len() as u64;
        found.extend(others.range(a + 1..).filter_map(|b| conflict(a, *b)));
    }
    Conflicts { found, comparisons }
}

/// For each of so many lights those that conflict with it.
pub(super) fn rivals(count: usize, conflicts: &[LightConflict]) -> Rivals {
    let [any, hard] = [(); 2].map(|()| vec![BTreeSet::new(); count]);
    let mut rivals = Rivals { any, hard };
    for LightConflict { lights: [a, b], is_ordered, .. } in conflicts {
        for (one, other) in [(a, b), (b, a)] {
            rivals.any[one.at()].insert(*other);
            if !is_ordered {
                rivals.hard[one.at()].insert(*other);
            }
        }
    }
    rivals
}

/// The lights of each junction: those that conflict, directly or through others, in order.
pub(super) fn junctions(rivals: &[BTreeSet<LightIndex>]) -> Vec<Vec<LightIndex>> {
    let found = components(rivals.len(), |light| rivals[light].iter().map(|it| it.at()));
    let lights = |members: Vec<usize>| members.into_iter().map(|it| LightIndex(it as u32)).collect();
    found.into_iter().map(lights).collect()
}
