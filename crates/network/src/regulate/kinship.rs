//! How chains near each other are related: one after the other, forking off together, leading into one.

use super::contact::{LONG_VEHICLE_WIDTH, LONGEST_VEHICLE};
use super::fork::Fork;
use crate::chain::{ChainIndex, Position};
use crate::lanelet::Side;
use crate::network::Network;

/// How far relations are followed along chains [m].
const NEAR: f64 = 40.0;
/// Paths whose lengths differ by at most this belong together [m].
const SAME: f64 = 4.0;
/// Places of a path this close behind each other are no conflict, whatever the shape of the path [m].
const BEHIND: f64 = 15.0;
/// Before the place where a lane ends for long vehicles these need so much road to leave it [m], ours: two and a half
/// of their lengths.
pub(super) const TO_LEAVE: f64 = 30.0;

/// Paths lead in one direction if the cosine of the angle between their headings is at least this: 60°. Ours.
const ONE_DIRECTION: f64 = 0.5;

/// Why two chains are close to each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Meeting {
    /// They lead into one, from these stations on.
    Merges([f64; 2]),
    /// They come from one place at the edge of the map, or lead to one.
    Shares,
    /// None of these.
    Crosses,
}

/// The related chains of each chain.
pub(super) struct Kinship<'a> {
    network: &'a Network,
    /// Chains that lead to it, with the distance from their ends to its start [m].
    ancestors: Vec<Vec<(ChainIndex, f64)>>,
    /// Chains that it leads to, with the distance from its end to their starts [m].
    descendants: Vec<Vec<(ChainIndex, f64)>>,
}

impl<'a> Kinship<'a> {
    pub(super) fn of(network: &'a Network) -> Kinship<'a> {
        let all = || (0..network.chains.len()).map(|it| ChainIndex(it as u32));
        let back = |it: ChainIndex| &network.chain(it).previous[..];
        let forward = |it: ChainIndex| &network.chain(it).following[..];
        Kinship {
            network,
            ancestors: all().map(|it| within_reach(network, it, back)).collect(),
            descendants: all().map(|it| within_reach(network, it, forward)).collect(),
        }
    }

    /// Whether these stations of two chains lie close behind each other on one path.
    pub(super) fn is_one_behind_the_other(&self, [a, b]: [ChainIndex; 2], [at_a, at_b]: [f64; 2]) -> bool {
        let is_behind = |from: ChainIndex, at_from: f64, to: ChainIndex, at_to: f64| {
            let left = self.network.chain(from).length - at_from;
            let ways = self.descendants[from.at()].iter().filter(|it| it.0 == to);
            ways.map(|(_, between)| left + between + at_to).any(|way| way < BEHIND)
        };
        is_behind(a, at_a, b, at_b) || is_behind(b, at_b, a, at_a)
    }

    /// Whether lanes may be changed between these stations of two chains, at one of which a lane that begins or ends
    /// beside the other opens or narrows, and is narrower than a long vehicle somewhere along one, or has to be left by
    /// long vehicles.
    pub(super) fn is_left_beside(&self, [a, b]: [ChainIndex; 2], [at_a, at_b]: [f64; 2]) -> bool {
        let chain = |it: ChainIndex| self.network.chain(it);
        // Contacts are between the middles of vehicles.
        let is_narrow = |it: ChainIndex, at: f64| {
            [-0.5, 0.0, 0.5].iter().any(|part| {
                let x = (at + part * LONGEST_VEHICLE).clamp(0.0, chain(it).length);
                let (lanelet, along) = self.network.lanelet_at(Position::new(it, x));
                lanelet.clear_width(along) < LONG_VEHICLE_WIDTH
            })
        };
        let is_partial = |it: ChainIndex, at: f64| {
            let [from, until] = chain(it).open[1];
            let is_end = chain(it).is_lane_drop() && at > chain(it).driven_until(true) - TO_LEAVE;
            is_end || !(from + BEHIND..=until - BEHIND).contains(&at) && is_narrow(it, at)
        };
        let leads = |from: ChainIndex, at: f64, to: ChainIndex, at_there: f64| {
            let mut stretches = Side::BOTH.into_iter().flat_map(|side| chain(from).stretches(side));
            stretches.any(|it| {
                it.chain == to
                    && (it.start..=it.end).contains(&at)
                    && (it.across(at) - at_there).abs() < BEHIND
            })
        };
        (is_partial(a, at_a) || is_partial(b, at_b)) && (leads(a, at_a, b, at_b) || leads(b, at_b, a, at_a))
    }

    /// The forks behind two chains from which on these have not parted yet before the stretches that begin at `starts`.
    pub(super) fn forks(&self, [a, b]: [ChainIndex; 2], starts: [f64; 2]) -> Vec<Fork> {
        if starts[0].min(starts[1]) >= SAME {
            return Vec::new();
        }
        common(&self.ancestors[a.at()], &self.ancestors[b.at()])
            .filter(|(at, _)| self.network.chain(*at).following.len() > 1)
            .filter(|(_, [to_a, to_b])| (to_a + starts[0] - to_b - starts[1]).abs() < SAME)
            .filter_map(|(at, distances)| Fork::between(self.network, at, [a, b], distances))
            .collect()
    }

    /// Whether all who come to two chains come from the fork: no other lane joins in between.
    pub(super) fn come_only_from(&self, fork: &Fork, pair: [ChainIndex; 2]) -> bool {
        pair.iter().all(|it| self.comes_only_from(fork.at, *it))
    }

    /// How two chains meet on the stretches from `starts` to `ends`.
    pub(super) fn meeting(&self, [a, b]: [ChainIndex; 2], starts: [f64; 2], ends: [f64; 2]) -> Meeting {
        if self.fork_at_the_edge([a, b], starts) || self.meet_at_the_edge([a, b], ends) {
            return Meeting::Shares;
        }
        let [length_a, length_b] = [a, b].map(|it| self.network.chain(it).length);
        let merge = common(&self.descendants[a.at()], &self.descendants[b.at()])
            .map(|(_, [from_a, from_b])| [length_a + from_a, length_b + from_b])
            .find(|[at_a, at_b]| (at_a - ends[0] - at_b + ends[1]).abs() < SAME);
        if let Some(stations) = merge
            && (length_a - ends[0]).min(length_b - ends[1]) < SAME
        {
            return Meeting::Merges(stations);
        }
        Meeting::Crosses
    }

    /// Whether all who come to `chain` come from its ancestor `kin`: no other lane joins in between.
    fn comes_only_from(&self, kin: ChainIndex, chain: ChainIndex) -> bool {
        let mut known = vec![chain];
        let mut at = 0;
        while let Some(chain) = known.get(at) {
            let previous = &self.network.chain(*chain).previous;
            if previous.is_empty() || !previous.iter().all(|it| self.is_from(kin, *it)) {
                return false;
            }
            let further: Vec<ChainIndex> =
                previous.iter().filter(|it| **it != kin && !known.contains(it)).copied().collect();
            known.extend(further);
            at += 1;
        }
        true
    }

    /// Whether `chain` is `kin`, or `kin` is one of its ancestors.
    fn is_from(&self, kin: ChainIndex, chain: ChainIndex) -> bool {
        chain == kin || self.ancestors[chain.at()].iter().any(|it| it.0 == kin)
    }

    /// Whether two chains begin at one place at the edge of the map, and in one direction.
    fn fork_at_the_edge(&self, pair: [ChainIndex; 2], starts: [f64; 2]) -> bool {
        let chains = pair.map(|it| self.network.chain(it));
        let [one, other] = chains.map(|it| it.centre.heading(0.0));
        chains.iter().all(|it| it.previous.is_empty())
            && starts[0].max(starts[1]) < SAME
            && (one - other).cos() > ONE_DIRECTION
    }

    /// Whether two chains end at one place at the edge of the map, and in one direction.
    fn meet_at_the_edge(&self, pair: [ChainIndex; 2], ends: [f64; 2]) -> bool {
        let chains = pair.map(|it| self.network.chain(it));
        let [one, other] = chains.map(|it| it.centre.heading(it.length));
        chains.iter().all(|it| it.following.is_empty())
            && chains.iter().zip(ends).all(|(it, end)| it.length - end < SAME)
            && (one - other).cos() > ONE_DIRECTION
    }

    /// Chains that lead to `chain`, within 40 m, with the distance from their ends to its start [m].
    pub(super) fn ancestors(&self, chain: ChainIndex) -> &[(ChainIndex, f64)] {
        &self.ancestors[chain.at()]
    }
}

/// Chains that can be reached over `next` within [`NEAR`], with the distance in between [m].
fn within_reach<'n>(
    network: &'n Network,
    from: ChainIndex,
    next: impl Fn(ChainIndex) -> &'n [ChainIndex],
) -> Vec<(ChainIndex, f64)> {
    let mut found: Vec<(ChainIndex, f64)> = next(from).iter().map(|it| (*it, 0.0)).collect();
    let mut at = 0;
    while at < found.len() {
        let (chain, distance) = found[at];
        at += 1;
        let beyond = distance + network.chain(chain).length;
        if beyond < NEAR {
            for further in next(chain) {
                if !found.iter().any(|it| it.0 == *further) {
                    found.push((*further, beyond));
                }
            }
        }
    }
    found
}

/// The related chains that two chains have in common, with the distances to them.
fn common(a: &[(ChainIndex, f64)], b: &[(ChainIndex, f64)]) -> impl Iterator<Item = (ChainIndex, [f64; 2])> {
    a.iter().flat_map(move |(kin, from_a)| {
        b.iter().filter(move |it| it.0 == *kin).map(move |(_, from_b)| (*kin, [*from_a, *from_b]))
    })
}
