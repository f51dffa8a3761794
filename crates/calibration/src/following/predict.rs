//! What a car-following model predicts: a driver is simulated from where it was first seen in a stretch, behind the
//! leader as recorded.
//!
//! The step is the simulator's: the model's wish, within comfortable braking and what the vehicle can do, above all
//! the kinematic bound, and speeds that change linearly within a step.

use laneweave_models::braking::{HARDEST_BRAKING, secure_speed, stays_secure};
use laneweave_models::comfortable::comfortably;
use laneweave_models::follow::{Ahead, CarFollowing, FollowingModel, Pace};

use super::stretch::{Lead, Stretch};

/// The simulator's usual step [s].
const STEP: f64 = 0.1;

/// A driver as a prediction takes it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Follower {
    pub(super) model: FollowingModel,
    /// Its comfortable braking [m/s²], see [`laneweave_models::comfortable`].
    pub(super) comfortable: f64,
    /// Its desired speed [m/s].
    pub(super) desired: f64,
    /// What its vehicle can accelerate [m/s²].
    pub(super) strength: f64,
}

/// How far a driver came since the start of a stretch [m], and how fast it is then [m/s].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Moved {
    pub(crate) way: f64,
    pub(crate) speed: f64,
}

impl Follower {
    /// Where the driver is at each look of `stretch` after the first one.
    pub(super) fn predicted(&self, stretch: &Stretch) -> Vec<Moved> {
        let steps = (stretch.period / STEP).round().max(1.0);
        let dt = stretch.period / steps;
        let mut now = Moved { way: 0.0, speed: stretch.own[0].speed };
        let after_look = |look: usize| {
            for step in 0..steps as u32 {
                let leader = stretch.leader.get(look).zip(stretch.leader.get(look + 1));
                let ahead = leader.map(|it| between(it, f64::from(step) / steps, stretch.period));
                now = after(now, self.acceleration(now.speed, ahead.map(|it| it.nearer(now.way)), dt), dt);
            }
            now
        };
        (0..stretch.length()).map(after_look).collect()
    }

    /// What the simulator's driver would choose [m/s²].
    fn acceleration(&self, speed: f64, ahead: Option<Ahead>, dt: f64) -> f64 {
        let pace = Pace::new(speed, self.desired);
        let wish = self.model.acceleration(pace, ahead);
        let wish = ahead.map_or(wish, |it| comfortably(&self.model, self.comfortable, pace, it, wish));
        let wish = wish.min(self.strength).max(-HARDEST_BRAKING);
        let next = (speed + wish * dt).max(0.0);
        match ahead.map(|it| it.nearer(self.model.clearance())) {
            Some(clear) if !stays_secure(speed, next, clear, dt) => {
                wish.min(((secure_speed(speed, clear, dt) - speed) / dt).max(-HARDEST_BRAKING))
            }
            _ => wish,
        }
    }
}

/// The motion after a step of constant acceleration; who comes to a stop within it stays there.
fn after(now: Moved, acceleration: f64, dt: f64) -> Moved {
    let next = now.speed + acceleration * dt;
    if next >= 0.0 {
        return Moved { way: now.way + 0.5 * (now.speed + next) * dt, speed: next };
    }
    Moved { way: now.way - 0.5 * now.speed * now.speed / acceleration, speed: 0.0 }
}

/// The leader at a `share` of the `period` [s] between two looks, as seen from the start of the stretch: the cubic
/// through both places and speeds (Hermite).
fn between((from, to): (&Lead, &Lead), share: f64, period: f64) -> Ahead {
    let (moved, rest) = (to.rear - from.rear, 1.0 - share);
    let gap = from.rear
        + moved * share * share * (3.0 - 2.0 * share)
        + period * share * rest * (from.speed * rest - to.speed * share);
    let speed = 6.0 * moved / period * share * rest
        + from.speed * rest * (1.0 - 3.0 * share)
        + to.speed * share * (3.0 * share - 2.0);
    let acceleration = from.acceleration * rest + to.acceleration * share;
    Ahead { gap, speed: speed.max(0.0), acceleration }
}

#[cfg(test)]
mod tests {
    use laneweave_models::follow::IdmPlus;

    use super::*;

    fn follower(model: IdmPlus) -> Follower {
        Follower { model: FollowingModel::IdmPlus(model), comfortable: 2.0, desired: 30.0, strength: 3.0 }
    }

    /// Eight seconds from this speed on.
    fn stretch(leader: Vec<Lead>, speed: f64) -> Stretch {
        Stretch { period: 1.0, leader, own: vec![Moved { way: 0.0, speed }; 9], ..Stretch::default() }
    }

    #[test]
    fn a_free_driver_at_half_its_desired_speed_gains_what_idm_says() {
        // a (1 − 1/16) = 1.875 at first; the speed after a step of .1 s is 15.1875.
        let driver = follower(IdmPlus { acceleration: 2.0, ..IdmPlus::default() });
        assert_eq!(driver.acceleration(15.0, None, 0.1), 1.875);
        let moved = after(Moved { way: 0.0, speed: 15.0 }, 1.875, 0.1);
        assert_eq!(moved.speed, 15.1875);
        assert!((moved.way - 1.509375).abs() < 1e-12);
        // v' = 2 (1 − (v/30)⁴) from 15 on: artanh(v/30) + arctan(v/30) = 4t/30 + artanh ½ + arctan ½, which is 26.2918
        // m/s after 8 s. A step of .1 s overshoots a little.
        let reached = driver.predicted(&stretch(Vec::new(), 15.0))[7].speed;
        assert!((0.0..0.05).contains(&(reached - 26.2918)), "{reached}");
    }

    #[test]
    fn a_driver_in_equilibrium_stays_there() {
        // s₀ + vT = 3 + 10 · 1.2 behind a leader at 10 m/s.
        let lead = |second: usize| Lead { rear: 15.0 + 10.0 * second as f64, speed: 10.0, acceleration: 0.0 };
        let moved = follower(IdmPlus::default()).predicted(&stretch((0..9).map(lead).collect(), 10.0));
        for (second, it) in (1..).zip(moved) {
            assert!((it.way - 10.0 * f64::from(second)).abs() < 1e-9 && (it.speed - 10.0).abs() < 1e-9);
        }
    }

    #[test]
    fn a_leader_who_brakes_evenly_is_where_kinematics_say() {
        // From 10 m/s at −2 m/s²: after .3 s 2.91 m further at 9.4 m/s.
        let from = Lead { rear: 5.0, speed: 10.0, acceleration: -2.0 };
        let to = Lead { rear: 14.0, speed: 8.0, acceleration: -2.0 };
        let ahead = between((&from, &to), 0.3, 1.0);
        assert!((ahead.gap - 7.91).abs() < 1e-12 && (ahead.speed - 9.4).abs() < 1e-12, "{ahead:?}");
        assert_eq!(ahead.acceleration, -2.0);
    }

    #[test]
    fn who_stops_within_a_step_stays_where_it_stops() {
        assert_eq!(after(Moved { way: 1.0, speed: 0.4 }, -8.0, 0.1), Moved { way: 1.01, speed: 0.0 });
    }
}
