//! Traffic lights and their programs.

use super::{Junctions, Sign, StopKind, StopRule, ZoneKind};
use crate::build::Network;
use crate::chain::ChainIndex;

/// A light's place in [`super::Junctions::lights`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct LightIndex(pub u32);

impl LightIndex {
    /// The place as an index.
    pub fn at(self) -> usize {
        self.0 as usize
    }
}

/// A light, or several that the drivers on one lanelet heed together.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// The smallest id of its regulatory elements: its name.
    pub id: i64,
    /// When it shows what.
    pub program: Program,
}

/// What a light shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightState {
    /// Go.
    Green,
    /// Stop if that is possible with comfort.
    Yellow,
    /// Stop.
    Red,
}

/// A program that repeats: green within `green`, yellow after it.
#[derive(Clone, Debug, PartialEq)]
pub struct Program {
    /// Length of a cycle [s].
    pub cycle: f64,
    /// What comes first in the cycle comes first here.
    pub phases: Vec<Phase>,
}

/// A green and the yellow after it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phase {
    /// When green begins within the cycle [s].
    pub from: f64,
    /// When it ends [s].
    pub to: f64,
}

/// Length of yellow [s] (definitions of made signals).
const YELLOW: f64 = 3.0;
/// Cycle of made programs [s].
const CYCLE: f64 = 60.0;
/// Speed at which a junction is taken to be cleared [m/s], and least time for it [s].
const CLEARING_SPEED: f64 = 8.0;
const LEAST_ALL_RED: f64 = 2.0;
/// Shortest green [s]; with more groups than fit into the cycle it is longer. Ours.
const LEAST_GREEN: f64 = 5.0;

impl Program {
    /// A light that never stops anybody.
    pub const ALWAYS_GREEN: Program = Program { cycle: CYCLE, phases: Vec::new() };

    /// What a light with this program shows at `time` [s].
    pub fn state(&self, time: f64) -> LightState {
        if self.phases.is_empty() {
            return LightState::Green;
        }
        let at = time.rem_euclid(self.cycle);
        // The yellow of a phase may reach into the next cycle.
        let shows = |phase: &Phase| {
            let since = |moment: f64| (at - moment).rem_euclid(self.cycle);
            let green = phase.to - phase.from;
            if since(phase.from) < green {
                LightState::Green
            } else if since(phase.from) < green + YELLOW {
                LightState::Yellow
            } else {
                LightState::Red
            }
        };
        let states = self.phases.iter().map(shows);
        states.min_by_key(|it| *it as u8).unwrap_or(LightState::Red)
    }

    /// Share of the time that it is green.
    pub fn green_share(&self) -> f64 {
        if self.phases.is_empty() {
            return 1.0;
        }
        self.phases.iter().map(|it| it.to - it.from).sum::<f64>() / self.cycle
    }
}

/// The rules of lights, together where a lanelet heeds several, ordered by their smallest ids.
pub(super) fn sharing(stops: &[StopRule]) -> Vec<Vec<&StopRule>> {
    let mut groups: Vec<Vec<&StopRule>> = Vec::new();
    for rule in stops.iter().filter(|it| it.kind == StopKind::Light && !it.lanelets.is_empty()) {
        let shares = |group: &Vec<&StopRule>| {
            group.iter().any(|other| other.lanelets.iter().any(|it| rule.lanelets.contains(it)))
        };
        let (together, apart): (Vec<_>, Vec<_>) = groups.into_iter().partition(shares);
        groups = apart;
        groups.push(together.into_iter().flatten().chain([rule]).collect());
    }
    groups.sort_by_key(|group| group.iter().map(|it| it.id).min());
    groups
}

/// The lights with made programs: 60 s, groups that do not get in each other's way one after the other in the order of
/// ids, yellow 3 s, all red for the clearance distance at 8 m/s, at least 2 s; what is left is green in equal shares.
pub(super) fn with_made_programs(network: &Network, junctions: &Junctions) -> Vec<Light> {
    let mut lights = junctions.lights.clone();
    let fields: Vec<Field> =
        (0..lights.len()).map(|it| Field::of(network, junctions, LightIndex(it as u32))).collect();
    let conflict = |a: usize, b: usize| {
        let crosses = |zone: &(u32, u8)| fields[b].zones.contains(&(zone.0, 1 - zone.1));
        a != b && fields[a].zones.iter().any(crosses)
    };
    for members in junctions_of(lights.len(), conflict) {
        let groups = groups(&members, conflict);
        if groups.len() < 2 {
            continue;
        }
        let pauses: Vec<f64> =
            groups.iter().map(|group| YELLOW + all_red(group.iter().map(|it| &fields[*it]))).collect();
        let left = CYCLE - pauses.iter().sum::<f64>();
        let green = (left / groups.len() as f64).max(LEAST_GREEN);
        let mut from = 0.0;
        let turns: Vec<Phase> = pauses
            .iter()
            .map(|pause| {
                let phase = Phase { from, to: from + green };
                from += green + pause;
                phase
            })
            .collect();
        for member in members {
            let has_turn = |number: usize| groups[number].contains(&member);
            let mut phases: Vec<Phase> = Vec::new();
            for number in (0..groups.len()).filter(|it| has_turn(*it)) {
                match phases.last_mut() {
                    // Green in two turns that follow on each other goes on in between.
                    Some(last) if has_turn(number - 1) => last.to = turns[number].to,
                    _ => phases.push(turns[number]),
                }
            }
            lights[member].program = Program { cycle: from, phases };
        }
    }
    lights
}

/// The lights of each junction: those that get in each other's way, directly or over others, in order.
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

/// Time for who passed last to clear the junction [s].
fn all_red<'a>(fields: impl Iterator<Item = &'a Field>) -> f64 {
    (fields.map(|it| it.clearance).fold(0.0, f64::max) / CLEARING_SPEED).max(LEAST_ALL_RED)
}

/// Maximal sets of members that do not conflict: each begins with the first that has had no turn.
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
    /// Zones and sides that its drivers come to.
    zones: Vec<(u32, u8)>,
    /// Longest way from where they stop to the end of the last of them [m].
    clearance: f64,
}

impl Field {
    fn of(network: &Network, junctions: &Junctions, light: LightIndex) -> Field {
        /// Zones further beyond a light, or beyond the last zone, are another junction's [m].
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
                if is_ahead && junctions.zones[crossing.zone.at()].kind != ZoneKind::Tight {
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
