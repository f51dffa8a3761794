//! Where a lane ends beside one that goes on.

use laneweave_network::{Chain, ChainIndex, Class, Classes};

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
    /// The classes for which it ends.
    ends_for: Classes,
    /// Start of the last window in which vehicles may leave it.
    pub(super) window: f64,
}

impl LaneEnd {
    /// The end of the lane `next`, which begins at `start`.
    #[inline(never)]
    fn of(next: &Chain, start: f64) -> LaneEnd {
        let open = [false, true].map(|is_long| start + next.driven_until(is_long));
        let window = next.last_window().map_or(f64::NEG_INFINITY, |it| start + it);
        LaneEnd { drawn: start + next.length, open, ends_for: next.ends_for, window }
    }

    /// Where the lane ends for the entry at `spot`; infinite if it goes on.
    pub(crate) fn of_entry(&self, scene: &Scene, spot: Spot) -> f64 {
        let class = scene.driver(spot).class;
        if self.ends_for.has(class) && leaves_its_lane(scene, spot) {
            self.drawn
        } else {
            self.open_for(class)
        }
    }

    /// Where it ends for `class`, or becomes too narrow for it [m]; infinite if it goes on.
    pub(crate) fn open_for(&self, class: Class) -> f64 {
        if self.ends_for.has(class) { self.open[usize::from(class.is_long())] } else { f64::INFINITY }
    }
}

/// Where the lane ends, if it does for any class.
#[inline]
pub(crate) fn lane_end(scene: &Scene, chain: ChainIndex) -> Option<LaneEnd> {
    let here = scene.network.chain(chain);
    if !here.ends_for.is_empty() {
        return Some(LaneEnd::of(here, 0.0));
    }
    let [only] = here.following[..] else { return None };
    let next = scene.network.chain(only);
    (!next.ends_for.is_empty()).then(|| LaneEnd::of(next, here.length))
}

/// Whether the vehicle's centre has left the lane, or never will be in it: then it need not react to its end.
pub(super) fn is_leaving(scene: &Scene, spot: Spot) -> bool {
    scene.driver(spot).is_shadow && leaves_its_lane(scene, spot)
}
