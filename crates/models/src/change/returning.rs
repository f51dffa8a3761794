//! The probability of coming back in time, and its generalisation to n changes.
//!
//! The paper: P = 1 − exp(−α T_h S), S the remaining distance. With x = α T_h S,
//! P_n = 1 − e^{−x} Σ_{k<n} x^k/k!, of which n = 1 is the paper's P_back.
//!
//! * literal: T_h of the target lane, α = 0.058 1/(s·m).
//! * repaired: in a standing queue the paper's P → 1 although returning is hardest there. Instead m gap trials,
//!   each accepted with exp(−t_g/T_h) of the lane returned to: P = 1 − (1 − exp(−t_g/T_h))^m, with
//!   t = max(0, S/max(v, 2 m/s) − t_lc) and m = min(t/t_c, 1 + |v − v̄| t/d̄): a car that crawls beside the same
//!   gap has one trial, not many. For n > 1 we keep the exponential form, x = −m ln(1 − exp(−t_g/T_h)) (ours).

use serde::{Deserialize, Serialize};

use super::Chances;
use super::headway::Flow;
use super::situation::{LaneView, Situation};
use crate::Reading;
use crate::exponential::exp;

/// The chance of the changes still to go.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Returning {
    /// Which reading.
    pub reading: Reading,
    /// α of the literal reading [1/(s·m)].
    pub alpha: f64,
    /// t_g: time gap that a trial needs [s].
    pub needed_gap: f64,
    /// t_lc: time that the change itself takes [s].
    pub change_time: f64,
    /// t_c: shortest time between two trials [s].
    pub trial_time: f64,
}

impl Default for Returning {
    fn default() -> Returning {
        Returning {
            reading: Reading::Repaired,
            alpha: 0.058,
            needed_gap: 3.0,
            change_time: 2.0,
            trial_time: 4.0,
        }
    }
}

/// Slowest speed that is assumed when a driver covers the remaining distance [m/s].
const SLOWEST: f64 = 2.0;

impl Returning {
    /// Chances that the driver still makes its route from its lane and from the target lane.
    pub fn chances(&self, situation: &Situation) -> Chances {
        let Situation { here, there, .. } = situation;
        // The lane to return to is the own lane for a driver who leaves its route, else the lane ahead of it.
        let returned_to = if situation.is_bound() { here } else { there };
        let speed = situation.me.pace.speed;
        let of = |lane: &LaneView| {
            let flow = match self.reading {
                Reading::Literal => &there.flow,
                Reading::Repaired => &returned_to.flow,
            };
            self.chance(lane.route.changes, lane.route.remaining, speed, flow)
        };
        Chances { here: of(here), there: of(there) }
    }

    /// P_n: the chance of `changes` lane changes within `remaining` [m] at `speed` [m/s] into traffic like `flow`.
    pub fn chance(&self, changes: u32, remaining: f64, speed: f64, flow: &Flow) -> f64 {
        if changes == 0 {
            return 1.0;
        }
        if remaining <= 0.0 {
            return 0.0;
        }
        let x = match self.reading {
            Reading::Literal => self.alpha * flow.headway(Reading::Literal) * remaining,
            Reading::Repaired => self.trials(remaining, speed, flow),
        };
        at_least(changes, x)
    }

    /// −m ln(1 − exp(−t_g/T_h)): the expected successes that make the paper's exponential form of m trials.
    fn trials(&self, remaining: f64, speed: f64, flow: &Flow) -> f64 {
        let headway = flow.headway(Reading::Repaired);
        if headway <= 0.0 {
            return 0.0;
        }
        let time = (remaining / speed.max(SLOWEST) - self.change_time).max(0.0);
        let passed = (speed - flow.speed).abs() * time / flow.spacing;
        let trials = (time / self.trial_time).min(1.0 + passed);
        if trials <= 0.0 {
            return 0.0;
        }
        -trials * libm::log1p(-exp(-self.needed_gap / headway))
    }
}

/// 1 − e^{−x} Σ_{k<n} x^k/k!: at least `n` events where `x` are expected.
fn at_least(n: u32, x: f64) -> f64 {
    if n == 1 {
        return -libm::expm1(-x);
    }
    if !x.is_finite() {
        return 1.0;
    }
    let (mut term, mut sum) = (1.0, 0.0);
    for k in 0..n {
        sum += term;
        term *= x / f64::from(k + 1);
    }
    (1.0 - exp(-x) * sum).clamp(0.0, 1.0)
}
