//! Accelerations because of the lane beside: a driver who waits for a gap falls in with it, and who may not pass a
//! slower vehicle in the overtaking lane stays behind that.

use laneweave_models::follow::{Ahead, CarFollowing, Pace};

use crate::driver::last_place::HARDLY_MOVES;
use crate::driver::me::pace;
use crate::driver::window::{self, leader_beside};
use crate::state::lane::LaneChangeKind;
use crate::state::standstill::STANDS;
use crate::view::scene::{Scene, Spot};

/// The acceleration with which the driver at `spot`, who waits for a gap, falls in with the lane beside [m/s²]; `None`
/// if it just drives on.
///
/// Only who has to change for its route slows down for a gap that is too short (ours): others wait there for the next
/// one. Behind whoever falls back beside vehicles that follow each other closely, a queue would form.
pub(super) fn falling_in(scene: &Scene, spot: Spot, pace: Pace) -> Option<f64> {
    let (lane_change, style) = (scene.lane_change(spot), scene.style(spot));
    if f64::from(lane_change.urgency) < style.change.synchronizes_from() {
        return None;
    }
    let from = scene.viewpoint(spot);
    let beside = window::beside(scene, spot, lane_change.side)?;
    let there = scene.viewpoint_at(from, beside.chain, beside.across(from.x));
    let leader = scene.ahead(there)?;
    // Along a standing queue a driver drives on: there may be a gap ahead, and others behind want to pass.
    if pace.speed < HARDLY_MOVES && leader.speed < STANDS {
        return None;
    }
    let hardest = match lane_change.kind {
        LaneChangeKind::Route => style.manner.adjust_deceleration,
        LaneChangeKind::Discretionary | LaneChangeKind::Keeping => {
            let own = f64::from(scene.motion(spot).length);
            let behind = scene.follower(there).map_or(f64::INFINITY, |it| it.distance - own);
            if leader.gap + behind < style.safety.min_gap + style.safety.min_lag_gap {
                return None;
            }
            style.manner.free_adjust_deceleration
        }
    };
    Some(style.follow.acceleration(pace, Some(leader)).max(-hardest))
}

/// The acceleration behind the leader in the overtaking lane [m/s²], if the driver at `spot` may not pass that.
pub(super) fn staying_behind(scene: &Scene, spot: Spot) -> Option<f64> {
    let (offside, style) = (stays_behind(scene, spot)?, scene.style(spot));
    let acceleration = style.follow.acceleration(pace(scene.motion(spot), scene.driver(spot)), Some(offside));
    Some(acceleration.max(-style.manner.adjust_deceleration))
}

/// The leader in the overtaking lane, if the driver at `spot` would pass it and may not: there the law forbids to pass
/// on the slow side.
pub(crate) fn stays_behind(scene: &Scene, spot: Spot) -> Option<Ahead> {
    if !scene.lane_change(spot).minds_offside {
        return None;
    }
    let offside = leader_beside(scene, spot, scene.network.driving_side.overtaking());
    offside.filter(|it| scene.style(spot).change.stays_behind(scene.motion(spot).speed, *it))
}
