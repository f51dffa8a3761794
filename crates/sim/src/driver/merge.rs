//! A driver follows a vehicle that goes into a merge first, although that is still on another road. It stands nowhere
//! in the driver's way before the merge: until then, nobody brakes harder for it than it takes to wait there (ours).

use laneweave_models::follow::Ahead;

use crate::driver::accelerate;
use crate::driver::stopping::{COMFORTABLE_BRAKING, to_stop_at};
use crate::right_of_way::approach::FirstIntoMerge;
use crate::state::standstill::ROOM_AT_A_STOP;

/// The acceleration [m/s²] of a driver at `speed` [m/s] who would follow `first` with `following` [m/s²].
pub(super) fn follow(speed: f64, following: f64, first: &FirstIntoMerge, dt: f64) -> f64 {
    if first.stop == 0.0 {
        return following;
    }
    let waiting = to_stop_at(speed, first.stop - ROOM_AT_A_STOP, dt);
    following.max(waiting.min(-COMFORTABLE_BRAKING))
}

/// The `acceleration` [m/s²], limited by kinematics: the driver stays secure behind `first`, or can still wait before
/// the merge.
pub(super) fn bound(speed: f64, acceleration: f64, first: &FirstIntoMerge, dt: f64) -> f64 {
    let behind = accelerate::bound(speed, acceleration, Some(first.ahead), dt);
    if first.stop == 0.0 {
        return behind;
    }
    behind.max(accelerate::bound(speed, acceleration, Some(Ahead::standing(first.stop)), dt))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A vehicle that stands on the other road; as a leader it is 9 m ahead, and the merge begins after `stop` [m].
    fn standing(stop: f64) -> FirstIntoMerge {
        FirstIntoMerge { ahead: Ahead::standing(9.0), stop }
    }

    #[test]
    fn nobody_brakes_hard_for_a_vehicle_that_stands_far_before_a_merge() {
        assert_eq!(follow(8.0, -5.8, &standing(40.0), 0.1), -COMFORTABLE_BRAKING);
        assert_eq!(follow(8.0, -0.7, &standing(40.0), 0.1), -0.7);
        assert_eq!(bound(8.0, 1.0, &standing(40.0), 0.1), 1.0);
    }

    #[test]
    fn near_the_merge_a_driver_brakes_as_hard_as_it_takes_to_wait_there() {
        let near = follow(8.0, -8.0, &standing(13.0), 0.1);
        assert!((-4.0..-2.0).contains(&near), "{near}");
        assert_eq!(follow(8.0, -8.0, &standing(0.0), 0.1), -8.0);
    }

    #[test]
    fn who_can_no_longer_wait_stays_secure_behind_the_other() {
        let (late, within) = (bound(12.0, 1.0, &standing(4.0), 0.1), bound(12.0, 1.0, &standing(0.0), 0.1));
        assert!(late < -6.0, "{late}");
        assert_eq!(late, within);
    }
}
