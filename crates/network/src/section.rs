//! Sections: lanelets side by side as one piece of road, and the roads that continue from it.

use std::collections::BTreeMap;

use crate::geometry::turn;
use crate::lanelet::{Lanelet, LaneletIndex};
use crate::network::Network;

/// The sections of a network.
#[derive(Clone, Debug)]
pub struct Sections {
    /// For each lanelet its section.
    of: Vec<usize>,
    sections: Vec<Section>,
}

/// Lanelets side by side in one direction of travel, whether a change between them is allowed or not.
#[derive(Clone, Debug)]
pub struct Section {
    /// Its lanelets in the order of the map.
    pub lanelets: Vec<LaneletIndex>,
    /// The sections that continue it, in the order of the map.
    pub following: Vec<Branch>,
}

/// A continuation of a section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Branch {
    /// The section that it leads to.
    pub section: usize,
    /// Number of lanes.
    pub lanes: usize,
    /// Its first lanelet, of those in the order of the map.
    pub lanelet: LaneletIndex,
    /// Change of its direction at the end of the junction, counter-clockwise [rad].
    pub angle: f64,
}

impl Sections {
    /// The sections of `network`.
    pub fn of(network: &Network) -> Sections {
        let lanelets = &network.lanelets;
        let of = numbers(lanelets);
        let count = of.iter().max().map_or(0, |it| it + 1);
        let mut sections = vec![Section { lanelets: Vec::new(), following: Vec::new() }; count];
        for (number, index) in of.iter().zip(0..) {
            sections[*number].lanelets.push(LaneletIndex(index));
        }
        let ways_in = ways_in(lanelets);
        for section in &mut sections {
            let mut branches: BTreeMap<usize, Branch> = BTreeMap::new();
            for (from, to) in section.lanelets.iter().flat_map(|it| links(lanelets, *it)) {
                let section = of[to.at()];
                let new =
                    || Branch { section, lanes: 0, lanelet: to, angle: angle(lanelets, &ways_in, from, to) };
                branches.entry(section).or_insert_with(new).lanes += 1;
            }
            section.following = branches.into_values().collect();
        }
        Sections { of, sections }
    }

    /// All sections.
    pub fn all(&self) -> &[Section] {
        &self.sections
    }

    /// The number of a lanelet's section in the list of all.
    pub fn holding(&self, lanelet: LaneletIndex) -> usize {
        self.of[lanelet.at()]
    }
}

fn links(lanelets: &[Lanelet], from: LaneletIndex) -> impl Iterator<Item = (LaneletIndex, LaneletIndex)> {
    lanelets[from.at()].following.iter().map(move |to| (from, *to))
}

/// For each lanelet the number of its section, in the order of their first lanelets.
fn numbers(lanelets: &[Lanelet]) -> Vec<usize> {
    let mut beside = vec![Vec::new(); lanelets.len()];
    for (here, lanelet) in lanelets.iter().enumerate() {
        let Lanelet { left, right, adjacent_left, adjacent_right, .. } = lanelet;
        for there in [left, right, adjacent_left, adjacent_right].into_iter().flatten() {
            beside[here].push(there.at());
            beside[there.at()].push(here);
        }
    }
    let mut numbers = vec![usize::MAX; lanelets.len()];
    let mut count = 0;
    for first in 0..lanelets.len() {
        if numbers[first] != usize::MAX {
            continue;
        }
        let mut open = vec![first];
        while let Some(it) = open.pop() {
            if std::mem::replace(&mut numbers[it], count) == usize::MAX {
                open.extend(beside[it].iter().filter(|there| numbers[**there] == usize::MAX));
            }
        }
        count += 1;
    }
    numbers
}

/// How many lanelets lead into each lanelet.
fn ways_in(lanelets: &[Lanelet]) -> Vec<usize> {
    let mut ways_in = vec![0; lanelets.len()];
    lanelets.iter().flat_map(|it| &it.following).for_each(|it| ways_in[it.at()] += 1);
    ways_in
}

/// Change of the direction from the end of `from` along `to` and its single continuation, until this meets others or
/// for 30 m, ours [rad].
fn angle(lanelets: &[Lanelet], ways_in: &[usize], from: LaneletIndex, to: LaneletIndex) -> f64 {
    const JUNCTION: f64 = 30.0;
    let before = &lanelets[from.at()].centre;
    let (mut at, mut left) = (to, JUNCTION);
    let after = loop {
        let it = &lanelets[at.at()];
        match it.following[..] {
            [next] if it.length() < left && ways_in[next.at()] == 1 => {
                left -= it.length();
                at = next;
            }
            _ => break it.centre.heading(left.min(it.length())),
        }
    };
    turn(before.heading(before.length()), after)
}
