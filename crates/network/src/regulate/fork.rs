//! Where the branches of forks part: up to there, whoever takes one branch is in the way of those who take another.

use super::contact::{LONGEST_VEHICLE, SAMPLE, Touching};
use crate::chain::{Chain, ChainIndex, ForkBranch};
use crate::geometry::Point;
use crate::junction::Touch;
use crate::network::Network;

/// Chains between a fork and a place where branches have not parted yet; no junction has as many in a row.
const MOST_CHAINS: usize = 16;
/// Paths from a fork to a place where branches have not parted yet; no junction has as many.
const MOST_PATHS: usize = 64;
/// Sums of the same lengths differ by less than this [m].
const ROUNDED: f64 = 1e-6;

/// Paths at least this far from each other have parted [m]: two of the widest vehicles have room.
const APART: f64 = 2.7;
/// Distance of the places at which two paths are compared [m].
const STEP: f64 = 2.0;

/// A chain that forks, and two chains beyond, to which paths lead that have not parted.
#[derive(Clone, Debug)]
pub(super) struct Fork {
    pub(super) at: ChainIndex,
    /// From its end to the starts of the two [m].
    distances: [f64; 2],
    /// Paths to the two that have not parted before.
    paths: Vec<[Path; 2]>,
}

impl Fork {
    /// The fork at the end of the chain `at`, if paths of these lengths [m] lead from there to both chains, and have
    /// not parted.
    pub(super) fn between(
        network: &Network,
        at: ChainIndex,
        pair: [ChainIndex; 2],
        distances: [f64; 2],
    ) -> Option<Fork> {
        let [ones, others] = [0, 1].map(|side| paths(network, at, pair[side], distances[side]));
        let are_together = |[one, other]: &[&Path; 2]| {
            let shared = distances[0].min(distances[1]);
            let steps = (0..).map(|it| f64::from(it) * STEP).take_while(|it| *it < shared);
            let apart = |it: f64| one.point(network, it).distance(&other.point(network, it));
            one.first() != other.first() && steps.into_iter().all(|it| apart(it) < APART)
        };
        let all = ones.iter().flat_map(|one| others.iter().map(move |other| [one, other]));
        let paths: Vec<_> = all.filter(are_together).map(|pair| pair.map(Path::clone)).collect();
        (!paths.is_empty()).then_some(Fork { at, distances, paths })
    }
}

/// Two chains that have not parted since a fork, and how far they have not.
#[derive(Clone, Debug)]
pub(super) struct Parting {
    pair: [ChainIndex; 2],
    fork: Fork,
    /// On each side the stations at which they have parted for two cars, for a car and a long vehicle, and for two long
    /// ones [m].
    ends: [[f64; 3]; 2],
}

impl Parting {
    /// The parting of two chains that touch in the contacts of `group`.
    pub(super) fn of(pair: [ChainIndex; 2], fork: Fork, group: &[Touching]) -> Parting {
        let end = |side: usize, touch: Touch| {
            let touching = group.iter().filter(|it| it.1 <= touch);
            touching.map(|it| it.0.stations[side] + SAMPLE).fold(f64::NEG_INFINITY, f64::max)
        };
        let ends = [0, 1].map(|side| [Touch::Any, Touch::OneLong, Touch::BothLong].map(|it| end(side, it)));
        Parting { pair, fork, ends }
    }
}

/// Notes at the chains of `partings` which branches they have not parted from.
pub(super) fn note_branches(network: &mut Network, partings: &[Parting]) {
    for Parting { pair, fork, ends } in partings {
        for (here, there) in [(0, 1), (1, 0)] {
            let start = fork.distances[there] - fork.distances[here];
            let branch = |paths: &[Path; 2]| ForkBranch {
                chain: pair[there],
                start,
                until: ends[there],
                over: paths[there].over.clone(),
                own_over: paths[here].over.clone(),
            };
            let found = with_chains_beyond(network, fork.paths.iter().map(branch).collect());
            let chain = &mut network.chains[pair[here].at()];
            chain.fork_clearance = chain.fork_clearance.max(ends[here][2].min(chain.length));
            found.into_iter().for_each(|it| add(chain, it));
        }
    }
}

/// The branches, and the chains beyond them on which fronts may be while rears have not parted yet.
fn with_chains_beyond(network: &Network, mut branches: Vec<ForkBranch>) -> Vec<ForkBranch> {
    let mut at = 0;
    while let Some(branch) = branches.get(at).cloned() {
        at += 1;
        let Chain { length, following, .. } = network.chain(branch.chain);
        if length - branch.until[2] < LONGEST_VEHICLE && branches.len() < MOST_PATHS {
            branches.extend(following.iter().map(|next| ForkBranch {
                chain: *next,
                start: branch.start + length,
                until: branch.until.map(|it| it - length),
                over: [&[branch.chain], &branch.over[..]].concat(),
                own_over: branch.own_over.clone(),
            }));
        }
    }
    branches
}

/// Chains that lead from a fork to another chain.
#[derive(Clone, Debug)]
struct Path {
    to: ChainIndex,
    /// Those before it, the nearest first; the last one is the one that forks.
    over: Vec<ChainIndex>,
}

impl Path {
    /// The first chain beyond the fork.
    fn first(&self) -> ChainIndex {
        match self.over[..] {
            [.., first, _] => first,
            _ => self.to,
        }
    }

    /// The place on it at this distance from the fork [m].
    fn point(&self, network: &Network, mut distance: f64) -> Point {
        for chain in self.over.iter().rev().skip(1).map(|it| network.chain(*it)) {
            if distance <= chain.length {
                return chain.centre.at(distance);
            }
            distance -= chain.length;
        }
        network.chain(self.to).centre.at(distance)
    }
}

/// The paths of this length [m] from the end of `fork` to the start of `to`.
fn paths(network: &Network, fork: ChainIndex, to: ChainIndex, length: f64) -> Vec<Path> {
    let mut found = Vec::new();
    let mut open: Vec<(Vec<ChainIndex>, f64)> = vec![(vec![fork], 0.0)];
    let mut at = 0;
    while let Some((over, reached)) = open.get(at).cloned() {
        at += 1;
        for next in &network.chain(over[0]).following {
            let beyond = reached + network.chain(*next).length;
            if *next == to && (reached - length).abs() < ROUNDED {
                found.push(Path { to, over: over.clone() });
            } else if beyond < length + ROUNDED && over.len() < MOST_CHAINS && open.len() < MOST_PATHS {
                open.push(([&[*next], &over[..]].concat(), beyond));
            }
        }
    }
    found
}

/// Adds a branch, or extends it if it is known over the same chains.
fn add(chain: &mut Chain, branch: ForkBranch) {
    let is_same = |it: &&mut ForkBranch| {
        it.chain == branch.chain && it.over == branch.over && it.own_over == branch.own_over
    };
    match chain.branches.iter_mut().find(is_same) {
        Some(known) => {
            known.until.iter_mut().zip(branch.until).for_each(|(known, until)| *known = known.max(until));
        }
        None => chain.branches.push(branch),
    }
}
