//! From rules to junctions: where chains conflict, which has priority, where drivers stop, and what that leaves for
//! lane changes and entrances.
//!
//! `contact.rs` finds exactly where vehicles would touch. From that follow where lanes that end beside others are left
//! (`ends.rs`), the conflict zones (`zones.rs`), how far the branches of forks are in each other's way (`fork.rs`), who
//! has priority in each (`precedence.rs`), also in roundabouts (`ring.rs`), where drivers stop (`places.rs`), and where
//! they turn (`turning.rs`). The programs of lights are in `signals`. Who holds which zone is the simulator's.

mod contact;
mod ends;
mod fork;
mod kinship;
mod nearby;
mod places;
mod precedence;
mod ring;
mod turning;
mod zones;

use crate::chain::{Beside, ChainIndex};
use crate::junction::{Crossing, Junctions, OnChain, Reach, Regulations, ZoneIndex};
use crate::lanelet::Side;
use crate::network::Network;
use crate::signals;
use contact::Contacts;
use fork::Parting;
use kinship::Kinship;
use ring::Ring;

/// On this length of a lane before a junction a change is too short [m]. Ours.
const ROOM_TO_CHANGE: f64 = 15.0;
/// Length of a lane outside of junctions where vehicles enter the map [m]: enough for the longest vehicle. Ours.
const ROOM_TO_ENTER: f64 = 15.0;

impl Network {
    /// The same network with its junctions, at which `regulations` hold.
    pub fn regulated(mut self, regulations: &Regulations) -> Network {
        let contacts = contact::contacts(&self);
        ends::shorten(&mut self, &contacts.of_pairs);
        let (junctions, partings) = junctions(&self, &contacts, regulations);
        self.junctions = junctions;
        fork::note_branches(&mut self, &partings);
        // Lanes that share a conflict area with others at the edge of the map get a conflict zone: vehicles enter in
        // turns.
        let is_at_the_edge = |crossing: Crossing| {
            let Reach { chain, start, end } = *self.junctions.other_side(crossing);
            let chain = self.chain(chain);
            let begins = chain.previous.is_empty() && start < ROOM_TO_ENTER;
            let ends = chain.following.is_empty() && end > chain.length - ROOM_TO_ENTER;
            begins || ends
        };
        let is_free = |chain: &ChainIndex| {
            let is_open = self.chain(*chain).is_open(0.0, false);
            let near = self
                .junctions
                .for_cars(*chain)
                .take_while(|it| self.junctions.reach(*it).start < ROOM_TO_ENTER);
            is_open && near.into_iter().all(is_at_the_edge)
        };
        let mut entrances = self.entrances.clone();
        entrances.iter_mut().for_each(|it| it.chains.retain(is_free));
        entrances.retain(|it| !it.chains.is_empty());
        self.entrances = entrances;
        for index in 0..self.chains.len() {
            for side in Side::BOTH {
                let stretches = self.outside_of_junctions(ChainIndex(index as u32), side);
                match side {
                    Side::Left => self.chains[index].left = stretches,
                    Side::Right => self.chains[index].right = stretches,
                }
            }
        }
        self
    }

    /// The stretches of a chain on which a change to `side` is allowed and can end before the next junction.
    fn outside_of_junctions(&self, index: ChainIndex, side: Side) -> Vec<Beside> {
        let mut left = Vec::new();
        let here = self.taken_on(index);
        for stretch in self.chain(index).stretches(side) {
            let there = self.taken_on(stretch.chain).into_iter();
            let there = there.map(|extent| extent.map(|station| stretch.back(station)));
            left.extend(stretch.without(here.iter().copied().chain(there).collect()));
        }
        left
    }

    /// Stretches of a chain without lane changes [m]: before and within junctions, including those right before its
    /// start, and while it is still one lane with others that fork off. Around a roundabout also those right beyond its
    /// end: drivers choose their lane there on the way in.
    fn taken_on(&self, index: ChainIndex) -> Vec<[f64; 2]> {
        let chain = self.chain(index);
        let before = chain.previous.iter().flat_map(|it| {
            let length = self.chain(*it).length;
            self.junctions.extents(*it).into_iter().map(move |extent| extent.map(|station| station - length))
        });
        let fork = (chain.fork_clearance > 0.0).then_some([0.0, chain.fork_clearance]);
        let is_round = self.junctions.is_in_roundabout(index);
        let beyond = chain.following.iter().filter(|_| is_round).flat_map(|it| {
            let extents = self.junctions.extents(*it).into_iter();
            extents.map(|extent| extent.map(|station| station + chain.length))
        });
        let junctions = self.junctions.extents(index).into_iter().chain(before).chain(beyond);
        junctions.map(|[start, end]| [start - ROOM_TO_CHANGE, end]).chain(fork).collect()
    }
}

/// The junctions of `network` with these `contacts` under `regulations`, and where branches of forks part. Lights
/// without a program get one.
fn junctions(network: &Network, contacts: &Contacts, regulations: &Regulations) -> (Junctions, Vec<Parting>) {
    let kinship = Kinship::of(network);
    let (mut zones, partings) = zones::zones(&kinship, &contacts.of_pairs);
    let rings = ring::rings(network);
    let in_ring: Vec<bool> = rings.iter().map(|it| *it != Ring::No).collect();
    precedence::settle(network, &kinship, regulations, &in_ring, &mut zones);
    let mut chains = vec![OnChain::EMPTY; network.chains.len()];
    for (zone, index) in zones.iter().zip(0..) {
        for (reach, side) in zone.sides.iter().zip(0..) {
            chains[reach.chain.at()].crossings.push(Crossing { zone: ZoneIndex(index), side });
        }
    }
    let start = |it: &Crossing| zones[it.zone.at()].sides[usize::from(it.side)].start;
    for chain in &mut chains {
        chain.crossings.sort_by(|a, b| start(a).total_cmp(&start(b)).then(a.zone.cmp(&b.zone)));
    }
    let comparisons = contacts.comparisons;
    let mut junctions = Junctions { zones, chains, comparisons, ..Junctions::default() };
    junctions.place_stops(network, regulations);
    junctions.note_places();
    junctions.look_beyond(network);
    junctions.turns = turning::turns(network, &in_ring);
    junctions.in_roundabout = rings.iter().map(|it| *it == Ring::Round).collect();
    junctions.nearby = nearby::nearby(network, &contacts.of_pairs);
    let (made, comparisons) = signals::made_plans(network, &junctions);
    junctions.comparisons += comparisons;
    junctions.follow(&made);
    junctions.made = made;
    (junctions, partings)
}
