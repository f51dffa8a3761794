//! Speed incentive: compares the speed expected in the other lane with that in the own lane.
//!
//! * literal: the expected speed of the car-following model itself (1 s ahead for IDM, the optimal velocity for
//!   FVDM), and Y = (Ṽ − V)/max(V, 1 m/s).
//! * repaired: one expected speed for every driver, the anticipated lane speed, and Y = (Ṽ − V)/v₀: the two literal
//!   speeds are on different scales.

use serde::{Deserialize, Serialize};

use super::situation::{LaneView, SIGHT, Situation};
use super::{Chances, GainBound, Incentive, Outcomes};
use crate::Reading;
use crate::follow::{Ahead, CarFollowing};

/// Speed incentive.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Speed {
    /// μ₁.
    pub weight: f64,
    /// Which reading.
    pub reading: Reading,
}

impl Default for Speed {
    fn default() -> Speed {
        Speed { weight: 0.0, reading: Reading::Repaired }
    }
}

/// Floor of the speed by which a literal gain is divided [m/s].
const LITERAL_FLOOR: f64 = 1.0;

/// The speed [m/s] that a driver who wants `desired` [m/s] anticipates behind one leader:
/// (1 − s/x₀) v_l + (s/x₀) v₀ within x₀ (Schakel, Knoop, van Arem 2012, from memory). The lane's anticipated speed
/// is the least over its leaders.
#[inline]
pub fn anticipated_speed(ahead: Ahead, desired: f64) -> f64 {
    if ahead.speed >= desired {
        return desired;
    }
    let share = ahead.gap * (1.0 / SIGHT);
    let share = if share > 0.0 { share } else { 0.0 };
    let share = if share < 1.0 { share } else { 1.0 };
    ahead.speed + share * (desired - ahead.speed)
}

impl Speed {
    /// Y of the repaired reading between lanes in which `here` and `there` [m/s] are anticipated, for a driver who
    /// wants `desired`.
    #[inline]
    pub(crate) fn between(here: f64, there: f64, desired: f64) -> f64 {
        (there - here) / desired
    }
}

impl Incentive for Speed {
    fn outcomes(&self, situation: &Situation, _chances: Chances) -> Outcomes {
        let me = &situation.me;
        let speed = |lane: &LaneView| match self.reading {
            Reading::Literal => me.follow.anticipated_speed(me.pace, lane.ahead),
            Reading::Repaired => lane.anticipated_speed,
        };
        let there = speed(&situation.there);
        Outcomes { keep: speed(&situation.here), back: there, away: there }
    }

    fn scale(&self, situation: &Situation, outcomes: &Outcomes) -> f64 {
        match self.reading {
            Reading::Literal => outcomes.keep.max(LITERAL_FLOOR),
            Reading::Repaired => situation.me.pace.desired,
        }
    }

    /// A longer look finds no higher speed there.
    #[inline]
    fn most(&self, bound: &GainBound) -> Option<f64> {
        let [here, there] = bound.anticipated_speeds;
        (self.reading == Reading::Repaired && self.weight > 0.0)
            .then(|| Speed::between(here, there, bound.desired))
    }
}
