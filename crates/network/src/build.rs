//! From lanelets to a network: chains, what lies beside and beyond them, entrances and exits.

use crate::id::Id;
use thiserror::Error;

use crate::bend::note_slow_places;
use crate::chain::{Beside, Chain, ChainIndex, Position, join};
use crate::class::{Class, Classes};
use crate::gate::{MINIMUM_GATE_LENGTH, gates, is_end_of_a_road, lane_drops};
use crate::junction::Junctions;
use crate::lanelet::{DrivingSide, Lanelet, LaneletIndex, Side};
use crate::law::RoadLaw;
use crate::network::Network;
use crate::width::{close_to_long, note_open};

/// Why lanelets do not make a network.
#[derive(Debug, Error, PartialEq)]
pub enum NetworkError {
    /// There are none.
    #[error("no lanelet that vehicles may use")]
    Empty,
    /// A neighbour or successor does not exist.
    #[error("lanelet {0}: refers to a lanelet that does not exist")]
    Dangling(Id),
    /// A speed limit is not a positive number.
    #[error("lanelet {id}: speed limit {limit} m/s is not a positive number")]
    SpeedLimit {
        /// The lanelet.
        id: Id,
        /// Its limit [m/s].
        limit: f64,
    },
}

/// A chain is cut at the next lanelet beyond a length between these [m]. It is long enough that the work per
/// chain does not matter, and short enough that a vehicle soon comes into one array with the others.
const CHAIN_LENGTHS: [f64; 2] = [5_000.0, 20_000.0];
/// Number of chains within these bounds, so that threads share them evenly.
const CHAINS: f64 = 32.0;

impl Network {
    /// Builds the network of `lanelets`.
    ///
    /// # Errors
    /// If there are none, or if one refers to a lanelet that does not exist or has no positive speed limit.
    pub fn new(lanelets: Vec<Lanelet>, driving_side: DrivingSide) -> Result<Network, NetworkError> {
        if lanelets.is_empty() {
            return Err(NetworkError::Empty);
        }
        for lanelet in &lanelets {
            let around = [lanelet.left, lanelet.right, lanelet.adjacent_left, lanelet.adjacent_right];
            if lanelet.following.iter().chain(around.iter().flatten()).any(|it| it.at() >= lanelets.len()) {
                return Err(NetworkError::Dangling(lanelet.id));
            }
            if !(lanelet.speed_limit.is_finite() && lanelet.speed_limit > 0.0) {
                return Err(NetworkError::SpeedLimit { id: lanelet.id, limit: lanelet.speed_limit });
            }
        }
        let previous = previous(&lanelets);
        let mut chains: Vec<Chain> =
            runs(&lanelets, &previous).into_iter().map(|run| Chain::of(&lanelets, run)).collect();
        let place = places(&chains, lanelets.len());
        link(&mut chains, &lanelets, &place);
        let chain_of: Vec<ChainIndex> = place.iter().map(|(chain, _)| *chain).collect();
        let is_long = |it: LaneletIndex| chains[chain_of[it.at()].at()].length >= MINIMUM_GATE_LENGTH;
        let is_end = |it| is_end_of_a_road(&lanelets, &previous, it);
        let entrances = gates(&lanelets, &chain_of, |it| previous[it.at()].is_empty(), is_long);
        let exits = gates(&lanelets, &chain_of, |it| lanelets[it.at()].following.is_empty(), is_end);
        let lane_drops = lane_drops(&chains, &exits);
        close_to_long(&mut chains, &lanelets, &lane_drops);
        note_ends(&mut chains, &lane_drops);
        note_slow_places(&mut chains);
        note_open(&mut chains, &lanelets, [&entrances, &exits]);
        let start =
            |(chain, number): &(ChainIndex, usize)| Position::new(*chain, chains[chain.at()].starts[*number]);
        let starts = place.iter().map(start).collect();
        let mut by_id: Vec<LaneletIndex> = (0..lanelets.len() as u32).map(LaneletIndex).collect();
        by_id.sort_by_key(|it| lanelets[it.at()].id);
        let (junctions, law) = (Junctions::default(), RoadLaw::default());
        Ok(Network {
            lanelets,
            chains,
            entrances,
            exits,
            lane_drops,
            driving_side,
            law,
            junctions,
            starts,
            by_id,
        })
    }
}

fn previous(lanelets: &[Lanelet]) -> Vec<Vec<LaneletIndex>> {
    let mut previous = vec![Vec::new(); lanelets.len()];
    for (here, lanelet) in lanelets.iter().enumerate() {
        for next in &lanelet.following {
            previous[next.at()].push(LaneletIndex(here as u32));
        }
    }
    previous
}

/// Maximal fork-free runs for the same classes, cut to the lengths above.
fn runs(lanelets: &[Lanelet], previous: &[Vec<LaneletIndex>]) -> Vec<Vec<LaneletIndex>> {
    let only_following = |it: LaneletIndex| match lanelets[it.at()].following[..] {
        [next]
            if previous[next.at()].len() == 1 && lanelets[next.at()].classes == lanelets[it.at()].classes =>
        {
            Some(next)
        }
        _ => None,
    };
    let continues_another =
        |it: LaneletIndex| previous[it.at()].first().is_some_and(|back| only_following(*back) == Some(it));
    let all = || (0..lanelets.len()).map(|i| LaneletIndex(i as u32));
    let total: f64 = lanelets.iter().map(Lanelet::length).sum();
    let [shortest, longest] = CHAIN_LENGTHS;
    let enough = (total / CHAINS).clamp(shortest, longest);
    let mut taken = vec![false; lanelets.len()];
    let mut runs = Vec::new();
    // Runs with a first lanelet, then what is left: closed loops, which begin anywhere.
    for first in all().filter(|it| !continues_another(*it)).chain(all()) {
        let mut next = (!taken[first.at()]).then_some(first);
        while next.is_some() {
            let (mut run, mut length) = (Vec::new(), 0.0);
            while let Some(lanelet) = next.filter(|it| length < enough && !taken[it.at()]) {
                taken[lanelet.at()] = true;
                length += lanelets[lanelet.at()].length();
                run.push(lanelet);
                next = only_following(lanelet);
            }
            if run.is_empty() {
                break;
            }
            runs.push(run);
        }
    }
    // In the order of the map, so that lanes side by side are stored side by side.
    runs.sort_by_key(|run| run[0]);
    runs
}

/// Notes the classes for which chains end: all, if the chain is one of `lane_drops`; or those that may use it, but
/// nothing that follows, if lane changes lead to a lane on which they go on. Without one, the road ends for them.
fn note_ends(chains: &mut [Chain], lane_drops: &[ChainIndex]) {
    let stays_behind = |chain: &Chain| {
        let may_follow = chain.following.iter().map(|it| chains[it.at()].classes).reduce(Classes::and);
        may_follow.map_or(Classes::NONE, |it| chain.classes.without(it))
    };
    let left_behind: Vec<Classes> = chains.iter().map(stays_behind).collect();
    let is_dropped = |index: usize| lane_drops.contains(&ChainIndex(index as u32));
    let ends_for = |index: usize| {
        let leaves = |class: &Class| {
            let (mut lanes, mut next) = (vec![index], 0);
            while let Some(at) = lanes.get(next).copied() {
                next += 1;
                let beside = chains[at].left.iter().chain(&chains[at].right).map(|it| it.chain.at());
                let open = beside.filter(|it| chains[*it].classes.has(*class));
                let new: Vec<usize> = open.filter(|it| !lanes.contains(it)).collect();
                lanes.extend(new);
            }
            let goes_on = |it: usize| !left_behind[it].has(*class) && !is_dropped(it);
            lanes.into_iter().any(goes_on)
        };
        left_behind[index].iter().filter(leaves).collect()
    };
    let ends_for: Vec<Classes> = (0..chains.len()).map(ends_for).collect();
    for (chain, ends_for) in chains.iter_mut().zip(ends_for) {
        chain.is_restricted = chain.classes != Classes::ALL || !ends_for.is_empty();
        chain.ends_for = ends_for;
    }
    lane_drops.iter().for_each(|it| chains[it.at()].ends_for = Classes::ALL);
}

/// For each lanelet its chain and its number there.
fn places(chains: &[Chain], lanelets: usize) -> Vec<(ChainIndex, usize)> {
    let mut place = vec![(ChainIndex(0), 0); lanelets];
    for (index, chain) in chains.iter().enumerate() {
        for (number, lanelet) in chain.lanelets.iter().enumerate() {
            place[lanelet.at()] = (ChainIndex(index as u32), number);
        }
    }
    place
}

/// Fills in what continues each chain and what lies beside it.
fn link(chains: &mut [Chain], lanelets: &[Lanelet], place: &[(ChainIndex, usize)]) {
    for index in 0..chains.len() {
        let last = chains[index].lanelets[chains[index].lanelets.len() - 1];
        let following: Vec<ChainIndex> =
            lanelets[last.at()].following.iter().map(|it| place[it.at()].0).collect();
        for next in &following {
            chains[next.at()].previous.push(ChainIndex(index as u32));
        }
        chains[index].following = following;
        for side in Side::BOTH {
            let stretches = stretches(chains, index, lanelets, place, side);
            match side {
                Side::Left => chains[index].left = stretches,
                Side::Right => chains[index].right = stretches,
            }
        }
    }
}

fn stretches(
    chains: &[Chain],
    index: usize,
    lanelets: &[Lanelet],
    place: &[(ChainIndex, usize)],
    side: Side,
) -> Vec<Beside> {
    let chain = &chains[index];
    let mut stretches = Vec::new();
    for (number, lanelet) in chain.lanelets.iter().enumerate() {
        let Some(other) = lanelets[lanelet.at()].beside(side) else { continue };
        let (there, number_there) = place[other.at()];
        let (start, end) = (chain.starts[number], chain.end_of(number));
        let other_start = chains[there.at()].starts[number_there];
        let other_end = chains[there.at()].end_of(number_there);
        let scale = (other_end - other_start) / (end - start);
        join(&mut stretches, Beside { start, end, chain: there, other_start, scale });
    }
    stretches
}

#[cfg(test)]
mod tests;
