//! The optimal velocity: the speed that a driver wants at a net gap. FVDM, OVM and GFM steer towards it.
//!
//! Helbing and Tilch (1998), Phys. Rev. E 58, 133, constants from memory.
//!
//! * literal: V = min(V₁ + V₂ tanh(C₁ s − C₂), v₀). The paper's printed line lost the minus sign. Below 2.32 m V is
//!   negative: a follower that is too close brakes the harder for it. Only as an expected speed it is floored at 0.
//! * repaired: V never exceeds V₁ + V₂ = 14.66 m/s whatever the driver wants, so the speed and the lengths are scaled
//!   to the desired speed: V = v₀ [tanh(C₁ s·14.66/(v₀ ℓ) − C₂) + tanh C₂] / (1 + tanh C₂). The gap is counted beyond
//!   the jam gap. A length scale ℓ below 1 shortens all gaps (both ours).

use super::{Ahead, Pace};
use crate::Reading;
use crate::exponential::exp;

/// An optimal velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OptimalVelocity {
    /// Which one.
    pub reading: Reading,
    /// Gap kept at standstill, in the repaired reading [m].
    pub jam_gap: f64,
    /// ℓ: factor on all other lengths, in the repaired reading.
    pub length_scale: f64,
}

/// V₁ [m/s].
const V1: f64 = 6.75;
/// V₂ [m/s].
const V2: f64 = 7.91;
/// C₁ [1/m].
const C1: f64 = 0.13;
/// C₂.
const C2: f64 = 1.57;
/// V₁ + V₂: the speed for which the constants were found [m/s].
const FITTED_SPEED: f64 = V1 + V2;
/// tanh C₂.
const TANH_C2: f64 = 0.917_025_761_396_608_3;

impl OptimalVelocity {
    /// max(V(s), 0): the speed [m/s] that a driver expects at net gap `gap` [m]; the desired speed, or the literal
    /// function's maximum, where it is infinite.
    pub fn expected(&self, pace: Pace, gap: f64) -> f64 {
        self.signed(pace, gap).max(0.0)
    }

    /// V(s) [m/s], at most v₀, negative where the literal function is.
    #[inline]
    pub(super) fn signed(&self, pace: Pace, gap: f64) -> f64 {
        let gap = gap / pace.headway_relaxation;
        match self.reading {
            Reading::Literal => (V1 + V2 * tanh(C1 * gap - C2)).min(pace.desired),
            Reading::Repaired => {
                let shrunk = FITTED_SPEED / (pace.desired * self.length_scale);
                let beyond_jam = (gap - self.jam_gap / pace.headway_relaxation).max(0.0);
                let rise = tanh(C1 * beyond_jam * shrunk - C2) + TANH_C2;
                // The share is rounded to at most 1, so that no driver expects more than it desires.
                pace.desired * (rise / (1.0 + TANH_C2)).max(0.0)
            }
        }
    }

    /// A length [m] that was found together with the constants, scaled for this driver like the other lengths (ours).
    #[inline]
    pub(super) fn scaled(&self, pace: Pace, length: f64) -> f64 {
        match self.reading {
            Reading::Literal => length,
            Reading::Repaired => length * self.length_scale * pace.desired / FITTED_SPEED,
        }
    }
}

/// s [m]; infinite where there is no leader.
#[inline]
pub(super) fn gap_of(ahead: Option<Ahead>) -> f64 {
    ahead.map_or(f64::INFINITY, |ahead| ahead.gap)
}

/// tanh by one exponential: near zero its absolute error is that of 1, which is enough for V, in half the time.
#[inline]
fn tanh(x: f64) -> f64 {
    1.0 - 2.0 / (exp(2.0 * x) + 1.0)
}

/// Headway relaxation does not count for a driver that closes in: a model of the optimal velocity has no time gap of
/// its own, and would brake too late behind the leader after a lane change into a short gap (ours).
#[inline]
pub(super) fn wary(pace: Pace, ahead: Option<Ahead>) -> Pace {
    /// Closing speed from which the usual gap counts in full [m/s].
    const CLOSING: f64 = 5.0;
    match ahead {
        Some(ahead) if pace.headway_relaxation < 1.0 && pace.speed > ahead.speed => {
            let share = ((pace.speed - ahead.speed) / CLOSING).min(1.0);
            Pace {
                headway_relaxation: pace.headway_relaxation + (1.0 - pace.headway_relaxation) * share,
                ..pace
            }
        }
        _ => pace,
    }
}
