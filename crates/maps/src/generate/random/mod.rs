//! Random maps that are hard to drive on, though somebody could have drawn them.

mod alignment;
mod branch;
mod dice;
mod element;
mod fork;
mod ground;
mod grow;
mod hazard;
mod junction;
mod lane_end;
mod merge;
mod mouth;
mod ramp;
mod ring;
mod shared;
mod stretch;
mod strip;

use std::collections::BTreeSet;
use std::ops::Range;

pub use hazard::Hazard;

use crate::drawing::Drawing;
use crate::format::Map;

/// A map is drawn anew until it has so many elements that are hard to drive on.
const FEWEST_HAZARDS: usize = 5;
/// And so much road [m].
const LEAST_LENGTH: f64 = 600.0;
/// It is drawn anew so often at most. None of some hundred seeds needs as many.
const ATTEMPTS: u64 = 64;

/// A random map.
#[derive(Clone, Debug, PartialEq)]
pub struct RandomMap {
    /// What is drawn.
    pub drawing: Drawing,
    /// What it is made of, in the order in which it was drawn.
    pub elements: Vec<Element>,
    /// How much road it has, whatever its lanes [m].
    pub length_m: f64,
}

/// A part of a random map. Lanelets of different elements share no ground.
#[derive(Clone, Debug, PartialEq)]
pub struct Element {
    /// What is hard about it, if anything is.
    pub hazard: Option<Hazard>,
    /// Ids of its lanelets.
    pub lanelets: Range<i64>,
}

impl RandomMap {
    /// What is hard about it, each kind once, in the order of [`Hazard::ALL`].
    pub fn hazards(&self) -> BTreeSet<Hazard> {
        self.elements.iter().filter_map(|it| it.hazard).collect()
    }

    fn is_enough(&self) -> bool {
        let hazards = self.elements.iter().filter(|it| it.hazard.is_some()).count();
        hazards >= FEWEST_HAZARDS && self.length_m >= LEAST_LENGTH && self.has_clear_entrance()
    }

    /// Whether somebody can come onto it where the other direction does not need the same ground.
    fn has_clear_entrance(&self) -> bool {
        let Ok(Map { network, .. }) = self.drawing.build() else { return false };
        let is_shared = |id: i64| {
            let mut elements = self.elements.iter();
            let hazard = elements.find(|it| it.lanelets.contains(&id)).and_then(|it| it.hazard);
            matches!(hazard, Some(Hazard::OneLaneStreet | Hazard::PartialOverlap))
        };
        let chains = network.entrances.iter().flat_map(|it| &it.chains);
        let lanelets = chains.filter_map(|it| network.chain(*it).lanelets.first());
        lanelets.map(|it| network.lanelets[it.at()].id).any(|it| !is_shared(it))
    }
}

/// Draws the random map of a seed, the same one on every machine. Traffic drives on the right.
pub fn random(seed: u64) -> RandomMap {
    let again = || (0..ATTEMPTS).map(|attempt| grow::grow(seed, attempt));
    again().find(RandomMap::is_enough).unwrap_or_else(|| grow::grow(seed, 0))
}
