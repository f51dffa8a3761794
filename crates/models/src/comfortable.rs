//! Comfortable braking: what kinematics make of a car-following model's braking, for a style that has it. Ours.
//!
//! The needed braking d is the constant one after which the jam gap is left, if the leader goes on as it does now (the
//! constant-acceleration heuristic of Kesting, Treiber, Helbing 2010, Phil. Trans. R. Soc. A 368, 4585):
//!
//! d = v² / 2(s − s₀ + v_l²/2|a_l|)       the leader stands before the gap is gone
//!     |a_l| + Δv² Θ(Δv) / 2(s − s₀)      otherwise; |a_l| counts only where the leader brakes
//!
//! * A driver brakes no harder than 1.2 d, or than is gentle: its comfortable braking b behind a leader as fast as
//!   itself, b v_l/v behind a slower one.
//! * It brakes no later than d reaches b, so what stands is approached by kinematics from as far as it is seen.

use crate::follow::{Ahead, FollowingModel, Pace};

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
    let closing = pace.speed - ahead.speed;
    // Less than half of this is needed, and the model wants hardly more: no bound applies.
    let is_calm = wish >= -UNFELT && (closing <= 0.0 || closing * closing <= 2.0 * UNFELT * ahead.gap);
    if is_calm || comfortable == 0.0 {
        wish
    } else {
        bounded(model.jam_gap(), comfortable, pace.speed, ahead, wish)
    }
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
    /// A driver within the jam gap counts as having this much room [m].
    const LEAST: f64 = 0.1;
    let (room, braking, closing) = (room.max(LEAST), (-ahead.acceleration).max(0.0), speed - ahead.speed);
    if braking == 0.0 || ahead.speed * closing > 2.0 * room * braking {
        let closing = closing.max(0.0);
        braking + closing * closing / (2.0 * room)
    } else {
        speed * speed * braking / (ahead.speed * ahead.speed + 2.0 * room * braking)
    }
}
