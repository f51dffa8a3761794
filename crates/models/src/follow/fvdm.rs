//! Full Velocity Difference Model.
//!
//! Jiang, Wu, Zhu (2001), Phys. Rev. E 64, 017101, with the [`OptimalVelocity`] of Helbing and Tilch; constants from
//! memory.
//!
//! κ [V(s) − v] + λ (v_l − v),  λ = 0 beyond the range
//!
//! In the repaired reading a leader counts as no faster than the driver wants to be (ours): otherwise it would pull the
//! driver beyond its desired speed.

use serde::{Deserialize, Serialize};

use super::optimal_velocity::{gap_of, wary};
use super::{Ahead, CarFollowing, OptimalVelocity, Pace};
use crate::Reading;

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
    /// ℓ: factor on the lengths of the optimal velocity, in the repaired reading; below 1: shorter gaps.
    pub length_scale: f64,
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
            length_scale: 1.0,
            reading: Reading::Repaired,
        }
    }
}

impl Fvdm {
    /// V: the speed that the driver wants.
    #[inline]
    pub fn optimal_velocity(&self) -> OptimalVelocity {
        OptimalVelocity { reading: self.reading, jam_gap: self.jam_gap, length_scale: self.length_scale }
    }
}

impl CarFollowing for Fvdm {
    fn acceleration(&self, pace: Pace, ahead: Option<Ahead>) -> f64 {
        let (pace, optimal) = (wary(pace, ahead), self.optimal_velocity());
        let relative = match (ahead, self.reading) {
            (Some(ahead), _) if ahead.gap > optimal.scaled(pace, self.range) => 0.0,
            (Some(ahead), Reading::Literal) => ahead.speed - pace.speed,
            (Some(ahead), Reading::Repaired) => ahead.speed.min(pace.desired) - pace.speed,
            (None, _) => 0.0,
        };
        self.sensitivity * (optimal.signed(pace, gap_of(ahead)) - pace.speed)
            + self.relative_sensitivity * relative
    }

    /// The paper takes the optimal velocity itself as the speed that a driver expects.
    fn anticipated_speed(&self, pace: Pace, ahead: Option<Ahead>) -> f64 {
        self.optimal_velocity().expected(pace, gap_of(ahead))
    }
}
