//! Roundabouts: short loops of lanes without lights, on which vehicles queue behind each other all the way round.
//!
//! A full roundabout locks: every vehicle waits for the space that the next one occupies. Vehicles that want to enter
//! it therefore leave part of it free, however long they wait. So the vehicles on it can always move up.

use laneweave_network::{ChainIndex, Network, Sign};
use serde::{Deserialize, Serialize};

use crate::junction::need::SPARE_SPACE;
use crate::junction::reservations::Reservations;
use crate::junction::waiting_priority::WaitingPriority;
use crate::state::lane::Lane;

/// A roundabout is no longer than this [m] (ours; a roundabout with two lanes has a diameter of some 60 m).
const LONGEST: f64 = 200.0;
/// Share of its length that vehicles and the gaps between them may occupy (ours: on a small roundabout space for two
/// vehicles remains, so that a truck can move up, too).
const MOST_TAKEN: f64 = 0.4;

/// The roundabouts of a network.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Roundabouts {
    roundabouts: Vec<Roundabout>,
    /// For each chain the roundabout that it is part of; empty if there are none.
    of: Vec<Option<u32>>,
}

#[derive(Clone, Debug, Default, Serialize, Deserialize)]
struct Roundabout {
    chains: Vec<ChainIndex>,
    /// Chains that lead into it from outside.
    entries: Vec<ChainIndex>,
    /// Length of its chains [m].
    length: f64,
    /// The impatient vehicle that has waited longest to enter it.
    priority: Option<WaitingPriority>,
}

impl Roundabouts {
    /// The roundabouts of `network`: chains that lead back to their starts within a short distance, each with the
    /// chains of this kind that are linked to it.
    pub(crate) fn of(network: &Network) -> Roundabouts {
        let chains = (0..network.chains.len() as u32).map(ChainIndex);
        let is_on_ring: Vec<bool> = chains.clone().map(|it| comes_round(network, it)).collect();
        let mut roundabouts = Roundabouts { roundabouts: Vec::new(), of: vec![None; network.chains.len()] };
        for first in chains.filter(|it| is_on_ring[it.at()]) {
            if roundabouts.of[first.at()].is_some() {
                continue;
            }
            let number = roundabouts.roundabouts.len() as u32;
            let (mut roundabout, mut open) = (Roundabout::default(), vec![first]);
            while let Some(chain) = open.pop() {
                if roundabouts.of[chain.at()].replace(number).is_some() {
                    continue;
                }
                let here = network.chain(chain);
                roundabout.chains.push(chain);
                roundabout.length += here.length;
                let linked = here.following.iter().chain(&here.previous);
                open.extend(linked.filter(|it| is_on_ring[it.at()] && roundabouts.of[it.at()].is_none()));
                roundabout.entries.extend(here.previous.iter().filter(|it| !is_on_ring[it.at()]));
            }
            roundabouts.roundabouts.push(roundabout);
        }
        if roundabouts.roundabouts.is_empty() { Roundabouts::default() } else { roundabouts }
    }

    /// Whether they are those of the same network, with any waiting priorities.
    pub(crate) fn fits(&self, other: &Roundabouts) -> bool {
        let alike = |(one, other): (&Roundabout, &Roundabout)| {
            one.chains == other.chains && one.entries == other.entries && one.length == other.length
        };
        self.of == other.of
            && self.roundabouts.len() == other.roundabouts.len()
            && self.roundabouts.iter().zip(&other.roundabouts).all(alike)
    }

    /// The roundabout that a vehicle enters from one chain to another.
    fn entered(&self, [from, to]: [ChainIndex; 2]) -> Option<u32> {
        let roundabout = |it: ChainIndex| self.of.get(it.at()).copied().flatten();
        roundabout(to).filter(|_| roundabout(from).is_none())
    }

    /// Whether a vehicle enters a roundabout from one chain to another.
    pub(crate) fn is_entered(&self, way: [ChainIndex; 2]) -> bool {
        self.entered(way).is_some()
    }

    /// Clears all waiting priorities.
    pub(crate) fn clear_priorities(&mut self) {
        self.roundabouts.iter_mut().for_each(|it| it.priority = None);
    }

    /// Records the priority of a vehicle that waits to go from one chain to another.
    pub(crate) fn note_priority(&mut self, way: [ChainIndex; 2], priority: WaitingPriority) {
        if let Some(number) = self.entered(way) {
            let noted = &mut self.roundabouts[number as usize].priority;
            *noted = Some(noted.map_or(priority, |it| it.min(priority)));
        }
    }

    /// Whether a vehicle with `priority` must not enter the roundabout between the two chains of `way`: another vehicle
    /// has a higher priority, or the roundabout would be full with the `needed` space [m].
    pub(crate) fn is_closed(
        &self,
        reservations: &Reservations,
        lanes: &[Lane],
        way: [ChainIndex; 2],
        priority: WaitingPriority,
        needed: f64,
    ) -> bool {
        let Some(number) = self.entered(way) else { return false };
        let roundabout = &self.roundabouts[number as usize];
        if roundabout.priority.is_some_and(|first| first < priority) {
            return true;
        }
        let taken = roundabout.taken(reservations, lanes);
        taken > 0.0 && taken + needed > MOST_TAKEN * roundabout.length
    }
}

impl Roundabout {
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

/// Whether a chain leads back to its start without a light, within the length of a roundabout.
fn comes_round(network: &Network, start: ChainIndex) -> bool {
    let has_light = |it: ChainIndex| {
        network.junctions.on(it).stops.iter().any(|stop| matches!(stop.sign, Sign::Light(_)))
    };
    let mut reached: Vec<(ChainIndex, f64)> = Vec::new();
    let mut open = vec![(start, 0.0)];
    while let Some((chain, before)) = open.pop() {
        let end = before + network.chain(chain).length;
        if end > LONGEST || has_light(chain) {
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
        let [roundabout] = &roundabouts.roundabouts[..] else {
            panic!("{} roundabouts", roundabouts.roundabouts.len())
        };
        assert_eq!(roundabout.entries.len(), network.entrances.len());
        assert!((60.0..LONGEST).contains(&roundabout.length), "{} m", roundabout.length);
        let entry = roundabout.entries[0];
        assert!(network.chain(entry).following.iter().any(|it| roundabouts.is_entered([entry, *it])));
        assert!(!roundabouts.is_entered([roundabout.chains[0], roundabout.chains[1]]));
    }

    #[test]
    fn neither_a_junction_nor_a_block_is_a_ring() {
        for name in ["priority.osm", "grid.osm", "motorway_3_lanes.osm"] {
            assert!(of_map(name).1.roundabouts.is_empty(), "{name}");
        }
    }

    #[test]
    fn of_those_who_wait_for_a_ring_the_longest_waiting_goes_first() {
        let (network, mut roundabouts) = of_map("roundabout.osm");
        let entry = roundabouts.roundabouts[0].entries[0];
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
