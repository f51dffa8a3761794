//! Windows: the stretches on which a lane may be changed. A driver who has to change lanes in a short one looks at the lane beside before it
//! may change there, so that it comes to the window with a gap, and slowly enough to use it.

use laneweave_network::{Beside, ChainIndex, Side};

use crate::scene::{Scene, Spot};

/// A window is short up to this length [m]: a driver who looks for a gap only there finds none in time. Ours.
const SHORT: f64 = 80.0;
/// So far before a short window a driver looks for a gap [m]. Ours.
const LOOKS_AHEAD: f64 = 60.0;

/// The stretch on which the driver at `spot` may change to `side`: the one where it is, or the short one ahead in which it has to change.
#[inline]
pub(crate) fn beside<'a>(scene: &Scene<'a>, spot: Spot, side: Side) -> Option<&'a Beside> {
    let x = scene.motion(spot).x;
    let chain = scene.network.chain(spot.chain);
    match chain.beside(side, x) {
        None if scene.car(spot).heeds_more => {
            let last_place = scene.mind(spot).last_place;
            coming(chain.stretches(side), x, last_place)
        }
        found => found,
    }
}

/// The first of `stretches` beyond `x`, if it is near and short, and holds the `last_place` for a change.
#[inline(never)]
fn coming(stretches: &[Beside], x: f64, last_place: f64) -> Option<&Beside> {
    let place = stretches.iter().position(|it| it.start > x)?;
    let next = &stretches[place];
    let end =
        stretches[place..].iter().fold(next.start, |end, it| if follows(it, end) { it.end } else { end });
    let is_needed = last_place > next.start && last_place <= end;
    let is_short = end - next.start < SHORT && next.start - x < LOOKS_AHEAD;
    (is_needed && is_short && next.across(x) >= 0.0).then_some(next)
}

/// Whether a stretch goes on where another one ended, at `end` along the same chain [m].
pub(crate) fn follows(stretch: &Beside, end: f64) -> bool {
    /// Stretches that are no further apart are one window [m].
    const NEAR: f64 = 1.0;
    stretch.start - end < NEAR
}

/// A window ahead, or one that the driver is in. Distances are those from its front [m].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Window {
    /// Where it begins; negative within it.
    pub(crate) start: f64,
    /// The last place for the change.
    pub(crate) end: f64,
}

impl Window {
    /// The one in which the driver at `spot` has to change lanes by the last place that it keeps in mind; none where it is not found.
    pub(crate) fn of(scene: &Scene, spot: Spot) -> Option<Window> {
        let (x, place) = (scene.motion(spot).x, scene.mind(spot).last_place);
        let destination = scene.car(spot).goal.destination();
        let (mut chain, mut base): (ChainIndex, f64) = (spot.chain, 0.0);
        // For each side the window that ends last so far, along the own chain.
        let mut runs = [[f64::NEG_INFINITY; 2]; 2];
        loop {
            let here = scene.network.chain(chain);
            for (side, run) in Side::BOTH.into_iter().zip(&mut runs) {
                for stretch in here.stretches(side) {
                    let start = if follows(stretch, run[1] - base) { run[0] } else { base + stretch.start };
                    *run = [start, base + stretch.end];
                    if base + stretch.start < place && place <= run[1] {
                        return Some(Window { start: start - x, end: place - x });
                    }
                }
            }
            base += here.length;
            chain = scene.next(destination, chain).filter(|_| base < place)?;
        }
    }

    /// Its length [m].
    pub(crate) fn length(&self) -> f64 {
        self.end - self.start
    }

    /// Whether it is short, and the driver near it or in it.
    pub(crate) fn is_near_and_short(&self) -> bool {
        self.length() < SHORT && self.start < LOOKS_AHEAD
    }

    /// The speed at which a change of this `duration` [s] fits into it [m/s].
    pub(crate) fn speed_for(&self, duration: f64) -> f64 {
        /// Of the length for which the change is allowed, what it takes to the crossing at most. Ours.
        const SHARE: f64 = 0.7;
        2.0 * SHARE * self.length() / duration
    }
}
