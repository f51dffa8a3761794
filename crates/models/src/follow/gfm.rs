//! Generalized Force Model: beside steering towards a speed, a driver that closes in on its leader brakes.
//!
//! Δv = v − v_l is positive when closing, Θ is 1 then and 0 otherwise.
//!
//! * original: Helbing and Tilch (1998), Phys. Rev. E 58, 133, constants from memory.
//!   [V(s, v) − v] / τ − Δv Θ(Δv) e^(−(s − s(v))/R') / τ',  V = v₀ [1 − e^(−(s − s(v))/R)],  s(v) = d + vT
//! * jiang: as Jiang, Wu, Zhu (2001), Phys. Rev. E 64, 017101, write it when they compare it with theirs (from
//!   memory):
//!   κ [V(s) − v] − λ Δv Θ(Δv), with the [`OptimalVelocity`] and the range of FVDM.

use serde::{Deserialize, Serialize};

use super::optimal_velocity::{gap_of, wary};
use super::{Ahead, CarFollowing, OptimalVelocity, Pace};
use crate::Reading;
use crate::exponential::exp;

/// Generalized Force Model.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Gfm {
    /// Which form.
    pub form: GfmForm,
    /// d: gap kept at standstill [m]; of the form of Jiang et al. in the repaired reading only.
    pub jam_gap: f64,
    /// T, of the original: time gap kept beyond that [s].
    pub time_gap: f64,
    /// τ, of the original: time in which the speed is adjusted [s].
    pub adjustment_time: f64,
    /// R, of the original: further gap over which the speed rises to the desired speed [m].
    pub acceleration_range: f64,
    /// τ', of the original: time in which braking removes a closing speed [s].
    pub braking_time: f64,
    /// R', of the original: further gap over which that braking fades [m].
    pub braking_range: f64,
    /// κ, of Jiang et al.: sensitivity to the difference from the optimal velocity [1/s].
    pub sensitivity: f64,
    /// λ, of Jiang et al.: sensitivity to the closing speed [1/s].
    pub relative_sensitivity: f64,
    /// Of Jiang et al.: gap beyond which the closing speed does not count [m].
    pub range: f64,
    /// ℓ: factor on the lengths of the optimal velocity, in the repaired reading; below 1: shorter gaps.
    pub length_scale: f64,
    /// Of Jiang et al.: which optimal velocity.
    pub reading: Reading,
}

/// A form of the Generalized Force Model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum GfmForm {
    /// Helbing and Tilch's own.
    Original,
    /// That of Jiang, Wu and Zhu.
    Jiang,
}

impl Default for Gfm {
    fn default() -> Gfm {
        Gfm {
            form: GfmForm::Original,
            jam_gap: 1.38,
            time_gap: 0.74,
            adjustment_time: 2.45,
            acceleration_range: 5.59,
            braking_time: 0.77,
            braking_range: 98.78,
            sensitivity: 0.41,
            relative_sensitivity: 0.5,
            range: 100.0,
            length_scale: 1.0,
            reading: Reading::Repaired,
        }
    }
}

impl Gfm {
    /// V: the speed that the driver wants in the form of Jiang et al.
    pub fn optimal_velocity(&self) -> OptimalVelocity {
        OptimalVelocity { reading: self.reading, jam_gap: self.jam_gap, length_scale: self.length_scale }
    }

    /// s − s(v): the gap beyond the one that is kept [m].
    fn spare(&self, pace: Pace, ahead: Ahead) -> f64 {
        ahead.gap - (self.jam_gap + pace.speed * pace.time_gap(self.time_gap))
    }

    /// V(s, v) [m/s] of the original: negative below the gap that is kept.
    fn wanted(&self, pace: Pace, ahead: Option<Ahead>) -> f64 {
        let missing = ahead.map_or(0.0, |ahead| exp(-self.spare(pace, ahead) / self.acceleration_range));
        pace.desired * (1.0 - missing)
    }

    fn original(&self, pace: Pace, ahead: Option<Ahead>) -> f64 {
        let steering = (self.wanted(pace, ahead) - pace.speed) / self.adjustment_time;
        let braking = match ahead {
            Some(ahead) if pace.speed > ahead.speed => {
                let nearness = exp(-self.spare(pace, ahead) / self.braking_range);
                (pace.speed - ahead.speed) / self.braking_time * nearness
            }
            _ => 0.0,
        };
        steering - braking
    }

    fn of_jiang(&self, pace: Pace, ahead: Option<Ahead>) -> f64 {
        let (pace, optimal) = (wary(pace, ahead), self.optimal_velocity());
        let closing = match ahead {
            Some(ahead) if ahead.gap <= optimal.scaled(pace, self.range) => {
                (pace.speed - ahead.speed).max(0.0)
            }
            _ => 0.0,
        };
        self.sensitivity * (optimal.signed(pace, gap_of(ahead)) - pace.speed)
            - self.relative_sensitivity * closing
    }
}

impl CarFollowing for Gfm {
    fn acceleration(&self, pace: Pace, ahead: Option<Ahead>) -> f64 {
        match self.form {
            GfmForm::Original => self.original(pace, ahead),
            GfmForm::Jiang => self.of_jiang(pace, ahead),
        }
    }

    /// The speed towards which the model steers, as the paper has it for FVDM.
    fn anticipated_speed(&self, pace: Pace, ahead: Option<Ahead>) -> f64 {
        match self.form {
            GfmForm::Original => self.wanted(pace, ahead).max(0.0),
            GfmForm::Jiang => self.optimal_velocity().expected(pace, gap_of(ahead)),
        }
    }
}
