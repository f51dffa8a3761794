//! Intelligent Driver Model.
//!
//! Treiber, Hennecke, Helbing (2000), Phys. Rev. E 62, 1805. The max keeps s* at s₀ or above when the leader
//! pulls away; the paper leaves it out.
//!
//! a [1 − (v/v₀)^δ − (s*/s)²],  s* = s₀ + max(0, vT + vΔv / 2√(ab)),  Δv = v − v_l

use serde::{Deserialize, Serialize};

use super::{Ahead, CarFollowing, Pace};

/// Intelligent Driver Model.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Idm {
    /// a: maximum acceleration [m/s²].
    pub acceleration: f64,
    /// b: comfortable deceleration [m/s²].
    pub deceleration: f64,
    /// T: time gap kept to the vehicle ahead [s].
    pub time_gap: f64,
    /// s₀: gap kept at standstill [m].
    pub jam_gap: f64,
    /// δ: how late the acceleration fades as the speed approaches the desired speed.
    pub exponent: f64,
}

impl Default for Idm {
    /// Table I of Treiber et al. (from memory); the driver has its own v₀.
    fn default() -> Idm {
        Idm { acceleration: 0.73, deceleration: 1.67, time_gap: 1.6, jam_gap: 2.0, exponent: 4.0 }
    }
}

impl Idm {
    /// Gaps are not taken below this, so that the interaction stays finite [m].
    pub(super) const SHORTEST: f64 = 0.1;
    /// The usual δ, for which two products compute the power.
    const USUAL_EXPONENT: f64 = 4.0;

    /// 1 − (v/v₀)^δ, of v/v₀: what of the acceleration a free road leaves.
    #[inline]
    pub(super) fn free(&self, ratio: f64) -> f64 {
        if self.exponent == Idm::USUAL_EXPONENT {
            let square = ratio * ratio;
            1.0 - square * square
        } else {
            1.0 - libm::pow(ratio, self.exponent)
        }
    }

    /// (s*/s)²: what of the acceleration the vehicle ahead takes.
    #[inline]
    pub(super) fn interaction(&self, pace: Pace, ahead: Ahead) -> f64 {
        let approach = pace.speed - ahead.speed;
        let braking = pace.speed * approach / (2.0 * (self.acceleration * self.deceleration).sqrt());
        // Plain comparisons: f64::max takes five times as long here.
        let dynamic = pace.speed * pace.time_gap(self.time_gap) + braking;
        let desired_gap = self.jam_gap + if dynamic > 0.0 { dynamic } else { 0.0 };
        let ratio = desired_gap / if ahead.gap > Idm::SHORTEST { ahead.gap } else { Idm::SHORTEST };
        ratio * ratio
    }
}

impl CarFollowing for Idm {
    #[inline]
    fn acceleration(&self, pace: Pace, ahead: Option<Ahead>) -> f64 {
        let interaction = ahead.map_or(0.0, |ahead| self.interaction(pace, ahead));
        self.acceleration * (self.free(pace.speed / pace.desired) - interaction)
    }
}
