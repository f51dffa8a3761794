//! Perimeter control: trips begin only while the roads of a town core can serve them.
//!
//! The throughput of a town has its maximum where vehicles occupy a small part of its roads. It falls to zero where
//! they occupy all of it (Geroliminis, Daganzo, 2008): queues form full wait cycles, and no driver can resolve them. A
//! vehicle whose route leads through the town core therefore waits at the edge of the map, or at its trip end inside
//! the map, while too much of the core is occupied (a switch at its edge, as of Keyvan-Ekbatani and others, 2012).

use laneweave_network::{ChainIndex, Network};
use serde::{Deserialize, Serialize};

use crate::route::navigate::Navigator;
use crate::state::goal::Destination;
use crate::state::lane::Lane;

/// Share of the core's roads that vehicles and the minimum gaps in front of them may occupy (ours, from trials on
/// closed maps: at twice this value fewer vehicles reach their destinations).
const MOST_TAKEN: f64 = 0.10;
/// Minimum gap in front of a vehicle [m].
const LEAST_GAP: f64 = 2.0;
/// Roads in loops with less total length than this, without the lanes of roundabouts, are a junction, not a town [m]
/// (ours).
const LEAST_TOWN: f64 = 500.0;

/// Whether the roads of a town core are full.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct PerimeterControl {
    /// For each chain whether it is part of the core.
    is_core: Vec<bool>,
    /// Length of all lanes of the core [m].
    length: f64,
    is_full: bool,
}

impl PerimeterControl {
    /// Perimeter control of `network`, with no vehicle yet; `None` if its roads form no loops of enough length.
    pub fn new(network: &Network) -> Option<PerimeterControl> {
        let is_core = in_the_core(network);
        let core = (0..network.chains.len() as u32).map(ChainIndex).filter(|it| is_core[it.at()]);
        let length_of = |it: ChainIndex| network.chain(it).length;
        let roads =
            core.clone().filter(|it| !network.junctions.is_in_roundabout(*it)).map(length_of).sum::<f64>();
        let length = core.map(length_of).sum();
        (roads >= LEAST_TOWN).then_some(PerimeterControl { is_core, length, is_full: false })
    }

    /// Whether it belongs to the same core, full or not.
    pub(crate) fn fits(&self, other: &PerimeterControl) -> bool {
        self.is_core == other.is_core && self.length == other.length
    }

    /// Whether a chain is part of the core.
    pub fn is_core(&self, chain: ChainIndex) -> bool {
        self.is_core[chain.at()]
    }

    /// Length that vehicles with the minimum gaps in front of them may occupy in the core [m].
    pub fn most_taken(&self) -> f64 {
        MOST_TAKEN * self.length
    }

    /// Length that a vehicle of `length` [m] occupies [m].
    pub fn taken_by(length: f64) -> f64 {
        length + LEAST_GAP
    }

    /// Measures how much of the core is occupied.
    pub(crate) fn measure(&mut self, lanes: &[Lane]) {
        let town = lanes.iter().zip(&self.is_core).filter(|(_, is_core)| **is_core);
        let motions = town.flat_map(|(lane, _)| lane.motions());
        let taken: f64 = motions.map(|it| PerimeterControl::taken_by(f64::from(it.length))).sum();
        self.is_full = taken > self.most_taken();
    }

    /// Whether a vehicle whose trip leads through the core has to wait.
    #[inline]
    pub(crate) fn is_full(&self) -> bool {
        self.is_full
    }

    /// Whether the route from the start of a chain to a destination leads through the core.
    pub(crate) fn is_on_way(&self, navigator: &Navigator, from: ChainIndex, to: Destination) -> bool {
        let mut way = navigator.way(from, to);
        way.any(|it| self.is_core[it.at()])
    }
}

/// For each chain whether it is part of a loop of roads, or of a road between two loops. The search
/// removes again and again every chain without a previous or without a following one: roads that only lead to the
/// loops, or only away from them.
fn in_the_core(network: &Network) -> Vec<bool> {
    let chains = (0..network.chains.len() as u32).map(ChainIndex);
    let mut is_left = vec![true; network.chains.len()];
    let mut open: Vec<ChainIndex> = chains.collect();
    while let Some(chain) = open.pop() {
        let here = network.chain(chain);
        let has = |of: &[ChainIndex]| of.iter().any(|it| is_left[it.at()]);
        if is_left[chain.at()] && !(has(&here.previous) && has(&here.following)) {
            is_left[chain.at()] = false;
            open.extend(here.previous.iter().chain(&here.following));
        }
    }
    is_left
}
