//! Keeping to the slow side: a wish for the lane on the slow side that grows with the time one could stay there.
//! Ours, a sixth incentive; it counts only where the law of the road wants drivers there.
//!
//! k = min(t/τ, 1)²,  t = min(s/(v₀ − v_l), S/v₀): the time until a driver with the desired speed v₀ comes up with the
//! leader there, who is slower, or has to leave that lane for its route. Without both in sight k = 1.
//!
//! Y = k of the lane beside, towards the slow side; −k of the own lane, towards the fast side. So the incentive asks a
//! driver to the slow side and keeps it there, by the same amount.

use serde::{Deserialize, Serialize};

use super::situation::{LaneView, Situation, Toward};
use super::{Chances, GainBound, Incentive, Outcomes};
use crate::follow::Ahead;

/// Keeping incentive.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Keeping {
    /// Its weight.
    pub weight: f64,
    /// τ: time that a driver wants to be able to stay on the slow side [s].
    pub stay: f64,
}

impl Default for Keeping {
    /// Without weight; τ is what German courts expect, from memory.
    fn default() -> Keeping {
        Keeping { weight: 0.0, stay: 20.0 }
    }
}

impl Keeping {
    /// k, 0…1, in a lane with the leader `ahead`, for a driver who wants `desired` [m/s] and may use the lane for
    /// `remaining` [m].
    #[inline]
    pub fn wish(&self, ahead: Option<Ahead>, remaining: f64, desired: f64) -> f64 {
        let share = |distance: f64, closing: f64| distance.max(0.0) / (closing * self.stay);
        let by_leader = match ahead {
            Some(ahead) if ahead.speed < desired => share(ahead.gap, desired - ahead.speed),
            _ => 1.0,
        };
        let share = by_leader.min(share(remaining, desired));
        if share < 1.0 { share * share } else { 1.0 }
    }

    /// Y towards a side between lanes that lead to the same place, with the leaders in the own lane and there.
    #[inline]
    pub fn toward(&self, toward: Toward, [here, there]: [Option<Ahead>; 2], desired: f64) -> f64 {
        match toward {
            Toward::Nearside => self.wish(there, f64::INFINITY, desired),
            Toward::Offside => -self.wish(here, f64::INFINITY, desired),
        }
    }
}

impl Incentive for Keeping {
    fn outcomes(&self, situation: &Situation, _chances: Chances) -> Outcomes {
        let wish = |lane: &LaneView| {
            let remaining = if lane.route.changes == 0 { f64::INFINITY } else { lane.route.remaining };
            self.wish(lane.ahead, remaining, situation.me.pace.desired)
        };
        let [keep, there] = match situation.toward {
            _ if !situation.lane_rule.keeps() => [0.0, 0.0],
            Toward::Nearside => [0.0, wish(&situation.there)],
            Toward::Offside => [wish(&situation.here), 0.0],
        };
        Outcomes { keep, back: there, away: there }
    }

    fn scale(&self, _situation: &Situation, _outcomes: &Outcomes) -> f64 {
        1.0
    }

    #[inline]
    fn most(&self, bound: &GainBound) -> Option<f64> {
        Some(bound.slow_side)
    }
}
