//! How slow drivers steer in a lane change. A vehicle moves sideways only while it moves forwards, so a change has to
//! be over on the road that is left: before what stands ahead in either lane, before the end of the lane that it
//! leaves, and before the next place to stop.

use laneweave_models::Manner;
use laneweave_models::follow::Ahead;

use crate::driver::lane_end::lane_end;
use crate::driver::last_place::HARDLY_MOVES;
use crate::driver::stopping::COMFORTABLE_BRAKING;
use crate::state::clock::Clock;
use crate::state::lane::{DriverState, Kinematics, LaneChangeState, Phase};
use crate::state::standstill::{ROOM_AT_A_STOP, STANDSTILL};
use crate::view::pose::crossing;
use crate::view::scene::{Scene, Spot};

/// Drivers who steer come so near to a vehicle that stands ahead, or to the end of their lane [m], and are done a
/// little before; ours. A vehicle at an angle reaches further than along its lane.
pub(super) const NEAR_A_VEHICLE: f64 = 0.7;
pub(super) const NEAR_THE_END: f64 = 0.15;
const DONE: f64 = 0.15;
/// They steer as if this share of the change were left beside the one that is: so they are done, not nearly done; ours.
const MORE: f64 = 0.03;
/// With less road than this nobody begins to steer out of a lane [m]; ours: less than a driver at standstill leaves.
const LEAST_ROAD: f64 = 0.5;
/// What is kept of the road before the end of a lane, to begin to steer out of it [m]; ours.
const KEPT: f64 = 1.0;

/// Whether the lane of the entry at `spot` is the one that its vehicle leaves.
pub(super) fn leaves_its_lane(scene: &Scene, spot: Spot) -> bool {
    let (driver, has_crossed) = (scene.driver(spot), scene.lane_change(spot).progress >= 0.5);
    match driver.phase {
        Phase::Changes => driver.is_shadow == has_crossed,
        Phase::Aborts => driver.is_shadow,
        Phase::Cruises | Phase::Wants => false,
    }
}

/// Road that a driver needs who calls off a change, at most [m].
pub(super) fn way_back(manner: &Manner, motion: &Kinematics, lane_change: &LaneChangeState) -> f64 {
    KEPT + f64::from(lane_change.progress) * crossing(manner, motion, lane_change).least_way()
}

/// Whether a driver in a lane change does not keep its distance from its leader, which stands, but creeps up to it.
#[inline]
pub(super) fn creeps_up_to(motion: &Kinematics, driver: &DriverState, leader: Ahead) -> bool {
    driver.phase.is_between_lanes() && leader.speed < STANDSTILL && motion.speed < HARDLY_MOVES
}

/// Whether the driver at `spot`, if it is slow, has road to steer out of its lane: behind a leader that stands, and
/// before the end of the lane.
pub(super) fn has_road(scene: &Scene, spot: Spot) -> bool {
    if scene.motion(spot).speed >= HARDLY_MOVES {
        return true;
    }
    let from = scene.viewpoint(spot);
    let leader = scene.ahead(from).filter(|it| it.speed < STANDSTILL).map(|it| it.gap);
    // Before an end only half of the change has to be done.
    let closure = scene.end_of_lane_ahead(from).map(|it| 2.0 * it.way_out);
    let end = lane_end(scene, spot.chain, from.class).map(|it| 2.0 * (it.drawn - scene.motion(spot).x));
    leader.is_none_or(|it| it - NEAR_A_VEHICLE - DONE >= LEAST_ROAD)
        && [closure, end].into_iter().flatten().all(|it| it - NEAR_THE_END - DONE >= LEAST_ROAD)
}

/// What emergency braking leaves of the road before the end of a lane [m]: who stops there has still to leave it.
pub(super) fn kept_to_begin(scene: &Scene, spot: Spot) -> f64 {
    if scene.driver(spot).phase.is_between_lanes() { 0.0 } else { KEPT }
}

/// The share of its lane change that the vehicle with the entry at `spot` has to do on each metre, because of its
/// leader, of the end of this lane, and of the next place to stop; 0 if there is as much road as it likes.
pub(super) fn per_metre(scene: &Scene, spot: Spot, [leader, end, stop]: [Option<Ahead>; 3]) -> f64 {
    let (driver, lane_change) = (scene.driver(spot), scene.lane_change(spot));
    let progress = f64::from(lane_change.progress);
    let rest = match driver.phase {
        Phase::Changes => 1.0 - progress,
        Phase::Aborts => progress,
        Phase::Cruises | Phase::Wants => return 0.0,
    };
    if scene.motion(spot).speed >= HARDLY_MOVES {
        return 0.0;
    }
    let to_cross = 0.5 - progress;
    let until = |share: f64, road: f64| (share + MORE) / (road - DONE).max(DONE);
    let standing = leader.filter(|it| it.speed < STANDSTILL).map(|it| until(rest, it.gap - NEAR_A_VEHICLE));
    let stop = stop.map(|it| until(rest, it.gap - ROOM_AT_A_STOP));
    let crosses = driver.phase == Phase::Changes && to_cross > 0.0 && leaves_its_lane(scene, spot);
    let end = end.and_then(|it| match driver.phase {
        Phase::Aborts if !driver.is_shadow => Some(until(rest, it.gap - KEPT)),
        _ => crosses.then(|| until(to_cross, it.gap - NEAR_THE_END)),
    });
    let ahead = lane_change.last_place - scene.motion(spot).x;
    let last_place =
        (crosses && !driver.is_shadow && ahead > 0.0).then(|| until(to_cross, ahead - NEAR_THE_END));
    let most = [standing, stop, end, last_place].into_iter().flatten().fold(0.0, f64::max);
    let usual = 1.0 / crossing(&scene.style_of(driver).manner, scene.motion(spot), lane_change).least_way();
    if most > usual { most } else { 0.0 }
}

/// The acceleration that brings the vehicle at `spot` to a speed at which it can do the share `per_metre` of its lane
/// change on each metre [m/s²].
pub(super) fn slowly_enough(scene: &Scene, clock: Clock, spot: Spot, per_metre: f64) -> f64 {
    if per_metre == 0.0 {
        return f64::INFINITY;
    }
    let motion = scene.motion(spot);
    let crossing = crossing(&scene.style(spot).manner, motion, scene.lane_change(spot));
    ((crossing.fastest(per_metre) - motion.speed) / clock.dt).max(-2.0 * COMFORTABLE_BRAKING)
}
