//! Safety: not an incentive but a temporary condition. A driver who wants to change waits until the gap is
//! acceptable.
//!
//! There are two pairs: ego behind the new leader, and the new follower behind ego. The gap is accepted iff for both
//! pairs: the gap is at least s_min; the time to collision is at least T_th; the deceleration that it forces,
//! Δv²/(2s), is at most b_safe; the follower's own model demands no more than b_safe; and the follower is secure in
//! the sense of [`crate::braking`]. The time to collision alone, the paper's condition, is not enough: FVDM drivers
//! collide from gaps that it accepts.
//!
//! The critical gap to the new leader is `min_gap`, that to the new follower `min_lag_gap`. A critical gap per driver
//! that depends on the speed difference (Toledo 2003) is a lognormal one together with `closing_growth`:
//! G_cr = exp(μ + κ Δv + σz).

use serde::{Deserialize, Serialize};

use crate::braking::is_secure;
use crate::exponential::exp;
use crate::follow::Ahead;

/// Gap acceptance.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Safety {
    /// s_min, the critical lead gap [m]: the shortest gap to the new leader.
    pub min_gap: f64,
    /// The critical lag gap [m]: the shortest gap to the new follower; 0: as `min_gap`.
    pub min_lag_gap: f64,
    /// κ: growth of both critical gaps with the closing speed [s/m]; 0: none.
    pub closing_growth: f64,
    /// T_th [s]; not in the paper.
    pub min_time_to_collision: f64,
    /// b_safe [m/s²].
    pub max_deceleration: f64,
}

impl Default for Safety {
    fn default() -> Safety {
        Safety {
            min_gap: 2.0,
            min_lag_gap: 0.0,
            closing_growth: 0.0,
            min_time_to_collision: 3.0,
            max_deceleration: 4.0,
        }
    }
}

/// A follower and its leader as they would be after the change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GapPair {
    /// Net gap [m].
    pub gap: f64,
    /// The follower's speed [m/s].
    pub follower: f64,
    /// The leader's speed [m/s].
    pub leader: f64,
    /// Acceleration that the follower's own model demands at this gap [m/s²].
    pub demanded: f64,
}

/// Why a gap was not accepted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// Shorter than the least gap.
    Short,
    /// The time to collision is too short.
    TimeToCollision,
    /// It would force too hard a braking.
    Forced,
    /// The follower's model would brake too hard.
    Demanded,
    /// If the leader brakes as hard as it can, the follower cannot stop behind it.
    Insecure,
}

/// Time to collision [s]; infinite where the gap does not close.
pub fn time_to_collision(gap: f64, follower: f64, leader: f64) -> f64 {
    if follower > leader { gap / (follower - leader) } else { f64::INFINITY }
}

/// Δv²/(2s): deceleration [m/s²] that avoids the collision; 0 where the gap does not close.
pub fn deceleration_to_avoid(gap: f64, follower: f64, leader: f64) -> f64 {
    let closing = closing_speed(follower, leader);
    if closing == 0.0 { 0.0 } else { closing * closing / (2.0 * gap) }
}

/// Speed [m/s] at which the gap closes; 0 where it does not. NaN stays NaN.
fn closing_speed(follower: f64, leader: f64) -> f64 {
    if follower <= leader { 0.0 } else { follower - leader }
}

impl Safety {
    /// What is accepted of the new follower: the critical lag gap is in the place of the critical lead gap.
    #[inline]
    pub fn of_follower(&self) -> Safety {
        Safety { min_gap: if self.min_lag_gap > 0.0 { self.min_lag_gap } else { self.min_gap }, ..*self }
    }

    /// Checks whether `pair` is acceptable, with time step `dt` [s]. The limits for a pair of the new follower are
    /// those of [`Safety::of_follower`].
    ///
    /// # Errors
    /// The first condition that it does not meet.
    pub fn accept(&self, pair: GapPair, dt: f64) -> Result<(), Refusal> {
        let GapPair { gap, follower, leader, demanded } = pair;
        let closing = closing_speed(follower, leader);
        let least = if self.closing_growth == 0.0 {
            self.min_gap
        } else {
            self.min_gap * exp(self.closing_growth * closing)
        };
        let conditions = [
            (gap >= least, Refusal::Short),
            (gap >= self.min_time_to_collision * closing, Refusal::TimeToCollision),
            (deceleration_to_avoid(gap, follower, leader) <= self.max_deceleration, Refusal::Forced),
            (demanded >= -self.max_deceleration, Refusal::Demanded),
            (is_secure(follower, Ahead::steady(gap, leader), dt), Refusal::Insecure),
        ];
        conditions.into_iter().find(|(met, _)| !met).map_or(Ok(()), |(_, refusal)| Err(refusal))
    }
}
