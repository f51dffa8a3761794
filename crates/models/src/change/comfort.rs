//! Comfort incentive: a lane change costs attention, the more so the shorter the headways.
//!
//! J = −K T_h^(−β), K = 1: K is part of the weight. Keeping the lane costs nothing, so a relative gain is undefined
//! and the yield is not divided. A driver who will have to come back pays for both changes.

use serde::{Deserialize, Serialize};

use super::headway::Flow;
use super::situation::Situation;
use super::{Chances, GainBound, Incentive, Outcomes};
use crate::Reading;
use crate::exponential::exp;

/// Comfort incentive.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Comfort {
    /// μ₃.
    pub weight: f64,
    /// Which headway.
    pub reading: Reading,
    /// β.
    pub beta: f64,
}

impl Default for Comfort {
    fn default() -> Comfort {
        Comfort { weight: 0.0, reading: Reading::Repaired, beta: 1.1 }
    }
}

/// Shortest headway that is distinguished [s].
const SHORTEST: f64 = 0.3;

/// −T^(−β): the discomfort of a change into a lane with the mean headway `headway` [s].
pub fn discomfort(headway: f64, beta: f64) -> f64 {
    -exp(-beta * libm::log(headway.max(SHORTEST)))
}

impl Comfort {
    fn of(&self, flow: &Flow) -> f64 {
        discomfort(flow.headway(self.reading), self.beta)
    }
}

impl Incentive for Comfort {
    fn outcomes(&self, situation: &Situation, _chances: Chances) -> Outcomes {
        let away = self.of(&situation.there.flow);
        let back = if situation.is_bound() { away + self.of(&situation.here.flow) } else { away };
        Outcomes { keep: 0.0, back, away }
    }

    fn scale(&self, _situation: &Situation, _outcomes: &Outcomes) -> f64 {
        1.0
    }

    /// A longer look adds the discomfort.
    #[inline]
    fn most(&self, _bound: &GainBound) -> Option<f64> {
        (self.weight > 0.0).then_some(0.0)
    }
}
