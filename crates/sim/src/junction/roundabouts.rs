//! Roundabouts, and other short loops of lanes without lights, on which vehicles queue behind each other all the way
//! round.
//!
//! A full loop locks: every vehicle waits for the space that the next one occupies. Vehicles that want to enter it
//! therefore leave part of it free, however long they wait. So the vehicles on it can always move up.

use laneweave_network::{ChainIndex, Network, Sign, ZoneKind};
use serde::{Deserialize, Serialize};

use crate::junction::need::SPARE_SPACE;
use crate::junction::reservations::Reservations;
use crate::junction::waiting_priority::WaitingPriority;
use crate::state::lane::Lane;

/// A loop that is no roundabout is no longer than this [m] (ours).
const LONGEST: f64 = 200.0;
/// Share of the length of its lane that vehicles and the gaps between them may occupy (ours: on a small roundabout
/// space for two vehicles remains, so that a truck can move up, too). It is less where lanes cross: a vehicle that
/// waits for another lane holds up its own.
const MOST_TAKEN: f64 = 0.6;
const MOST_TAKEN_CROSSED: f64 = 0.4;

/// The loops of a network.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Roundabouts {
    loops: Vec<Loop>,
    /// For each chain the loop that it is part of; empty if there are none.
    of: Vec<Option<u32>>,
    /// For each chain where it is at a roundabout, if at one; empty if there are none.
    places: Vec<Option<AtRoundabout>>,
}

/// Where a chain is at a roundabout.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
enum AtRoundabout {
    On,
    In,
    Out,
}

#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Loop {
    chains: Vec<ChainIndex>,
    /// Chains that lead into it from outside.
    entries: Vec<ChainIndex>,
    /// Share of its length that may be occupied.
    most_taken: f64,
    /// Length of its chains [m].
    length: f64,
    /// The impatient vehicle that has waited longest to enter it.
    priority: Option<WaitingPriority>,
}

/// What a chain is part of.
#[derive(Clone, Copy, PartialEq, Eq)]
enum PartOf {
    Nothing,
    /// A short loop.
    Loop,
    /// A lane of a roundabout.
    Ring,
}

impl PartOf {
    fn what(network: &Network, chain: ChainIndex) -> PartOf {
        if has_light(network, chain) {
            PartOf::Nothing
        } else if network.junctions.is_in_roundabout(chain) {
            PartOf::Ring
        } else if comes_round(network, chain) {
            PartOf::Loop
        } else {
            PartOf::Nothing
        }
    }
}

impl Roundabouts {
    /// The loops of `network` without lights: chains that lead back to their starts, each with those of its kind that
    /// are linked to it. So each lane of a roundabout is one of its own.
    pub(crate) fn of(network: &Network) -> Roundabouts {
        let chains = (0..network.chains.len() as u32).map(ChainIndex);
        let parts: Vec<PartOf> = chains.clone().map(|it| PartOf::what(network, it)).collect();
        let count = network.chains.len();
        let mut found = Roundabouts { loops: Vec::new(), of: vec![None; count], places: vec![None; count] };
        for first in chains.filter(|it| parts[it.at()] != PartOf::Nothing) {
            if found.of[first.at()].is_none() {
                found.add(network, &parts, first);
            }
        }
        if found.loops.is_empty() { Roundabouts::default() } else { found }
    }

    /// Adds the loop of the chain `first`.
    fn add(&mut self, network: &Network, parts: &[PartOf], first: ChainIndex) {
        let number = self.loops.len() as u32;
        let kind = parts[first.at()];
        let is_part = |it: &&ChainIndex| parts[it.at()] == kind;
        let mut new = Loop { most_taken: MOST_TAKEN, ..Loop::default() };
        let mut open = vec![first];
        while let Some(chain) = open.pop() {
            if self.of[chain.at()].replace(number).is_some() {
                continue;
            }
            let here = network.chain(chain);
            new.chains.push(chain);
            new.length += here.length;
            if kind == PartOf::Loop
                || std::iter::once(&chain).chain(&here.following).any(|it| is_crossed(network, *it))
            {
                new.most_taken = MOST_TAKEN_CROSSED;
            }
            let linked = here.following.iter().chain(&here.previous).filter(is_part);
            open.extend(linked.filter(|it| self.of[it.at()].is_none()));
            new.entries.extend(here.previous.iter().filter(|it| !is_part(it)));
            if kind == PartOf::Ring {
                self.places[chain.at()] = Some(AtRoundabout::On);
                let beside = [(&here.previous, AtRoundabout::In), (&here.following, AtRoundabout::Out)];
                for (others, place) in beside {
                    let outside = others.iter().filter(|it| !is_part(it));
                    outside.for_each(|it| self.places[it.at()] = Some(place));
                }
            }
        }
        self.loops.push(new);
    }

    /// Whether they are those of the same network, with any waiting priorities.
    pub(crate) fn fits(&self, other: &Roundabouts) -> bool {
        let alike = |(one, other): (&Loop, &Loop)| {
            Loop { priority: None, ..one.clone() } == Loop { priority: None, ..other.clone() }
        };
        self.of == other.of
            && self.places == other.places
            && self.loops.len() == other.loops.len()
            && self.loops.iter().zip(&other.loops).all(alike)
    }

    /// The loop that a vehicle enters from one chain to another.
    fn entered(&self, [from, to]: [ChainIndex; 2]) -> Option<u32> {
        let number = |it: ChainIndex| self.of.get(it.at()).copied().flatten();
        let is_outside = || number(from).is_none() || self.is_on(to) && !self.is_on(from);
        number(to).filter(|_| is_outside())
    }

    fn place(&self, chain: ChainIndex) -> Option<AtRoundabout> {
        self.places.get(chain.at()).copied().flatten()
    }

    /// Whether a chain is part of a roundabout.
    pub(crate) fn is_on(&self, chain: ChainIndex) -> bool {
        self.place(chain) == Some(AtRoundabout::On)
    }

    /// Whether a chain leads into a roundabout from outside.
    pub(crate) fn is_entry(&self, chain: ChainIndex) -> bool {
        self.place(chain) == Some(AtRoundabout::In)
    }

    /// Whether a chain is part of a roundabout, leads into it, or out of it.
    #[inline]
    pub(crate) fn touches(&self, chain: ChainIndex) -> bool {
        self.place(chain).is_some()
    }

    /// Whether a vehicle enters a loop from one chain to another.
    pub(crate) fn is_entered(&self, way: [ChainIndex; 2]) -> bool {
        self.entered(way).is_some()
    }

    /// Clears all waiting priorities.
    pub(crate) fn clear_priorities(&mut self) {
        self.loops.iter_mut().for_each(|it| it.priority = None);
    }

    /// Records the priority of a vehicle that waits to go from one chain to another.
    pub(crate) fn note_priority(&mut self, way: [ChainIndex; 2], priority: WaitingPriority) {
        if let Some(number) = self.entered(way) {
            let noted = &mut self.loops[number as usize].priority;
            *noted = Some(noted.map_or(priority, |it| it.min(priority)));
        }
    }

    /// Whether a vehicle with `priority` must not enter the loop between the two chains of `way`: another vehicle has a
    /// higher priority, or the loop would be full with the `needed` space [m].
    pub(crate) fn is_closed(
        &self,
        reservations: &Reservations,
        lanes: &[Lane],
        way: [ChainIndex; 2],
        priority: WaitingPriority,
        needed: f64,
    ) -> bool {
        let Some(number) = self.entered(way) else { return false };
        let entered = &self.loops[number as usize];
        if entered.priority.is_some_and(|first| first < priority) {
            return true;
        }
        let taken = entered.taken(reservations, lanes);
        taken > 0.0 && taken + needed > entered.most_taken * entered.length
    }
}

impl Loop {
    /// Length that the vehicles on it, and those with a reservation to enter it, occupy [m].
    fn taken(&self, reservations: &Reservations, lanes: &[Lane]) -> f64 {
        let space = |length: f32| f64::from(length) + SPARE_SPACE;
        let here = self.chains.iter().flat_map(|it| lanes[it.at()].motions());
        let coming = self.entries.iter().flat_map(|it| {
            let lane = &lanes[it.at()];
            let all = lane.motions().iter().zip(lane.lane_change_states()).rev();
            let coming =
                all.take_while(|(it, lane_change)| reservations.of(lane_change.reservation, it.id).is_some());
            coming.map(|(it, _)| it)
        });
        here.chain(coming).map(|it| space(it.length)).sum()
    }
}

fn has_light(network: &Network, chain: ChainIndex) -> bool {
    network.junctions.on(chain).stops.iter().any(|stop| matches!(stop.sign, Sign::Light(_)))
}

/// Whether another lane crosses a chain.
fn is_crossed(network: &Network, chain: ChainIndex) -> bool {
    let junctions = &network.junctions;
    let mut zones = junctions.on(chain).crossings.iter().map(|it| &junctions.zones[it.zone.at()]);
    zones.any(|it| it.kind == ZoneKind::Crossing)
}

/// Whether a chain leads back to its start without a light, over a short way.
fn comes_round(network: &Network, start: ChainIndex) -> bool {
    let mut reached: Vec<(ChainIndex, f64)> = Vec::new();
    let mut open = vec![(start, 0.0)];
    while let Some((chain, before)) = open.pop() {
        let end = before + network.chain(chain).length;
        if end > LONGEST || has_light(network, chain) {
            continue;
        }
        for next in &network.chain(chain).following {
            if *next == start {
                return true;
            }
            match reached.iter_mut().find(|it| it.0 == *next) {
                Some(known) if known.1 <= end => continue,
                Some(known) => known.1 = end,
                None => reached.push((*next, end)),
            }
            open.push((*next, end));
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use laneweave_generate::own_maps;
    use laneweave_maps::regulations;

    use super::*;

    fn of_map(name: &str) -> (Network, Roundabouts) {
        let (_, drawing) = own_maps().unwrap().into_iter().find(|it| it.0 == name).unwrap();
        let map = drawing.build().unwrap();
        let rules = regulations(&map);
        let network = map.network.regulated(&rules);
        let roundabouts = Roundabouts::of(&network);
        (network, roundabouts)
    }

    #[test]
    fn a_roundabout_is_one_ring_with_an_entry_at_each_arm() {
        let (network, roundabouts) = of_map("roundabout.osm");
        let [roundabout] = &roundabouts.loops[..] else { panic!("{} roundabouts", roundabouts.loops.len()) };
        assert_eq!(roundabout.entries.len(), network.entrances.len());
        assert!((60.0..200.0).contains(&roundabout.length), "{} m", roundabout.length);
        let entry = roundabout.entries[0];
        assert!(network.chain(entry).following.iter().any(|it| roundabouts.is_entered([entry, *it])));
        assert!(!roundabouts.is_entered([roundabout.chains[0], roundabout.chains[1]]));
    }

    #[test]
    fn neither_a_junction_nor_a_block_is_a_ring() {
        for name in ["priority.osm", "grid.osm", "motorway_3_lanes.osm"] {
            assert!(of_map(name).1.loops.is_empty(), "{name}");
        }
    }

    #[test]
    fn of_those_who_wait_for_a_ring_the_longest_waiting_goes_first() {
        let (network, mut roundabouts) = of_map("roundabout.osm");
        let entry = roundabouts.loops[0].entries[0];
        let onto =
            network.chain(entry).following.iter().find(|it| roundabouts.is_entered([entry, **it])).unwrap();
        let way = [entry, *onto];
        let (reservations, lanes) =
            (Reservations::new(&network), vec![Lane::default(); network.chains.len()]);
        let priority = |since, id| WaitingPriority { is_patient: false, since, id, is_long: false };
        assert!(!roundabouts.is_closed(&reservations, &lanes, way, priority(7, 1), 6.5));
        roundabouts.note_priority(way, priority(5, 2));
        assert!(roundabouts.is_closed(&reservations, &lanes, way, priority(7, 1), 6.5));
        assert!(!roundabouts.is_closed(&reservations, &lanes, way, priority(5, 2), 6.5));
        roundabouts.clear_priorities();
        assert!(!roundabouts.is_closed(&reservations, &lanes, way, priority(7, 1), 6.5));
    }
}
