//! Which lights conflict, and the plans of those without a program.

use std::collections::BTreeSet;

use crate::chain::{ChainIndex, Position};
use crate::junction::{
    Junctions, LightConflict, LightIndex, Precedence, Sign, SignalPlan, Touch, Turn, ZoneIndex,
};
use crate::network::Network;

/// Length of yellow [s] (definitions of generated programs).
const YELLOW: f64 = 3.0;
/// Cycle of generated programs [s].
const CYCLE: f64 = 60.0;
/// Speed at which vehicles clear a junction [m/s], and minimum clearance time [s].
const CLEARING_SPEED: f64 = 8.0;
const LEAST_ALL_RED: f64 = 2.0;
/// Minimum green [s]; with more groups than fit into the cycle, the cycle is longer. Ours.
const LEAST_GREEN: f64 = 5.0;

/// The pairs of lights that conflict.
pub(super) struct Conflicts {
    pub(super) found: Vec<LightConflict>,
    /// Number of pairs that were compared.
    comparisons: u64,
}

/// The pairs of lights that conflict.
pub(super) fn conflicts(network: &Network, junctions: &Junctions) -> Conflicts {
    between(junctions, &fields(network, junctions))
}

/// The plans for lights without a program. Cycle 60 s; groups without conflicts follow each other in the order of
/// ids; yellow 3 s; all red for the clearance distance at 8 m/s, at least 2 s. The groups share the rest as green in
/// equal parts. With them comes the number of pairs of lights that were compared.
pub(super) fn made_plans(network: &Network, junctions: &Junctions) -> (Vec<SignalPlan>, u64) {
    let mut plans = Vec::new();
    let fields = fields(network, junctions);
    let Conflicts { found, comparisons } = between(junctions, &fields);
    let rivals = rivals(fields.len(), &found);
    for members in junctions_of(&rivals) {
        let groups = groups(&members, &rivals);
        if groups.len() < 2 {
            continue;
        }
        let all_red = |group: &Vec<usize>| all_red(group.iter().map(|it| &fields[*it]));
        let pauses: f64 = groups.iter().map(|group| YELLOW + all_red(group)).sum();
        let green = ((CYCLE - pauses) / groups.len() as f64).max(LEAST_GREEN);
        let turn = |group: &Vec<usize>| Turn {
            lights: group.iter().map(|it| LightIndex(*it as u32)).collect(),
            green,
            extension: None,
            yellow: YELLOW,
            all_red: all_red(group),
        };
        plans.push(SignalPlan { offset: 0.0, turns: groups.iter().map(turn).collect() });
    }
    (plans, comparisons)
}

/// What lies behind each light.
fn fields(network: &Network, junctions: &Junctions) -> Vec<Field> {
    let mut stops: Vec<Vec<Position>> = vec![Vec::new(); junctions.lights.len()];
    for (chain, index) in junctions.chains.iter().zip(0..) {
        for stop in &chain.stops {
            if let Sign::Light(light) = stop.sign {
                stops[light.at()].push(Position::new(ChainIndex(index), stop.station));
            }
        }
    }
    stops.iter().map(|it| Field::beyond(network, junctions, it)).collect()
}

/// For each zone and each of its sides whether its drivers pass a light.
pub(super) fn lit_sides(network: &Network, junctions: &Junctions) -> Vec<[bool; 2]> {
    let mut is_lit = vec![[false; 2]; junctions.zones.len()];
    for (zone, side) in fields(network, junctions).into_iter().flat_map(|it| it.zones) {
        is_lit[zone as usize][usize::from(side)] = true;
    }
    is_lit
}

fn between(junctions: &Junctions, fields: &[Field]) -> Conflicts {
    let is_ordered = |zone: u32| matches!(junctions.zones[zone as usize].precedence, Precedence::Side(_));
    // The lights whose drivers reach each side of each zone.
    let mut reaching: Vec<[Vec<usize>; 2]> = vec![Default::default(); junctions.zones.len()];
    for (field, light) in fields.iter().zip(0..) {
        field.zones.iter().for_each(|(zone, side)| reaching[*zone as usize][usize::from(*side)].push(light));
    }
    let conflict = |a: usize, b: usize| {
        let meet = |it: &&(u32, u8)| fields[b].zones.contains(&(it.0, 1 - it.1));
        let (zone, side) = *fields[a].zones.iter().filter(meet).min_by_key(|it| is_ordered(it.0))?;
        Some(LightConflict {
            lights: [a, b].map(|it| LightIndex(it as u32)),
            zone: ZoneIndex(zone),
            side,
            is_ordered: is_ordered(zone),
        })
    };
    let (mut found, mut comparisons) = (Vec::new(), 0);
    for (field, a) in fields.iter().zip(0..) {
        let opposite = |it: &(u32, u8)| &reaching[it.0 as usize][usize::from(1 - it.1)];
        let others: BTreeSet<usize> = field.zones.iter().flat_map(opposite).copied().collect();
        comparisons += others.len() as u64;
        found.extend(others.range(a + 1..).filter_map(|b| conflict(a, *b)));
    }
    Conflicts { found, comparisons }
}

/// For each of so many lights those that conflict with it, in order.
fn rivals(count: usize, conflicts: &[LightConflict]) -> Vec<BTreeSet<usize>> {
    let mut rivals = vec![BTreeSet::new(); count];
    for [a, b] in conflicts.iter().map(|it| it.lights.map(LightIndex::at)) {
        rivals[a].insert(b);
        rivals[b].insert(a);
    }
    rivals
}

/// The lights of each junction: those that conflict, directly or through others, in order.
fn junctions_of(rivals: &[BTreeSet<usize>]) -> Vec<Vec<usize>> {
    let mut is_known = vec![false; rivals.len()];
    let mut found = Vec::new();
    for first in 0..rivals.len() {
        let (mut members, mut open) = (Vec::new(), vec![first]);
        while let Some(light) = open.pop() {
            if !std::mem::replace(&mut is_known[light], true) {
                members.push(light);
                open.extend(&rivals[light]);
            }
        }
        if !members.is_empty() {
            members.sort_unstable();
            found.push(members);
        }
    }
    found
}

/// Time for the last vehicle to clear the junction [s].
fn all_red<'a>(fields: impl Iterator<Item = &'a Field>) -> f64 {
    (fields.map(|it| it.clearance).fold(0.0, f64::max) / CLEARING_SPEED).max(LEAST_ALL_RED)
}

/// Maximal sets of members that do not conflict: each begins with the first member that has had no phase.
fn groups(members: &[usize], rivals: &[BTreeSet<usize>]) -> Vec<Vec<usize>> {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for first in members {
        if groups.iter().any(|group| group.contains(first)) {
            continue;
        }
        let mut group = vec![*first];
        for other in members {
            if !group.contains(other) && group.iter().all(|it| !rivals[*it].contains(other)) {
                group.push(*other);
            }
        }
        groups.push(group);
    }
    groups
}

/// What lies behind a light.
struct Field {
    /// Zones and sides that its drivers reach.
    zones: Vec<(u32, u8)>,
    /// Longest path from their stop line to the end of the last of them [m].
    clearance: f64,
}

impl Field {
    /// What lies beyond the `stops` of a light.
    fn beyond(network: &Network, junctions: &Junctions, stops: &[Position]) -> Field {
        /// Zones further beyond a light, or beyond the last zone, belong to another junction [m].
        const REACH: f64 = 80.0;
        const NEXT: f64 = 25.0;
        let mut field = Field { zones: Vec::new(), clearance: 0.0 };
        // Chain, station there, distance from the stop to the chain's start, and to the end of the last zone.
        let mut open: Vec<(ChainIndex, f64, f64, f64)> =
            stops.iter().map(|it| (it.chain, it.x, -it.x, NEXT)).collect();
        while let Some((chain, from, base, mut reached)) = open.pop() {
            for crossing in &junctions.on(chain).crossings {
                let reach = junctions.reach(*crossing);
                let is_ahead = reach.end > from && base + reach.start < (reached + NEXT).min(REACH);
                if is_ahead && junctions.zones[crossing.zone.at()].touch == Touch::Any {
                    field.zones.push((crossing.zone.0, crossing.side));
                    reached = reached.max(base + reach.end);
                    field.clearance = field.clearance.max(base + reach.end);
                }
            }
            let beyond = base + network.chain(chain).length;
            if beyond < (reached + NEXT).min(REACH) {
                open.extend(network.chain(chain).following.iter().map(|it| (*it, 0.0, beyond, reached)));
            }
        }
        field
    }
}
