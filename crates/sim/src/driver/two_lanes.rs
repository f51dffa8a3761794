//! Drivers who follow leaders in two lanes: their vehicle changes lanes, or they may not pass a vehicle in the
//! overtaking lane. Usually they react to nothing else, and need no closer look.

use crate::driver::accelerate::{OpenRoad, behind};
use crate::driver::fall_in::staying_behind;
use crate::driver::steering::creeps_up_to;
use crate::junction::reservations::NO_RESERVATION;
use crate::state::clock::Clock;
use crate::state::lane::{DriverState, Kinematics, LaneChangeState};
use crate::view::scene::{Scene, Spot};

/// The acceleration of a vehicle in a lane change whose driver reacts only to the leaders in both lanes: the lower one
/// [m/s²]. `road` is the lane of the entry at `spot`. `None` if the driver reacts to more.
#[inline(never)]
pub(crate) fn behind_both(scene: &Scene, clock: Clock, spot: Spot, road: &OpenRoad) -> Option<f64> {
    let lane = &scene.lanes[spot.chain.at()];
    let driver = &lane.drivers()[spot.index];
    if !driver.only_follows_both() {
        return None;
    }
    let counterpart = lane.lane_change_states()[spot.index].counterpart?;
    let other_lane = &scene.lanes[counterpart.chain.at()];
    let other = other_lane.ahead_of(counterpart.x).checked_sub(1)?;
    let [here, there] = [&lane.motions()[spot.index..], &other_lane.motions()[other..]];
    let is_it = there[0].id == here[0].id && !other_lane.is_obstacle(other);
    // Both entries have to choose the same, so neither may react to more.
    if !is_it || !other_lane.drivers()[other].only_follows_both() {
        return None;
    }
    let other_road = OpenRoad::on(scene, counterpart.chain);
    let here = follow(scene, clock, driver, here, road)?;
    let there = follow(scene, clock, driver, there, &other_road)?;
    Some(if there < here { there } else { here })
}

/// The acceleration of a driver who reacts only to its leader in the lane `road`, and to the one in the overtaking lane
/// that it may not pass: the lower one [m/s²]. `None` if the driver reacts to more.
#[inline(never)]
pub(crate) fn behind_offside(scene: &Scene, clock: Clock, spot: Spot, road: &OpenRoad) -> Option<f64> {
    let lane = &scene.lanes[spot.chain.at()];
    let (driver, lane_change) = (&lane.drivers()[spot.index], &lane.lane_change_states()[spot.index]);
    if !driver.keeps_lane_calmly() || !minds_only_offside(lane_change) {
        return None;
    }
    let here = follow(scene, clock, driver, &lane.motions()[spot.index..], road)?;
    Some(staying_behind(scene, spot).map_or(here, |it| if it < here { it } else { here }))
}

/// Whether all that a driver may have to react to, beside its leader, is the leader in the overtaking lane.
#[inline]
fn minds_only_offside(lane_change: &LaneChangeState) -> bool {
    lane_change.minds_offside
        && lane_change.lets_in.0 == f32::INFINITY
        && lane_change.last_place == f64::INFINITY
        && lane_change.reservation == NO_RESERVATION
}

/// The acceleration [m/s²] of a driver in one lane, where its vehicle is the first one of `motions`, and its leader the
/// next one.
fn follow(
    scene: &Scene,
    clock: Clock,
    driver: &DriverState,
    motions: &[Kinematics],
    road: &OpenRoad,
) -> Option<f64> {
    let [motion, leader, ..] = motions else { return None };
    let ahead = leader.ahead(leader.rear() - motion.x);
    let creeps = creeps_up_to(motion, driver, ahead);
    let is_leader = leader.id != motion.id && !creeps && road.reaches(motion, leader.x);
    if is_leader { behind(scene, motion, driver, leader, clock.dt) } else { None }
}
