//! How drivers come to the last place for a lane change, and wait there for a gap.

use crate::driver::gap::gap;
use crate::driver::steering;
use crate::driver::stopping::{approach, to_stop_at};
use crate::driver::window::{Window, leader_beside};
use crate::state::clock::Clock;
use crate::state::lane::Phase;
use crate::view::scene::{Scene, Spot};

/// Road kept before the end of a lane and the last place for a change [m]: a truck needs it to steer past a vehicle.
const ROOM_AT_THE_END: f64 = 16.0;
/// What is left of that road when a driver waits on it [m]: a little more than emergency braking leaves, so that it
/// stops gently.
const LEAST_ROOM: f64 = 1.2;
/// A driver who has waited this long for a gap [s], and hardly moves [m/s], uses that road.
const WAITS: f64 = 8.0;
pub(super) const HARDLY_MOVES: f64 = 3.0;
/// Who is so near to that road stops before it at that speed no more comfortably [m].
const BEFORE_IT: f64 = 3.0;
/// Drivers with a desired speed up to this stop at the last place for a change [m/s]. Faster drivers slow down to
/// half of the excess (ours: in towns drivers wait for a gap, on motorways they do not stop).
const WAITS_BELOW: f64 = 17.0;

/// Road that a driver keeps before the place where it has to have left its lane, if that is `left` ahead [m]. A driver
/// who changes uses it all. So does, but for the least room, one who waited there in vain, if only the vehicle behind
/// blocks it: of two drivers side by side who want each other's lane, the one ahead moves on, and both can go.
pub(super) fn kept_room(scene: &Scene, clock: Clock, spot: Spot, left: f64) -> f64 {
    let (driver, lane_change) = (scene.driver(spot), scene.lane_change(spot));
    let moves_up = match driver.phase {
        Phase::Changes => return steering::NEAR_THE_END,
        // It has to drive on, or it would never be back.
        Phase::Aborts => true,
        Phase::Wants => {
            let waited = clock.since(lane_change.since);
            let least = scene.style_of(driver).safety.min_gap;
            // Who moves up does not stop again for speeding up.
            let moves_up = left < ROOM_AT_THE_END + BEFORE_IT;
            waited > WAITS
                && (moves_up || scene.motion(spot).speed < HARDLY_MOVES)
                && leader_beside(scene, spot, lane_change.side).is_none_or(|it| it.gap >= least)
        }
        Phase::Cruises => false,
    };
    if moves_up { LEAST_ROOM } else { ROOM_AT_THE_END }
}

/// The part of the `kept` road that leaves a driver in the `window` [m]. In a short one it waits at the start.
pub(super) fn within_window(kept: f64, window: f64) -> f64 {
    /// It waits this far behind the start of the window [m].
    const INTO: f64 = 3.0;
    kept.min((window - INTO).max(LEAST_ROOM))
}

/// How far ahead the driver at `spot` waits for its last chance to change lanes, in this `window` [m].
pub(crate) fn place_to_wait(scene: &Scene, clock: Clock, spot: Spot, window: Option<Window>) -> f64 {
    let length = window.map_or(f64::INFINITY, |it| it.length());
    let left = scene.lane_change(spot).last_place - scene.motion(spot).x;
    left - within_window(kept_room(scene, clock, spot, left), length)
}

/// The acceleration before the last place for a change. A driver with a gap drives into a short window slowly enough
/// to change there. A driver without one stops within it, or slows down on a motorway.
pub(super) fn before_the_last_place(scene: &Scene, clock: Clock, spot: Spot) -> f64 {
    let (motion, driver, lane_change) = (scene.motion(spot), scene.driver(spot), scene.lane_change(spot));
    let manner = &scene.style_of(driver).manner;
    let window = Window::of(scene, spot);
    if let Some(window) = window.filter(|it| driver.phase == Phase::Wants && it.is_near_and_short())
        && gap(scene, spot, lane_change.side).is_some_and(|it| it.accepted(scene, spot, clock).is_ok())
    {
        let passing = window.speed_for(manner.duration(f64::from(lane_change.urgency)));
        return approach(motion.speed, window.start.max(0.0), passing);
    }
    let room = place_to_wait(scene, clock, spot, window);
    let passing = 0.5 * (f64::from(driver.desired) - WAITS_BELOW).max(0.0);
    let passing = window.map_or(passing, |it| passing.min(it.speed_for(manner.duration(1.0))));
    if passing > 0.0 && driver.desired > WAITS_BELOW as f32 {
        approach(motion.speed, room, passing)
    } else {
        to_stop_at(motion.speed, room, clock.dt)
    }
}
