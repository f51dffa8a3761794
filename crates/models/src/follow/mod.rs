//! Car-following: how a driver accelerates behind a leader.

mod acc;
mod fvdm;
mod gfm;
mod gipps;
mod idm;
mod idm_plus;
mod krauss;
mod newell;
mod optimal_velocity;
mod ovm;

pub use acc::{Acc, constant_acceleration};
pub use fvdm::Fvdm;
pub use gfm::{Gfm, GfmForm};
pub use gipps::Gipps;
pub use idm::Idm;
pub use idm_plus::IdmPlus;
pub use krauss::Krauss;
pub use newell::Newell;
pub use optimal_velocity::OptimalVelocity;
pub use ovm::Ovm;

use serde::{Deserialize, Serialize};

/// τ_p: how far ahead a driver anticipates speeds [s].
pub const FORESIGHT: f64 = 1.0;

/// A driver's own motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pace {
    /// v: speed [m/s].
    pub speed: f64,
    /// v₀: desired speed [m/s].
    pub desired: f64,
    /// Share of the usual time gap that the driver keeps at present: 1 when relaxed, less around a lane change, more
    /// while a driver found far behind its leader closes in.
    pub headway_relaxation: f64,
}

impl Pace {
    /// A relaxed driver at `speed` with the desired speed `desired` [m/s].
    pub fn new(speed: f64, desired: f64) -> Pace {
        Pace { speed, desired, headway_relaxation: 1.0 }
    }

    /// What the driver accepts at present of its `usual` time gap [s]: at least half a second, unless its usual time
    /// gap is shorter.
    #[inline]
    pub(crate) fn time_gap(&self, usual: f64) -> f64 {
        /// No driver accepts a shorter time gap around a lane change [s].
        const SHORTEST: f64 = 0.5;
        let (tight, shortest) =
            (usual * self.headway_relaxation, if usual < SHORTEST { usual } else { SHORTEST });
        if tight > shortest { tight } else { shortest }
    }
}

/// The vehicle, or standing obstacle, ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ahead {
    /// s: net gap, from the own front bumper to its rear bumper [m].
    pub gap: f64,
    /// v_l: its speed [m/s].
    pub speed: f64,
    /// a_l: its acceleration [m/s²], as far as it is visible; 0 for an imagined leader.
    pub acceleration: f64,
}

impl Ahead {
    /// A standing obstacle `gap` metres ahead: the end of a lane, a stop line.
    #[inline]
    pub fn standing(gap: f64) -> Ahead {
        Ahead::steady(gap, 0.0)
    }

    /// The same, `by` metres nearer.
    #[inline]
    pub fn nearer(self, by: f64) -> Ahead {
        Ahead { gap: self.gap - by, ..self }
    }

    /// A vehicle `gap` metres ahead that keeps its `speed` [m/s].
    #[inline]
    pub fn steady(gap: f64, speed: f64) -> Ahead {
        Ahead { gap, speed, acceleration: 0.0 }
    }
}

/// A car-following model.
pub trait CarFollowing {
    /// Acceleration [m/s²] at `pace` behind `ahead`; on a free road where there is none.
    fn acceleration(&self, pace: Pace, ahead: Option<Ahead>) -> f64;

    /// V: the speed [m/s] that the paper's speed incentive expects (its section "Speed incentive").
    fn anticipated_speed(&self, pace: Pace, ahead: Option<Ahead>) -> f64 {
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

/// The car-following models that a style can name.
// A byte of its own stores the variant: every step of every driver reads it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[repr(u8)]
#[serde(tag = "model", rename_all = "lowercase")]
pub enum FollowingModel {
    /// Intelligent Driver Model.
    Idm(Idm),
    /// Full Velocity Difference Model.
    Fvdm(Fvdm),
    /// Enhanced Intelligent Driver Model.
    Acc(Acc),
    /// Optimal Velocity Model.
    Ovm(Ovm),
    /// Generalized Force Model.
    Gfm(Gfm),
    /// The model of Krauss.
    Krauss(Krauss),
    /// The model of Gipps.
    Gipps(Gipps),
    /// Newell's simplified model.
    Newell(Newell),
    /// IDM+: the least of the terms of the Intelligent Driver Model.
    #[serde(rename = "idm+")]
    IdmPlus(IdmPlus),
}

/// Calls the method of the model in this variant.
macro_rules! ask {
    ($self:expr, $model:ident => $answer:expr) => {
        match $self {
            FollowingModel::Idm($model) => $answer,
            FollowingModel::Fvdm($model) => $answer,
            FollowingModel::Acc($model) => $answer,
            FollowingModel::Ovm($model) => $answer,
            FollowingModel::Gfm($model) => $answer,
            FollowingModel::Krauss($model) => $answer,
            FollowingModel::Gipps($model) => $answer,
            FollowingModel::Newell($model) => $answer,
            FollowingModel::IdmPlus($model) => $answer,
        }
    };
}

impl CarFollowing for FollowingModel {
    // The most frequent call of a simulation: inlining saves a third of its time for the most frequent models.
    #[inline(always)]
    fn acceleration(&self, pace: Pace, ahead: Option<Ahead>) -> f64 {
        match self {
            FollowingModel::IdmPlus(model) => return model.acceleration(pace, ahead),
            FollowingModel::Idm(model) => return model.acceleration(pace, ahead),
            _ => {}
        }
        let Pace { speed, desired, headway_relaxation } = pace;
        let ahead = ahead.unwrap_or(Ahead::steady(f64::INFINITY, 0.0));
        self.any_acceleration(speed, desired, headway_relaxation, ahead.gap, ahead.speed, ahead.acceleration)
    }

    fn anticipated_speed(&self, pace: Pace, ahead: Option<Ahead>) -> f64 {
        ask!(self, model => model.anticipated_speed(pace, ahead))
    }
}

impl FollowingModel {
    /// What two vehicles need to turn one behind the other [m].
    pub const LARGEST_CLEARANCE: f64 = 0.5;

    /// The acceleration of any model. It takes numbers, because structs would be written to memory for the other
    /// models as well; without a leader the gap is infinite.
    #[inline(never)]
    fn any_acceleration(
        &self,
        speed: f64,
        desired: f64,
        headway_relaxation: f64,
        gap: f64,
        leader_speed: f64,
        leader_acceleration: f64,
    ) -> f64 {
        let pace = Pace { speed, desired, headway_relaxation };
        let ahead = Ahead { gap, speed: leader_speed, acceleration: leader_acceleration };
        let ahead = (gap < f64::INFINITY).then_some(ahead);
        ask!(self, model => model.acceleration(pace, ahead))
    }

    /// s_e: net gap [m] at which a driver keeps `pace` behind an equally fast leader; infinite at or above the
    /// desired speed.
    pub fn equilibrium_gap(&self, pace: Pace) -> f64 {
        const FAR: f64 = 1e5;
        let balance = |gap: f64| self.acceleration(pace, Some(Ahead::steady(gap, pace.speed)));
        if balance(FAR) <= 0.0 {
            return f64::INFINITY;
        }
        let (mut short, mut long) = (0.0, FAR);
        for _ in 0..100 {
            let middle = 0.5 * (short + long);
            if balance(middle) <= 0.0 { short = middle } else { long = middle }
        }
        0.5 * (short + long)
    }

    /// s₀: net gap that a driver with this model keeps at standstill [m].
    #[inline]
    pub fn jam_gap(&self) -> f64 {
        ask!(self, model => model.jam_gap)
    }

    /// Gap [m] that emergency braking keeps to another vehicle for a driver with this model, at most
    /// [`Self::LARGEST_CLEARANCE`] (ours). IDM, IDM+ and FVDM keep a gap by themselves; other models may come up to the
    /// bumper ahead, where there is no space to turn into another lane.
    pub fn clearance(&self) -> f64 {
        match self {
            FollowingModel::Idm(_) | FollowingModel::IdmPlus(_) | FollowingModel::Fvdm(_) => 0.0,
            _ => FollowingModel::LARGEST_CLEARANCE,
        }
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
