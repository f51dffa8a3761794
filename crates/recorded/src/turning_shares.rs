//! Where vehicles go, as those who came before them show: for each lanelet the shares of the destinations.
//!
//! At a time t only tracks count that ended more than a second before t: a track that was interrupted for less is one
//! track. So nothing that a recording shows after t, neither of the vehicle itself nor of any other, has an influence
//! on a destination that is drawn at t, not even whether a vehicle is seen again.

use std::collections::{BTreeSet, HashMap};

use laneweave_network::{LaneletIndex, Position};
use laneweave_recordings::Matched;
use laneweave_sim::{Destination, Navigator};

use crate::drivers::easiest;

/// A track that ended longer ago than this and a frame has ended: cleaning bridges shorter interruptions [s].
const GONE: f64 = 1.0;

/// For each lanelet the destinations of the vehicles that drove on it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TurningShares {
    /// By lanelet, in the order of time: when it is clear that a track has ended [s], and its destination.
    ends: HashMap<LaneletIndex, Vec<(f64, Destination)>>,
}

impl TurningShares {
    /// The shares of the recording of `matched`. A vehicle's destination is the exit that needs the fewest lane changes
    /// from where its track ended, and of several the one of least time.
    pub fn of(matched: &Matched<'_>, navigator: &Navigator) -> TurningShares {
        let mut shares = TurningShares::default();
        let step = matched.recording.step;
        for (track, places) in matched.recording.tracks.iter().zip(&matched.places) {
            let Some(last) = places.iter().flatten().last() else { continue };
            let Some(end) = track.states.last() else { continue };
            let Position { chain, x: start } = matched.network.start_of(last.lanelet);
            let gone = end.frame as f64 * step + GONE + step;
            let end = (gone, easiest(navigator, chain, start + last.station));
            let on: BTreeSet<LaneletIndex> = places.iter().flatten().map(|it| it.lanelet).collect();
            on.into_iter().for_each(|it| shares.ends.entry(it).or_default().push(end));
        }
        shares.ends.values_mut().for_each(|it| it.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))));
        shares
    }

    /// A destination for a driver on `lanelet` at the `time` [s]: that of one of the vehicles which drove there and
    /// have gone, or of one more that goes to the exit with the fewest lane changes from `at` (ours: so there is one at
    /// the beginning, too). `uniform` is a random number between 0 and 1.
    pub fn draw(
        &self,
        navigator: &Navigator,
        (lanelet, at): (LaneletIndex, Position),
        time: f64,
        uniform: f64,
    ) -> Destination {
        let ends = self.ends.get(&lanelet).map_or(&[][..], Vec::as_slice);
        let before = ends.partition_point(|it| it.0 < time);
        let drawn = (uniform * (before + 1) as f64) as usize;
        ends[..before].get(drawn).map_or_else(|| easiest(navigator, at.chain, at.x), |it| it.1)
    }
}
