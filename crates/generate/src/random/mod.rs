//! Random maps that are difficult to drive on, although a real map could look like them.

mod alignment;
mod branch;
mod bulge;
mod dice;
mod element;
mod fork;
mod gap;
mod ground;
mod grow;
mod hazard;
mod junction;
mod lane_end;
mod merge;
mod mouth;
mod nested;
mod queue;
mod ramp;
mod ring;
mod shared;
mod stretch;
mod strip;
mod weave;

use laneweave_network::Id;
use std::collections::BTreeSet;
use std::ops::Range;

use laneweave_maps::{Drawing, Map};

pub use hazard::Hazard;

/// A map is drawn again until it has at least so many difficult elements.
const FEWEST_HAZARDS: usize = 5;
/// Minimum length of road [m].
const LEAST_LENGTH: f64 = 600.0;
/// Maximum of attempts. None of some hundred seeds needs as many.
const ATTEMPTS: u64 = 256;

/// A random map.
#[derive(Clone, Debug, PartialEq)]
pub struct RandomMap {
    /// The drawing.
    pub drawing: Drawing,
    /// Its elements, in the order in which they were drawn.
    pub elements: Vec<Element>,
    /// Length of its roads, whatever their lanes [m].
    pub length_m: f64,
}

/// A part of a random map. Lanelets of different elements have no common area.
#[derive(Clone, Debug, PartialEq)]
pub struct Element {
    /// Its difficulty, if it has one.
    pub hazard: Option<Hazard>,
    /// Ids of its lanelets.
    pub lanelets: Range<i64>,
}

impl Element {
    /// Whether a lanelet with this id is part of it.
    pub fn has(&self, lanelet: Id) -> bool {
        lanelet.number().is_some_and(|it| self.lanelets.contains(&it))
    }
}

impl RandomMap {
    /// Its difficulties, each kind once, in the order of [`Hazard::ALL`].
    pub fn hazards(&self) -> BTreeSet<Hazard> {
        self.elements.iter().filter_map(|it| it.hazard).collect()
    }

    /// Whether it has so many difficult elements, is so long [m], and can be entered.
    fn is_enough(&self, fewest: usize, least_length: f64) -> bool {
        let hazards = self.elements.iter().filter(|it| it.hazard.is_some()).count();
        hazards >= fewest && self.length_m >= least_length && self.has_clear_entrance()
    }

    /// Whether a vehicle can enter it at a place where the other direction does not need the same area.
    fn has_clear_entrance(&self) -> bool {
        let Ok(Map { network, .. }) = self.drawing.build() else { return false };
        let is_shared = |id: Id| {
            let mut elements = self.elements.iter();
            let hazard = elements.find(|it| it.has(id)).and_then(|it| it.hazard);
            matches!(hazard, Some(Hazard::OneLaneStreet | Hazard::PartialOverlap))
        };
        let chains = network.entrances.iter().flat_map(|it| &it.chains);
        let lanelets = chains.filter_map(|it| network.chain(*it).lanelets.first());
        lanelets.map(|it| network.lanelets[it.at()].id).any(|it| !is_shared(it))
    }
}

/// Draws the random map of a seed, the same one on every machine. Traffic drives on the right.
pub fn random(seed: u64) -> RandomMap {
    let mut maps = attempts(seed, None);
    maps.find(|it| it.is_enough(FEWEST_HAZARDS, LEAST_LENGTH)).unwrap_or_else(|| grow::grow(seed, 0, None))
}

/// Draws the random map of a seed with no other difficulty than `hazard`, as often as there is room for it.
pub fn random_with(seed: u64, hazard: Hazard) -> RandomMap {
    let only = Some(hazard);
    attempts(seed, only).find(|it| it.is_enough(1, 0.0)).unwrap_or_else(|| grow::grow(seed, 0, only))
}

fn attempts(seed: u64, only: Option<Hazard>) -> impl Iterator<Item = RandomMap> {
    (0..ATTEMPTS).map(move |attempt| grow::grow(seed, attempt, only))
}
