//! The null-model control: a driver who changes lanes without a reason.
//!
//! Where a lane of equal worth for the route lies beside, a change is desired at a constant rate, whatever the
//! traffic. Only the route is followed: a driver in a wrong lane wants to leave it, a driver in a right lane never
//! does.

use serde::{Deserialize, Serialize};

use super::Situation;
use super::incentives::INCENTIVES;
use super::mcdm::{Appraisal, Row};

/// A driver who changes lanes without a reason.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ConstantHazard {
    /// Probability of a desire to change within one epoch.
    pub hazard: f64,
}

impl Default for ConstantHazard {
    fn default() -> ConstantHazard {
        ConstantHazard { hazard: 0.01 }
    }
}

impl ConstantHazard {
    /// The changes that the side takes off the route's: the only gain of this model.
    pub fn appraise(&self, situation: &Situation) -> Appraisal {
        let gain = f64::from(situation.here.route.changes) - f64::from(situation.there.route.changes);
        Appraisal { rows: [Row::default(); INCENTIVES], gain, theta: 0.0 }
    }

    /// Chances within one epoch of the desire for either side.
    pub fn choose(&self, sides: [Option<&Appraisal>; 2]) -> [f64; 2] {
        let chance = |side: Option<&Appraisal>| match side {
            Some(side) if side.gain > 0.0 => 1.0,
            Some(side) if side.gain == 0.0 => self.hazard,
            _ => 0.0,
        };
        match sides.map(chance) {
            [first, second] if first == 1.0 || second == 1.0 => {
                [f64::from(u8::from(first == 1.0)), f64::from(u8::from(first < 1.0))]
            }
            [first, second] => {
                let share = if first > 0.0 && second > 0.0 { 0.5 } else { 1.0 };
                [share * first, share * second]
            }
        }
    }
}
