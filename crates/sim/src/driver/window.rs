//! Windows: the stretches on which a lane may be changed. A driver who has to change lanes in a short window looks at
//! the lane beside before it may change. So it reaches the window with a gap, and slowly enough to use it.

use laneweave_models::follow::Ahead;
use laneweave_network::{Beside, Side};

use crate::route::walk::Leg;
use crate::state::lane::DriverState;
use crate::view::scene::{Scene, Spot};

/// A window is short up to this length [m] (ours): a driver who looks for a gap only within it finds none in time.
const SHORT: f64 = 80.0;
/// A driver looks for a gap from this distance before a short window on [m] (ours).
const LOOKS_AHEAD: f64 = 60.0;

/// The stretch on which the driver at `spot` may change to `side`: the one where it is, or the short one ahead in
/// which it has to change.
// Every consideration of a lane begins with this function.
#[inline(always)]
pub(crate) fn beside<'a>(scene: &Scene<'a>, spot: Spot, side: Side) -> Option<&'a Beside> {
    let stretches = scene.network.chain(spot.chain).stretches(side);
    if stretches.is_empty() {
        return None;
    }
    let x = scene.motion(spot).x;
    let after = stretches.partition_point(|it| it.start <= x);
    match stretches[..after].last().filter(|it| x <= it.end) {
        None if scene.driver(spot).needs_full_update => coming(scene, spot, stretches),
        found => found,
    }
}

/// The leader in the lane on `side`.
pub(super) fn leader_beside(scene: &Scene, spot: Spot, side: Side) -> Option<Ahead> {
    let from = scene.viewpoint(spot);
    let beside = beside(scene, spot, side)?;
    scene.ahead(scene.viewpoint_at(from, beside.chain, beside.across(from.x)))
}

/// The next of `stretches` ahead of the driver at `spot`, if the short window in which it has to change begins with
/// it.
#[inline(never)]
fn coming<'a>(scene: &Scene, spot: Spot, stretches: &'a [Beside]) -> Option<&'a Beside> {
    let (x, last_place) = (scene.motion(spot).x, scene.lane_change(spot).last_place);
    let next = stretches.iter().find(|it| it.start > x && last_place.is_finite() && it.start < last_place)?;
    if next.start - x > LOOKS_AHEAD {
        return None;
    }
    let window = Window::of(scene, spot)?;
    let begins_it = next.start - x <= window.start + Beside::JOINED;
    (begins_it && window.is_near_and_short() && next.across(x) >= 0.0).then_some(next)
}

/// A window ahead of the driver, or around it. Distances are from its front [m].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Window {
    /// Where it begins; negative if the driver is in it.
    pub(crate) start: f64,
    /// The last place for the change.
    pub(crate) end: f64,
}

impl Window {
    /// The window in which the driver at `spot` has to change lanes, by its stored last place; `None` if that is far.
    pub(crate) fn of(scene: &Scene, spot: Spot) -> Option<Window> {
        let (x, place) = (scene.motion(spot).x, scene.lane_change(spot).last_place);
        // A short window is near; a long one so far ahead is not worth the search.
        if place - x > SHORT + LOOKS_AHEAD {
            return None;
        }
        let DriverState { goal, class, .. } = scene.driver(spot);
        let walk = scene.navigator.walk(scene.network, goal.destination(), spot.chain, 0.0).within(place);
        // For each side the window along the own chains that ends last so far.
        let mut runs = [[f64::NEG_INFINITY; 2]; 2];
        for Leg { chain, start, .. } in walk {
            let here = scene.network.chain(chain);
            // Of both sides, the one on which lanes may be changed up to that place and no further.
            let mut found: Option<[f64; 2]> = None;
            for (side, run) in Side::BOTH.into_iter().zip(&mut runs) {
                for stretch in here.stretches(side) {
                    let [from, until] = scene.network.window(here, stretch, *class).map(|it| start + it);
                    if from >= until {
                        continue;
                    }
                    *run = [if from - run[1] < Beside::JOINED { run[0] } else { from }, until];
                    let ends_sooner = found.is_none_or(|it| until < it[1]);
                    if from < place && place <= until && ends_sooner {
                        found = Some(*run);
                    }
                }
            }
            if let Some([from, _]) = found {
                return Some(Window { start: from - x, end: place - x });
            }
        }
        None
    }

    /// Its length [m].
    pub(crate) fn length(&self) -> f64 {
        self.end - self.start
    }

    /// Whether it is short, and the driver is near it or in it.
    pub(crate) fn is_near_and_short(&self) -> bool {
        self.length() < SHORT && self.start < LOOKS_AHEAD
    }

    /// The speed at which a change of this `duration` [s] fits into it [m/s].
    pub(crate) fn speed_for(&self, duration: f64) -> f64 {
        /// Largest share of the window's length that is driven before the crossing (ours).
        const SHARE: f64 = 0.7;
        2.0 * SHARE * self.length() / duration
    }
}
