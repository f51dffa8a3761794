//! Roundabouts: rings of lanes without lights, on which vehicles queue behind each other once round.
//!
//! A ring that is full locks: everybody waits for the room that the next takes up. So who comes from outside leaves
//! some of it free, however long it waits, and those on it can always move up.

use laneweave_network::{ChainIndex, Network, Sign};
use serde::{Deserialize, Serialize};

use crate::junction::claim::Claim;
use crate::junction::need::SPARE_ROOM;
use crate::junction::passages::Passages;
use crate::state::lane::Lane;

/// A ring is no longer than this [m] (ours; a roundabout of two lanes is some 60 m across).
const LONGEST: f64 = 200.0;
/// Share of its length that vehicles and the room between them may take up (ours: two places are left on a small
/// roundabout, so that a truck can move up, too).
const BEARABLE: f64 = 0.4;

/// The rings of a network.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Rings {
    rings: Vec<Ring>,
    /// For each chain the ring that it is part of; empty if there are none.
    of: Vec<Option<u32>>,
}

#[derive(Clone, Debug, Default, Serialize, Deserialize)]
struct Ring {
    chains: Vec<ChainIndex>,
    /// Those that lead into it from outside.
    entries: Vec<ChainIndex>,
    /// Length of its chains [m].
    length: f64,
    /// Who out of patience has waited longest to come onto it.
    claim: Option<Claim>,
}

impl Rings {
    /// The rings of `network`: chains that lead back to their starts within a short way, each with those that it is
    /// linked to.
    pub(crate) fn of(network: &Network) -> Rings {
        let chains = (0..network.chains.len() as u32).map(ChainIndex);
        let is_on_ring: Vec<bool> = chains.clone().map(|it| comes_round(network, it)).collect();
        let mut rings = Rings { rings: Vec::new(), of: vec![None; network.chains.len()] };
        for first in chains.filter(|it| is_on_ring[it.at()]) {
            if rings.of[first.at()].is_some() {
                continue;
            }
            let number = rings.rings.len() as u32;
            let (mut ring, mut open) = (Ring::default(), vec![first]);
            while let Some(chain) = open.pop() {
                if rings.of[chain.at()].replace(number).is_some() {
                    continue;
                }
                let here = network.chain(chain);
                ring.chains.push(chain);
                ring.length += here.length;
                let linked = here.following.iter().chain(&here.previous);
                open.extend(linked.filter(|it| is_on_ring[it.at()] && rings.of[it.at()].is_none()));
                ring.entries.extend(here.previous.iter().filter(|it| !is_on_ring[it.at()]));
            }
            rings.rings.push(ring);
        }
        if rings.rings.is_empty() { Rings::default() } else { rings }
    }

    /// Whether they are those of the same network, whoever waits for them.
    pub(crate) fn fits(&self, other: &Rings) -> bool {
        let alike = |(one, other): (&Ring, &Ring)| {
            one.chains == other.chains && one.entries == other.entries && one.length == other.length
        };
        self.of == other.of
            && self.rings.len() == other.rings.len()
            && self.rings.iter().zip(&other.rings).all(alike)
    }

    /// The ring that is entered from one chain to another.
    fn entered(&self, [from, to]: [ChainIndex; 2]) -> Option<u32> {
        let ring = |it: ChainIndex| self.of.get(it.at()).copied().flatten();
        ring(to).filter(|_| ring(from).is_none())
    }

    /// Whether a ring is entered from one chain to another.
    pub(crate) fn is_entered(&self, way: [ChainIndex; 2]) -> bool {
        self.entered(way).is_some()
    }

    /// Forgets who waits.
    pub(crate) fn clear_claims(&mut self) {
        self.rings.iter_mut().for_each(|it| it.claim = None);
    }

    /// Notes who waits to come from one chain to another.
    pub(crate) fn note_claim(&mut self, way: [ChainIndex; 2], claim: Claim) {
        if let Some(number) = self.entered(way) {
            let noted = &mut self.rings[number as usize].claim;
            *noted = Some(noted.map_or(claim, |it| it.min(claim)));
        }
    }

    /// Whether a ring between `from` and `refuge` would be full with who claims and needs `needed` [m] there, or
    /// somebody else comes first.
    pub(crate) fn is_closed(
        &self,
        passages: &Passages,
        lanes: &[Lane],
        way: [ChainIndex; 2],
        claim: Claim,
        needed: f64,
    ) -> bool {
        let Some(number) = self.entered(way) else { return false };
        let ring = &self.rings[number as usize];
        if ring.claim.is_some_and(|first| first < claim) {
            return true;
        }
        let taken = ring.taken(passages, lanes);
        taken > 0.0 && taken + needed > BEARABLE * ring.length
    }
}

impl Ring {
    /// What those on it, and those who may come onto it, take up [m].
    fn taken(&self, passages: &Passages, lanes: &[Lane]) -> f64 {
        let room = |length: f32| f64::from(length) + SPARE_ROOM;
        let here = self.chains.iter().flat_map(|it| lanes[it.at()].motions());
        let coming = self.entries.iter().flat_map(|it| {
            let lane = &lanes[it.at()];
            let all = lane.motions().iter().zip(lane.minds()).rev();
            let coming = all.take_while(|(it, mind)| passages.of(mind.passage, it.id).is_some());
            coming.map(|(it, _)| it)
        });
        here.chain(coming).map(|it| room(it.length)).sum()
    }
}

/// Whether a chain leads back to its start without a light within the length of a ring.
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
    use laneweave_maps::generate::own_maps;
    use laneweave_maps::regulations;

    use super::*;

    fn of_map(name: &str) -> (Network, Rings) {
        let (_, drawing) = own_maps().unwrap().into_iter().find(|it| it.0 == name).unwrap();
        let map = drawing.build().unwrap();
        let rules = regulations(&map);
        let network = map.network.regulated(&rules);
        let rings = Rings::of(&network);
        (network, rings)
    }

    #[test]
    fn a_roundabout_is_one_ring_with_an_entry_at_each_arm() {
        let (network, rings) = of_map("roundabout.osm");
        let [ring] = &rings.rings[..] else { panic!("{} rings", rings.rings.len()) };
        assert_eq!(ring.entries.len(), network.entrances.len());
        assert!((60.0..LONGEST).contains(&ring.length), "{} m", ring.length);
        let entry = ring.entries[0];
        assert!(network.chain(entry).following.iter().any(|it| rings.is_entered([entry, *it])));
        assert!(!rings.is_entered([ring.chains[0], ring.chains[1]]));
    }

    #[test]
    fn neither_a_junction_nor_a_block_is_a_ring() {
        for name in ["priority.osm", "grid.osm", "motorway_3_lanes.osm"] {
            assert!(of_map(name).1.rings.is_empty(), "{name}");
        }
    }

    #[test]
    fn of_those_who_wait_for_a_ring_the_longest_waiting_goes_first() {
        let (network, mut rings) = of_map("roundabout.osm");
        let entry = rings.rings[0].entries[0];
        let onto = network.chain(entry).following.iter().find(|it| rings.is_entered([entry, **it])).unwrap();
        let way = [entry, *onto];
        let (passages, lanes) = (Passages::new(&network), vec![Lane::default(); network.chains.len()]);
        let claim = |since, id| Claim { is_patient: false, since, id, is_long: false };
        assert!(!rings.is_closed(&passages, &lanes, way, claim(7, 1), 6.5));
        rings.note_claim(way, claim(5, 2));
        assert!(rings.is_closed(&passages, &lanes, way, claim(7, 1), 6.5));
        assert!(!rings.is_closed(&passages, &lanes, way, claim(5, 2), 6.5));
        rings.clear_claims();
        assert!(!rings.is_closed(&passages, &lanes, way, claim(7, 1), 6.5));
    }
}
