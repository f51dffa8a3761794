//! Urgency: how close a driver in a wrong lane is to the last place for its changes. Ours, as a fifth weight, 0 in
//! the paper's styles; the form is that of Schakel, Knoop, van Arem (2012).
//!
//! d = max(1 − x/(n x₀), 1 − (x/v)/(n t₀), 0),  x₀ = 295 m, t₀ = 43 s

use serde::{Deserialize, Serialize};

use super::situation::{LaneView, SIGHT, Situation};
use super::{Chances, GainBound, Incentive, Outcomes};

/// Urgency incentive: the urgency that a change takes away.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Urgency {
    /// Its weight.
    pub weight: f64,
}

/// t₀: time before the last place within which a driver feels it [s].
const FELT_AHEAD: f64 = 43.0;

/// d, 0…1, for `changes` still to make within `remaining` [m] at `speed` [m/s].
#[inline]
pub fn urgency(changes: u32, remaining: f64, speed: f64) -> f64 {
    if changes == 0 {
        return 0.0;
    }
    let (n, x) = (f64::from(changes), remaining.max(0.0));
    let by_distance = 1.0 - x / (n * SIGHT);
    let by_time = if speed > 0.0 { 1.0 - x / speed / (n * FELT_AHEAD) } else { 0.0 };
    by_distance.max(by_time).max(0.0)
}

impl Incentive for Urgency {
    fn outcomes(&self, situation: &Situation, _chances: Chances) -> Outcomes {
        let of =
            |lane: &LaneView| -urgency(lane.route.changes, lane.route.remaining, situation.me.pace.speed);
        let there = of(&situation.there);
        Outcomes { keep: of(&situation.here), back: there, away: there }
    }

    fn scale(&self, _situation: &Situation, _outcomes: &Outcomes) -> f64 {
        1.0
    }

    /// It does not count between such lanes.
    #[inline]
    fn most(&self, _bound: &GainBound) -> Option<f64> {
        Some(0.0)
    }
}
