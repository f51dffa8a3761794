//! Car-following: how a driver accelerates behind a leader.

mod fvdm;
mod idm;

pub use fvdm::Fvdm;
pub use idm::Idm;

use serde::{Deserialize, Serialize};

/// τ_p: how far ahead a driver foresees speeds [s].
pub const FORESIGHT: f64 = 1.0;

/// A driver's own motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pace {
    /// v: speed [m/s].
    pub speed: f64,
    /// v₀: desired speed [m/s].
    pub desired: f64,
    /// Share of the usual time gap that the driver accepts for now: 1 when relaxed, less around a lane change.
    pub tightness: f64,
}

impl Pace {
    /// A relaxed driver at `speed` who would like to drive `desired` [m/s].
    pub fn new(speed: f64, desired: f64) -> Pace {
        Pace { speed, desired, tightness: 1.0 }
    }
}

/// The vehicle, or standing obstacle, ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ahead {
    /// s: net gap, from the own front bumper to its rear bumper [m].
    pub gap: f64,
    /// v_l: its speed [m/s].
    pub speed: f64,
}

impl Ahead {
    /// A standing obstacle `gap` metres ahead: the end of a lane, a stop line.
    pub fn standing(gap: f64) -> Ahead {
        Ahead { gap, speed: 0.0 }
    }
}

/// A car-following model.
pub trait CarFollowing {
    /// Acceleration [m/s²] at `pace` behind `ahead`; on a free road where there is none.
    fn acceleration(&self, pace: Pace, ahead: Option<Ahead>) -> f64;

    /// V: the speed [m/s] that the paper's speed incentive expects (its section "Speed incentive").
    fn prospect(&self, pace: Pace, ahead: Option<Ahead>) -> f64 {
        speed_after(self.acceleration(pace, ahead), pace)
    }
}

/// `clamp(v + a τ_p, 0, v₀)`: the speed [m/s] after [`FORESIGHT`] of a constant acceleration [m/s²].
#[inline]
pub fn speed_after(acceleration: f64, pace: Pace) -> f64 {
    let speed = pace.speed + acceleration * FORESIGHT;
    let speed = if speed < pace.desired { speed } else { pace.desired };
    if speed > 0.0 { speed } else { 0.0 }
}

/// The car-following models a style can name.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "model", rename_all = "lowercase")]
pub enum FollowingModel {
    /// Intelligent Driver Model.
    Idm(Idm),
    /// Full Velocity Difference Model.
    Fvdm(Fvdm),
}

impl CarFollowing for FollowingModel {
    // The most frequent call of a simulation: inlined, it costs a third less.
    #[inline(always)]
    fn acceleration(&self, pace: Pace, ahead: Option<Ahead>) -> f64 {
        match self {
            FollowingModel::Idm(model) => model.acceleration(pace, ahead),
            FollowingModel::Fvdm(model) => model.acceleration(pace, ahead),
        }
    }

    fn prospect(&self, pace: Pace, ahead: Option<Ahead>) -> f64 {
        match self {
            FollowingModel::Idm(model) => model.prospect(pace, ahead),
            FollowingModel::Fvdm(model) => model.prospect(pace, ahead),
        }
    }
}

impl FollowingModel {
    /// s_e: net gap [m] at which a driver keeps `pace` behind an equally fast leader; infinite at or above the
    /// desired speed.
    pub fn equilibrium_gap(&self, pace: Pace) -> f64 {
        const FAR: f64 = 1e5;
        let balance = |gap: f64| self.acceleration(pace, Some(Ahead { gap, speed: pace.speed }));
        if balance(FAR) <= 0.0 {
            return f64::INFINITY;
        }
        let (mut short, mut long) = (0.0, FAR);
        for _ in 0..100 {
            let middle = 0.5 * (short + long);
            if balance(middle) < 0.0 { short = middle } else { long = middle }
        }
        0.5 * (short + long)
    }

    /// Largest flow [veh/s] of one lane of identical vehicles of `length` [m] in equilibrium.
    pub fn capacity(&self, desired: f64, length: f64) -> f64 {
        (1..500)
            .map(|share| {
                let speed = desired * share as f64 / 500.0;
                speed / (self.equilibrium_gap(Pace::new(speed, desired)) + length)
            })
            .fold(0.0, f64::max)
    }
}
