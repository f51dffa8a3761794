//! Trips begin only as long as the roads of a town can bear it.
//!
//! The throughput of a town has its maximum where a small part of its roads is taken up, and falls to nothing where all
//! is (Geroliminis, Daganzo, 2008): full wait cycles of queues lock, and no driver can open them. So those whose way
//! leads over roads that lead in rings wait at the edge of the map, or at their places inside the map, while more of
//! these is taken up than the town can bear (a switch at its edge, as of Keyvan-Ekbatani and others, 2012).

use laneweave_network::{ChainIndex, Network};
use serde::{Deserialize, Serialize};

use crate::route::navigate::Navigator;
use crate::state::goal::Destination;
use crate::state::lane::Lane;

/// Share of its roads that vehicles and the least gaps before them may take up (ours, from trials on closed maps: at
/// twice that fewer arrive).
const BEARABLE: f64 = 0.10;
/// Least gap before a vehicle [m].
const LEAST_GAP: f64 = 2.0;
/// Roads that lead in rings of less than this in all are junctions, not towns [m] (ours).
const LEAST_TOWN: f64 = 500.0;

/// Whether the roads of a town are full.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct PerimeterControl {
    /// For each chain whether it is part of the town.
    is_core: Vec<bool>,
    /// Length of all its lanes [m].
    length: f64,
    is_full: bool,
}

impl PerimeterControl {
    /// Of `network`, on which there is nobody yet; `None` if its roads lead in no rings.
    pub fn new(network: &Network) -> Option<PerimeterControl> {
        let is_core = in_the_core(network);
        let town = network.chains.iter().zip(&is_core).filter(|(_, is_core)| **is_core);
        let length = town.map(|(it, _)| it.length).sum();
        (length >= LEAST_TOWN).then_some(PerimeterControl { is_core, length, is_full: false })
    }

    /// Whether it is of the same town, full or not.
    pub(crate) fn fits(&self, other: &PerimeterControl) -> bool {
        self.is_core == other.is_core && self.length == other.length
    }

    /// Whether a chain is part of the town.
    pub fn is_core(&self, chain: ChainIndex) -> bool {
        self.is_core[chain.at()]
    }

    /// What vehicles with the least gaps before them may take up of it [m].
    pub fn bearable(&self) -> f64 {
        BEARABLE * self.length
    }

    /// What a vehicle of `length` [m] takes up [m].
    pub fn taken_by(length: f64) -> f64 {
        length + LEAST_GAP
    }

    /// Measures what is taken up.
    pub(crate) fn measure(&mut self, lanes: &[Lane]) {
        let town = lanes.iter().zip(&self.is_core).filter(|(_, is_core)| **is_core);
        let motions = town.flat_map(|(lane, _)| lane.motions());
        let taken: f64 = motions.map(|it| PerimeterControl::taken_by(f64::from(it.length))).sum();
        self.is_full = taken > self.bearable();
    }

    /// Whether who would begin a trip through the town has to wait.
    #[inline]
    pub(crate) fn is_full(&self) -> bool {
        self.is_full
    }

    /// Whether the way from the start of a chain to a destination leads through the town.
    pub(crate) fn is_on_way(&self, navigator: &Navigator, from: ChainIndex, to: Destination) -> bool {
        let mut way = navigator.way(from, to);
        way.any(|it| self.is_core[it.at()])
    }
}

/// For each chain whether it is part of a ring of roads, or of a road from one to another: what is left of a network
/// without all that only leads to it, and all that only leads away.
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
