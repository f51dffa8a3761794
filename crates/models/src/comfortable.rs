//! Comfortable braking: what kinematics make of a car-following model's braking, for a style that has it. Ours.
//!
//! The needed braking d is that of the constant-acceleration heuristic (Kesting, Treiber, Helbing 2010, Phil. Trans. R.
//! Soc. A 368, 4585; see [`Acc`](crate::follow::Acc)) after which the jam gap s₀ is left:
//!
//! d = v² / 2(s − s₀ + v_l²/2|a_l|)       the leader stands before the gap is gone
//!     |a_l| + Δv² Θ(Δv) / 2(s − s₀)      otherwise; |a_l| counts only where the leader brakes
//!
//! * A driver brakes no harder than 1.2 d, or than is gentle: its comfortable braking b behind a leader as fast as
//!   itself, b v_l/v behind a slower one.
//! * It brakes no later than d reaches b, so what stands is approached by kinematics from as far as it is seen.

use crate::follow::{Ahead, FollowingModel, Pace, constant_acceleration};

/// How much harder than needed a driver may brake, so that the needed braking falls during an approach (ours).
const SPARE: f64 = 1.2;
/// Braking that nobody minds [m/s²] (ours).
const UNFELT: f64 = 0.5;
/// Least room beyond the jam gap in which kinematics ask for braking [m] (ours): nearer, the model alone does.
const NEAR: f64 = 1.0;

/// The acceleration [m/s²] of a driver whose `model` wants `wish` behind `ahead`, with the `comfortable` braking
/// [m/s²] of its style; where that is 0, the model alone decides.
#[inline]
pub fn comfortably(model: &FollowingModel, comfortable: f64, pace: Pace, ahead: Ahead, wish: f64) -> f64 {
    if is_calm(pace.speed, ahead.gap, ahead.speed, wish) || comfortable == 0.0 {
        wish
    } else {
        bounded(model.jam_gap(), comfortable, pace.speed, ahead, wish)
    }
}

/// Whether no bound applies to what a driver at `speed` [m/s] wants behind a leader with `leader_speed` [m/s]: no more
/// than 0.5 m/s² of braking is needed, and it wants less than 0.5 m/s² of it.
#[inline]
pub fn is_calm(speed: f64, gap: f64, leader_speed: f64, wish: f64) -> bool {
    let closing = speed - leader_speed;
    wish >= -UNFELT && (closing <= 0.0 || closing * closing <= 2.0 * UNFELT * gap)
}

/// The same where a bound may apply, for a driver at `speed` [m/s].
#[inline(never)]
fn bounded(jam_gap: f64, comfortable: f64, speed: f64, ahead: Ahead, wish: f64) -> f64 {
    let room = ahead.gap - jam_gap;
    let gentle = if speed > ahead.speed { comfortable * ahead.speed / speed } else { comfortable };
    let hardest = (SPARE * needed(speed, ahead, room)).max(gentle).max(UNFELT);
    let steady = needed(speed, Ahead::steady(ahead.gap, ahead.speed), room);
    let latest = if steady >= comfortable && room >= NEAR { -steady } else { f64::INFINITY };
    wish.max(-hardest).min(latest)
}

/// d [m/s²] for a driver at `speed` [m/s] with `room` [m] beyond the jam gap.
fn needed(speed: f64, ahead: Ahead, room: f64) -> f64 {
    -constant_acceleration(speed, Ahead { gap: room, acceleration: ahead.acceleration.min(0.0), ..ahead })
}
