//! How far ahead of a driver a recording shows the road: who is beyond is not seen.

use laneweave_network::{ChainIndex, Network};
use laneweave_recordings::Matched;

/// What a recording shows of each lane.
pub(crate) struct InView<'a> {
    network: &'a Network,
    /// For each chain the furthest place at which a vehicle was seen [m]; none where nobody was.
    furthest: Vec<Option<f64>>,
}

/// A lane is seen to its end if a vehicle was seen so near to it [m] (ours).
const NEAR_THE_END: f64 = 15.0;

impl<'a> InView<'a> {
    /// What the recording of `matched` shows.
    pub(crate) fn of(matched: &Matched<'a>) -> InView<'a> {
        let mut furthest: Vec<Option<f64>> = vec![None; matched.network.chains.len()];
        for place in matched.places.iter().flatten().flatten() {
            let start = matched.network.start_of(place.lanelet);
            let seen = &mut furthest[start.chain.at()];
            let x = start.x + place.station;
            *seen = Some(seen.map_or(x, |it| it.max(x)));
        }
        InView { network: matched.network, furthest }
    }

    /// Whether the lane is in view for `distance` [m] from `x` [m] on `chain` on, and on at least one branch of each
    /// fork. Beyond the end of the road nothing is.
    pub(crate) fn shows(&self, chain: ChainIndex, x: f64, distance: f64) -> bool {
        let lane = self.network.chain(chain);
        let Some(furthest) = self.furthest[chain.at()] else { return false };
        if furthest - x >= distance {
            return true;
        }
        if furthest < lane.length - NEAR_THE_END {
            return false;
        }
        let left = distance - (lane.length - x);
        // Chains that follow one another in a circle are shorter together with each step.
        left <= 0.0 || (lane.length > 0.0 && lane.following.iter().any(|it| self.shows(*it, 0.0, left)))
    }
}
