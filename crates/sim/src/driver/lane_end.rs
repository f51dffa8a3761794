//! Where a lane ends beside one that goes on.

use laneweave_network::{Chain, ChainIndex, Class};

use crate::driver::steering::leaves_its_lane;
use crate::view::scene::{Scene, Spot};

/// Where a lane ends beside another one for a class, along a chain [m].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LaneEnd {
    /// Its end as drawn. A vehicle that changes lanes has to have crossed by then.
    pub(super) drawn: f64,
    /// Where it ends, or becomes too narrow. A vehicle that does not change lanes stops before.
    pub(super) open: f64,
    /// Start of the last window in which vehicles may leave it.
    pub(super) window: f64,
}

impl LaneEnd {
    /// The end of the lane `next` for `class`, which begins at `start`.
    #[inline(never)]
    fn of(next: &Chain, start: f64, class: Class) -> LaneEnd {
        let window = next.last_window().map_or(f64::NEG_INFINITY, |it| start + it);
        LaneEnd { drawn: start + next.length, open: start + next.driven_until(class.is_long()), window }
    }

    /// Where the lane ends for the entry at `spot`.
    pub(crate) fn of_entry(&self, scene: &Scene, spot: Spot) -> f64 {
        if leaves_its_lane(scene, spot) { self.drawn } else { self.open }
    }
}

/// Where the lane ends for `class`, if it does.
#[inline]
pub(crate) fn lane_end(scene: &Scene, chain: ChainIndex, class: Class) -> Option<LaneEnd> {
    let here = scene.network.chain(chain);
    if here.ends_for.has(class) {
        return Some(LaneEnd::of(here, 0.0, class));
    }
    let [only] = here.following[..] else { return None };
    let next = scene.network.chain(only);
    next.ends_for.has(class).then(|| LaneEnd::of(next, here.length, class))
}

/// Whether the lane ends for any class.
#[inline]
pub(super) fn ends_for_some(scene: &Scene, chain: ChainIndex) -> bool {
    let here = scene.network.chain(chain);
    !here.ends_for.is_empty()
        || matches!(here.following[..], [only] if !scene.network.chain(only).ends_for.is_empty())
}

/// Whether the vehicle's centre has left the lane, or never will be in it: then it need not react to its end.
pub(super) fn is_leaving(scene: &Scene, spot: Spot) -> bool {
    scene.driver(spot).is_shadow && leaves_its_lane(scene, spot)
}
