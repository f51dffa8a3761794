//! Full Velocity Difference Model.
//!
//! Jiang, Wu, Zhu (2001), Phys. Rev. E 64, 017101, with the optimal velocity of Helbing and Tilch (1998),
//! Phys. Rev. E 58, 133, as a function of the net gap; constants from memory.
//!
//! κ [V(s) − v] + λ (v_l − v),  λ = 0 beyond the range
//!
//! * literal: V = min(V₁ + V₂ tanh(C₁ s − C₂), v₀). The paper's printed line lost the minus sign. Below 2.32 m V is
//!   negative: a follower that is too close brakes the harder for it. Only as an expected speed it is floored at 0.
//! * repaired: V never exceeds V₁ + V₂ = 14.66 m/s whatever the driver wants, so the speed and the lengths are
//!   scaled to the desired speed: V = v₀ [tanh(C₁ s·14.66/v₀ − C₂) + tanh C₂] / (1 + tanh C₂). The range of λ is
//!   a length and scales with them, and the gap is counted beyond the jam gap (both ours).

use serde::{Deserialize, Serialize};

use super::{Ahead, CarFollowing, Pace};
use crate::Reading;
use crate::exponential::exp;

/// Full Velocity Difference Model.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Fvdm {
    /// κ: sensitivity to the difference from the optimal velocity [1/s].
    pub sensitivity: f64,
    /// λ: sensitivity to the leader's relative speed [1/s].
    pub relative_sensitivity: f64,
    /// Gap beyond which the leader's relative speed does not count [m].
    pub range: f64,
    /// Gap kept at standstill, in the repaired reading [m].
    pub jam_gap: f64,
    /// Which optimal velocity.
    pub reading: Reading,
}

impl Default for Fvdm {
    fn default() -> Fvdm {
        Fvdm {
            sensitivity: 0.41,
            relative_sensitivity: 0.5,
            range: 100.0,
            jam_gap: 0.0,
            reading: Reading::Repaired,
        }
    }
}

/// V₁ [m/s].
const V1: f64 = 6.75;
/// V₂ [m/s].
const V2: f64 = 7.91;
/// C₁ [1/m].
const C1: f64 = 0.13;
/// C₂.
const C2: f64 = 1.57;
/// V₁ + V₂: the speed that the constants were found for [m/s].
const FITTED_SPEED: f64 = V1 + V2;
/// tanh C₂.
const TANH_C2: f64 = 0.917_025_761_396_608_3;

impl Fvdm {
    /// max(V(s), 0): the speed [m/s] that a driver wants at net gap `gap` [m]; the desired speed, or the literal
    /// function's maximum, where there is no leader.
    pub fn optimal_speed(&self, pace: Pace, gap: f64) -> f64 {
        self.signed_optimal_speed(pace, gap).max(0.0)
    }

    /// V(s), at most v₀, negative where the literal function is.
    #[inline]
    fn signed_optimal_speed(&self, pace: Pace, gap: f64) -> f64 {
        let gap = gap / pace.tightness;
        match self.reading {
            Reading::Literal => (V1 + V2 * tanh(C1 * gap - C2)).min(pace.desired),
            Reading::Repaired => {
                let length_scale = FITTED_SPEED / pace.desired;
                let beyond_jam = (gap - self.jam_gap / pace.tightness).max(0.0);
                let rise = tanh(C1 * beyond_jam * length_scale - C2) + TANH_C2;
                // The share is rounded to at most 1, so that nobody expects more than it desires.
                pace.desired * (rise / (1.0 + TANH_C2)).max(0.0)
            }
        }
    }

    fn range(&self, pace: Pace) -> f64 {
        match self.reading {
            Reading::Literal => self.range,
            Reading::Repaired => self.range * pace.desired / FITTED_SPEED,
        }
    }
}

/// tanh by one exponential: near zero its absolute error is that of 1, which is all that V needs, at half the cost.
#[inline]
fn tanh(x: f64) -> f64 {
    1.0 - 2.0 / (exp(2.0 * x) + 1.0)
}

/// Who closes in takes no liberties with the gap: without a time gap of its own, this model would brake too late
/// behind the leader of a tight lane change (ours).
#[inline]
fn wary(pace: Pace, ahead: Option<Ahead>) -> Pace {
    /// Closing speed from which the usual gap counts in full [m/s].
    const CLOSING: f64 = 5.0;
    match ahead {
        Some(ahead) if pace.tightness < 1.0 && pace.speed > ahead.speed => {
            let share = ((pace.speed - ahead.speed) / CLOSING).min(1.0);
            Pace { tightness: pace.tightness + (1.0 - pace.tightness) * share, ..pace }
        }
        _ => pace,
    }
}

impl CarFollowing for Fvdm {
    fn acceleration(&self, pace: Pace, ahead: Option<Ahead>) -> f64 {
        let pace = wary(pace, ahead);
        let optimal = self.signed_optimal_speed(pace, ahead.map_or(f64::INFINITY, |ahead| ahead.gap));
        let relative = match ahead {
            Some(ahead) if ahead.gap <= self.range(pace) => ahead.speed - pace.speed,
            _ => 0.0,
        };
        self.sensitivity * (optimal - pace.speed) + self.relative_sensitivity * relative
    }

    /// The paper takes the optimal velocity itself for the speed a driver expects.
    fn prospect(&self, pace: Pace, ahead: Option<Ahead>) -> f64 {
        self.optimal_speed(pace, ahead.map_or(f64::INFINITY, |ahead| ahead.gap))
    }
}
