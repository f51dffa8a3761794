//! A style: a type of driver. Plain data; any car-following model with any lane-change model.

use serde::{Deserialize, Serialize};

use crate::attention::Attention;
use crate::change::{LaneChangeModel, Safety};
use crate::follow::FollowingModel;
use crate::guidance::Guidance;
use crate::lateral::LateralModel;
use crate::yielding::Yielding;

/// A driver's style.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Style {
    /// Its name.
    pub name: String,
    /// One sentence about it.
    #[serde(default)]
    pub description: String,
    /// Desired speed as a multiple of the speed limit.
    #[serde(default = "as_the_limit")]
    pub speed_factor: f64,
    /// Its car-following model.
    pub follow: FollowingModel,
    /// Its lane-change model.
    pub change: LaneChangeModel,
    /// Which gaps it accepts.
    #[serde(default)]
    pub safety: Safety,
    /// How it attends to lanes, and how long it stays concentrated.
    #[serde(default)]
    pub attention: Attention,
    /// How it carries out a lane change.
    #[serde(default)]
    pub manner: Manner,
    /// How it gives way at junctions.
    #[serde(default)]
    pub yielding: Yielding,
    /// How it uses the travel times that it gets.
    #[serde(default)]
    pub guidance: Guidance,
}

fn as_the_limit() -> f64 {
    1.0
}

/// How a driver waits for a gap, changes and relaxes. The paper has it in words; the forms are those of Schakel,
/// Knoop, van Arem (2012), the numbers from memory or ours.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Manner {
    /// The lateral motion of a change.
    pub lateral: LateralModel,
    /// Time that a lane change takes [s].
    pub change_duration: f64,
    /// Time that it takes at full urgency [s].
    pub pressed_duration: f64,
    /// Time after which a driver gives up waiting for a gap [s].
    pub patience: f64,
    /// Time after a change without a new discretionary one [s].
    pub calm: f64,
    /// Hardest braking to adapt the speed to the target lane, for a change that the route needs [m/s²].
    pub adjust_deceleration: f64,
    /// The same for any other change [m/s²].
    pub free_adjust_deceleration: f64,
    /// Hardest braking to let another vehicle in [m/s²]; 0: does not.
    pub yield_deceleration: f64,
    /// Braking with which the driver comes to what stands or is slower, see [`crate::comfortable`] [m/s²]; 0: as its
    /// car-following model alone has it.
    pub comfortable_deceleration: f64,
    /// Largest lateral acceleration in bends, see [`crate::bends`] [m/s²]; 0: does not slow for them.
    pub lateral_acceleration: f64,
    /// Shortest share of the usual time gap accepted around a change.
    pub tightest: f64,
    /// τ: time in which an accepted short gap relaxes to the usual one [s].
    pub relaxation: f64,
    /// Size of the driver's errors in what it sees of a gap, see [`crate::Misperception`]; 0: none, 1: the usual.
    pub misperception: f64,
}

impl Default for Manner {
    fn default() -> Manner {
        Manner {
            lateral: LateralModel::default(),
            change_duration: 4.0,
            pressed_duration: 3.0,
            patience: 15.0,
            calm: 10.0,
            adjust_deceleration: 2.0,
            free_adjust_deceleration: 2.0,
            yield_deceleration: 2.0,
            comfortable_deceleration: 0.0,
            lateral_acceleration: 0.0,
            tightest: 0.56 / 1.2,
            relaxation: 25.0,
            misperception: 0.0,
        }
    }
}

impl Manner {
    /// Whether the driver slows down before bends or lower speed limits, and not only when it has reached them.
    #[inline]
    pub fn looks_ahead(&self) -> bool {
        self.lateral_acceleration > 0.0 || self.comfortable_deceleration > 0.0
    }

    /// Braking with which the driver comes to bends and lower limits [m/s²] (ours): less than its comfortable braking,
    /// since it sees them from far away.
    #[inline]
    pub fn anticipating(&self) -> f64 {
        /// Of a style without comfortable braking, share of that braking, and most [m/s²].
        const USUAL: f64 = 1.5;
        const SHARE: f64 = 0.75;
        const MOST: f64 = 2.0;
        let own = SHARE * self.comfortable_deceleration;
        if own > 0.0 { own.min(MOST) } else { USUAL }
    }

    /// Rate [m/s²] at which a desired speed falls by `less` [m/s] in `time` [s], the time until the driver looks again
    /// (ours). What it sees late is braked for harder, up to a limit.
    pub fn slowing(&self, less: f64, time: f64) -> f64 {
        /// Of a driver who does not look ahead, and the most [m/s²].
        const USUAL: f64 = 1.5;
        const MOST: f64 = 2.5;
        if self.looks_ahead() { (less / time).clamp(self.anticipating(), MOST) } else { USUAL }
    }

    /// Time [s] that a change takes a driver with `urgency` 0…1. Urgency makes no change longer.
    #[inline]
    pub fn duration(&self, urgency: f64) -> f64 {
        self.change_duration + urgency * (self.pressed_duration - self.change_duration).min(0.0)
    }

    /// Share of the usual time gap that a driver with `desire` 0…1 accepts: d·T_min + (1 − d)·T_max.
    pub fn headway_relaxation(&self, desire: f64) -> f64 {
        1.0 - desire.clamp(0.0, 1.0) * (1.0 - self.tightest)
    }

    /// The share after `dt` [s] of relaxing: T += (T_max − T) dt/τ.
    #[inline]
    pub fn relaxed(&self, headway_relaxation: f64, dt: f64) -> f64 {
        headway_relaxation + (1.0 - headway_relaxation) * (dt / self.relaxation).min(1.0)
    }
}
