//! Where a lane ends beside one that goes on.

use laneweave_network::{Chain, ChainIndex};

use crate::driver::steering::leaves_its_lane;
use crate::view::scene::{Scene, Spot};

/// Where a lane ends beside another one, along a chain [m].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LaneEnd {
    /// Its end as drawn. A vehicle that changes lanes has to have crossed by then.
    pub(super) drawn: f64,
    /// Where it becomes too narrow for a car, and for a long vehicle. A vehicle that does not change lanes stops
    /// before.
    open: [f64; 2],
    /// Start of the last window in which vehicles may leave it.
    pub(super) window: f64,
}

impl LaneEnd {
    /// The end of the lane `next`, which begins at `start`.
    #[inline(never)]
    fn of(next: &Chain, start: f64) -> LaneEnd {
        let open = [false, true].map(|is_long| start + next.driven_until(is_long));
        let window = next.last_window().map_or(f64::NEG_INFINITY, |it| start + it);
        LaneEnd { drawn: start + next.length, open, window }
    }

    /// Where the lane ends for the entry at `spot`.
    pub(crate) fn of_entry(&self, scene: &Scene, spot: Spot) -> f64 {
        let is_long = scene.driver(spot).class.is_long();
        if leaves_its_lane(scene, spot) { self.drawn } else { self.open_for(is_long) }
    }

    /// Where it becomes too narrow for a car, or for a long vehicle [m].
    pub(crate) fn open_for(&self, is_long: bool) -> f64 {
        self.open[usize::from(is_long)]
    }
}

/// Where the lane ends, if it does.
#[inline]
pub(crate) fn lane_end(scene: &Scene, chain: ChainIndex) -> Option<LaneEnd> {
    let here = scene.network.chain(chain);
    match here.following[..] {
        [] => here.is_lane_drop.then(|| LaneEnd::of(here, 0.0)),
        [only] => {
            let next = scene.network.chain(only);
            next.is_lane_drop.then(|| LaneEnd::of(next, here.length))
        }
        _ => None,
    }
}

/// Whether the vehicle's centre has left the lane, or never will be in it: then it need not react to its end.
pub(super) fn is_leaving(scene: &Scene, spot: Spot) -> bool {
    scene.driver(spot).is_shadow && leaves_its_lane(scene, spot)
}
