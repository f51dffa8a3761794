//! Optimal Velocity Model.
//!
//! Bando et al. (1995), Phys. Rev. E 51, 1035, with the [`OptimalVelocity`] and κ of Helbing and Tilch (1998), from
//! memory.
//!
//! κ [V(s) − v]
//!
//! It does not see the leader's speed: with the literal V a driver accelerates from rest with 12.5 m/s², and hits a
//! leader who brakes hard.

use serde::{Deserialize, Serialize};

use super::optimal_velocity::{gap_of, wary};
use super::{Ahead, CarFollowing, OptimalVelocity, Pace};
use crate::Reading;

/// Optimal Velocity Model.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ovm {
    /// κ: sensitivity to the difference from the optimal velocity [1/s].
    pub sensitivity: f64,
    /// Gap kept at standstill, in the repaired reading [m].
    pub jam_gap: f64,
    /// ℓ: factor on the lengths of the optimal velocity, in the repaired reading; below 1: shorter gaps.
    pub length_scale: f64,
    /// Which optimal velocity.
    pub reading: Reading,
}

impl Default for Ovm {
    fn default() -> Ovm {
        Ovm { sensitivity: 0.85, jam_gap: 0.0, length_scale: 1.0, reading: Reading::Repaired }
    }
}

impl Ovm {
    /// V: the speed that the driver wants.
    pub fn optimal_velocity(&self) -> OptimalVelocity {
        OptimalVelocity { reading: self.reading, jam_gap: self.jam_gap, length_scale: self.length_scale }
    }
}

impl CarFollowing for Ovm {
    fn acceleration(&self, pace: Pace, ahead: Option<Ahead>) -> f64 {
        let optimal = self.optimal_velocity().signed(wary(pace, ahead), gap_of(ahead));
        self.sensitivity * (optimal - pace.speed)
    }

    /// The optimal velocity itself, which the paper uses for FVDM.
    fn anticipated_speed(&self, pace: Pace, ahead: Option<Ahead>) -> f64 {
        self.optimal_velocity().expected(pace, gap_of(ahead))
    }
}
