//! Which lights conflict, and the plans of those without a program.

use crate::chain::ChainIndex;
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
pub(super) fn conflicts(network: &Network, junctions: &Junctions) -> Vec<LightConflict> {
    between(junctions, &fields(network, junctions))
}

/// The plans for lights without a program. Cycle 60 s; groups without conflicts follow each other in the order of
/// ids; yellow 3 s; all red for the clearance distance at 8 m/s, at least 2 s. The groups share the rest as green in
/// equal parts.
pub(super) fn made_plans(network: &Network, junctions: &Junctions) -> Vec<SignalPlan> {
    let mut plans = Vec::new();
    let fields = fields(network, junctions);
    let conflicts = between(junctions, &fields);
    let conflict = |a: usize, b: usize| {
        let both = [a.min(b), a.max(b)].map(|it| LightIndex(it as u32));
        conflicts.iter().any(|it| it.lights == both)
    };
    for members in junctions_of(junctions.lights.len(), conflict) {
        let groups = groups(&members, conflict);
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
    plans
}

fn fields(network: &Network, junctions: &Junctions) -> Vec<Field> {
    (0..junctions.lights.len()).map(|it| Field::of(network, junctions, LightIndex(it as u32))).collect()
}

/// For each zone and each of its sides whether its drivers pass a light.
pub(super) fn lit_sides(network: &Network, junctions: &Junctions) -> Vec<[bool; 2]> {
    let mut is_lit = vec![[false; 2]; junctions.zones.len()];
    for (zone, side) in fields(network, junctions).into_iter().flat_map(|it| it.zones) {
        is_lit[zone as usize][usize::from(side)] = true;
    }
    is_lit
}

fn between(junctions: &Junctions, fields: &[Field]) -> Vec<LightConflict> {
    let is_ordered = |zone: u32| matches!(junctions.zones[zone as usize].precedence, Precedence::Side(_));
    let pairs = (0..fields.len()).flat_map(|a| (a + 1..fields.len()).map(move |b| (a, b)));
    let conflict = |(a, b): (usize, usize)| {
        let meet = |it: &&(u32, u8)| fields[b].zones.contains(&(it.0, 1 - it.1));
        let (zone, side) = *fields[a].zones.iter().filter(meet).min_by_key(|it| is_ordered(it.0))?;
        Some(LightConflict {
            lights: [a, b].map(|it| LightIndex(it as u32)),
            zone: ZoneIndex(zone),
            side,
            is_ordered: is_ordered(zone),
        })
    };
    pairs.filter_map(conflict).collect()
}

/// The lights of each junction: those that conflict, directly or through others, in order.
fn junctions_of(count: usize, conflict: impl Fn(usize, usize) -> bool) -> Vec<Vec<usize>> {
    let mut left: Vec<usize> = (0..count).collect();
    let mut found = Vec::new();
    while !left.is_empty() {
        let mut members = vec![left.remove(0)];
        let mut at = 0;
        while at < members.len() {
            let here = members[at];
            let (new, others): (Vec<_>, Vec<_>) = left.into_iter().partition(|it| conflict(here, *it));
            members.extend(new);
            left = others;
            at += 1;
        }
        members.sort_unstable();
        found.push(members);
    }
    found
}

/// Time for the last vehicle to clear the junction [s].
fn all_red<'a>(fields: impl Iterator<Item = &'a Field>) -> f64 {
    (fields.map(|it| it.clearance).fold(0.0, f64::max) / CLEARING_SPEED).max(LEAST_ALL_RED)
}

/// Maximal sets of members that do not conflict: each begins with the first member that has had no phase.
fn groups(members: &[usize], conflict: impl Fn(usize, usize) -> bool) -> Vec<Vec<usize>> {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for first in members {
        if groups.iter().any(|group| group.contains(first)) {
            continue;
        }
        let mut group = vec![*first];
        for other in members {
            if !group.contains(other) && group.iter().all(|it| !conflict(*it, *other)) {
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
    fn of(network: &Network, junctions: &Junctions, light: LightIndex) -> Field {
        /// Zones further beyond a light, or beyond the last zone, belong to another junction [m].
        const REACH: f64 = 80.0;
        const NEXT: f64 = 25.0;
        let mut field = Field { zones: Vec::new(), clearance: 0.0 };
        // Chain, station there, distance from the stop to the chain's start, and to the end of the last zone.
        let mut open: Vec<(ChainIndex, f64, f64, f64)> = Vec::new();
        for (index, chain) in junctions.chains.iter().enumerate() {
            let stops = chain.stops.iter().filter(|it| it.sign == Sign::Light(light));
            open.extend(stops.map(|it| (ChainIndex(index as u32), it.station, -it.station, NEXT)));
        }
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
