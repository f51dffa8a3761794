//! The lane-change models that a style can name, and the interface that the simulation uses.

use serde::{Deserialize, Serialize};

use super::incentives::{INCENTIVES, IncentiveName, in_rows};
use super::mcdm::{Appraisal, Mcdm, Row, Rule, at_least_once_in};
use super::situation::{CONGESTED, LaneRule, Situation, may_not_pass};
use super::urgency::urgency;
use super::{Comfort, ConstantHazard, Lmrs, Mobil};
use crate::follow::Ahead;

/// The lane-change models that a style can name.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "model", rename_all = "kebab-case")]
pub enum LaneChangeModel {
    /// Multi-criteria decision-making, the paper's.
    Mcdm(Mcdm),
    /// Minimizing overall braking induced by lane changes.
    Mobil(Mobil),
    /// Lane changes with relaxation and synchronization.
    Lmrs(Lmrs),
    /// The null-model control.
    ConstantHazard(ConstantHazard),
}

/// Numbers of a model that contradict each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Flaw {
    /// The path of their key in a style file.
    pub path: &'static [&'static str],
    /// What is wrong.
    pub what: &'static str,
    /// What to do.
    pub remedy: &'static str,
}

/// Pressure from which a driver signals so that others let it in (ours).
const ASKS_FROM: f64 = 0.3;

impl LaneChangeModel {
    /// Which of its numbers contradict each other, if any do.
    pub fn flaw(&self) -> Option<Flaw> {
        match self {
            LaneChangeModel::Mcdm(it) if it.rule == Rule::Logit && it.sigma == 0.0 => Some(Flaw {
                path: &["change", "sigma"],
                what: "a logit rule without choice noise",
                remedy: "give sigma a value above 0, or set rule = \"threshold\"",
            }),
            LaneChangeModel::Lmrs(it) if !(it.free <= it.synchronize && it.synchronize < it.cooperate) => {
                Some(Flaw {
                    path: &["change"],
                    what: "desire thresholds in the wrong order",
                    remedy: "choose free ≤ synchronize < cooperate",
                })
            }
            _ => None,
        }
    }

    /// The names of the rows of its appraisals, in their order; a row without a name is not used.
    pub fn row_names(&self) -> [&'static str; INCENTIVES] {
        use IncentiveName::{Comfort, Courtesy, Route, Speed, Urgency};
        match self {
            LaneChangeModel::Mcdm(_) => IncentiveName::ALL.map(IncentiveName::name),
            LaneChangeModel::Mobil(_) => in_rows([
                (Speed, "own gain"),
                (Route, "route"),
                (Courtesy, "others' gain"),
                (Urgency, "urgency"),
            ]),
            LaneChangeModel::Lmrs(_) => in_rows([(Speed, "speed"), (Comfort, "bias"), (Urgency, "route")]),
            LaneChangeModel::ConstantHazard(_) => [""; INCENTIVES],
        }
    }

    /// The gain of these rows: G.
    pub fn gain(&self, rows: &[Row]) -> f64 {
        match self {
            LaneChangeModel::Mcdm(model) => model.combine(rows),
            _ => rows.iter().map(|it| it.weight * it.earning).sum(),
        }
    }

    /// The driver's appraisal of one side.
    pub fn appraise(&self, situation: &Situation) -> Appraisal {
        match self {
            LaneChangeModel::Mcdm(model) => model.appraise(situation),
            LaneChangeModel::Mobil(model) => model.appraise(situation),
            LaneChangeModel::Lmrs(model) => model.appraise(situation),
            LaneChangeModel::ConstantHazard(model) => model.appraise(situation),
        }
    }

    /// How strongly a driver is pressed to the side of `situation`, with its `appraisal`, 0…1: by its route, or in
    /// LMRS by its whole desire.
    pub fn pressure(&self, situation: &Situation, appraisal: &Appraisal) -> f64 {
        let route = &situation.here.route;
        match self {
            LaneChangeModel::Lmrs(_) => appraisal.gain.clamp(0.0, 1.0),
            _ if situation.there.route.changes < route.changes => {
                urgency(route.changes, route.remaining, situation.me.pace.speed)
            }
            _ => 0.0,
        }
    }

    /// Whether a driver changes lanes for its route at all.
    #[inline]
    pub fn follows_a_route(&self) -> bool {
        match self {
            LaneChangeModel::Mcdm(model) => model.route.weight > 0.0 || model.urgency.weight > 0.0,
            LaneChangeModel::Mobil(_) | LaneChangeModel::Lmrs(_) => true,
            LaneChangeModel::ConstantHazard(_) => false,
        }
    }

    /// Pressure from which a driver who waits for a gap adapts its speed to the target lane.
    #[inline]
    pub fn synchronizes_from(&self) -> f64 {
        match self {
            LaneChangeModel::Lmrs(model) => model.synchronize,
            _ => 0.0,
        }
    }

    /// Pressure from which it signals so that others let it in.
    pub fn asks_from(&self) -> f64 {
        match self {
            LaneChangeModel::Lmrs(model) => model.cooperate,
            _ => ASKS_FROM,
        }
    }

    /// Whether a driver who waits for a gap would now rather stay, given its new `appraisal` of the side, whose G was
    /// `gain_before` when the desire came. What made it want a change of so little gain, the noise of its choice, is
    /// still there (ours): it would rather stay when G is below 0 and as far below that of then as the threshold is
    /// above 0. In MOBIL and LMRS the desire has no memory.
    pub fn would_rather_stay(&self, appraisal: &Appraisal, gain_before: f64) -> bool {
        match self {
            LaneChangeModel::Mcdm(_) | LaneChangeModel::ConstantHazard(_) => {
                appraisal.gain < (gain_before - appraisal.theta).min(0.0)
            }
            LaneChangeModel::Mobil(_) | LaneChangeModel::Lmrs(_) => appraisal.gain < appraisal.theta,
        }
    }

    /// Whether drivers may have to stay behind slower ones in the overtaking lane, under this rule.
    #[inline]
    pub fn minds_offside(&self, rule: LaneRule) -> bool {
        match self {
            LaneChangeModel::Mcdm(model) => model.minds_offside(rule),
            LaneChangeModel::Mobil(model) => model.traffic.is_european(rule),
            LaneChangeModel::Lmrs(_) | LaneChangeModel::ConstantHazard(_) => false,
        }
    }

    /// Whether a driver who minds the overtaking lane, at `speed` [m/s], may not pass `offside`, its leader there.
    #[inline]
    pub fn stays_behind(&self, speed: f64, offside: Ahead) -> bool {
        match self {
            LaneChangeModel::Mcdm(_) => may_not_pass(speed, offside, CONGESTED),
            LaneChangeModel::Mobil(model) => model.stays_behind(speed, offside),
            LaneChangeModel::Lmrs(_) | LaneChangeModel::ConstantHazard(_) => false,
        }
    }

    /// Whether the wish for the slow side decides: without it, the driver of this `appraisal` would not want the change
    /// of `situation`.
    pub fn is_for_the_slow_side(&self, situation: &Situation, appraisal: &Appraisal) -> bool {
        match self {
            LaneChangeModel::Mcdm(model) => model.is_for_the_slow_side(appraisal),
            LaneChangeModel::Mobil(model) => model.is_for_the_slow_side(situation, appraisal),
            LaneChangeModel::Lmrs(model) => model.is_for_the_slow_side(situation.toward, appraisal),
            LaneChangeModel::ConstantHazard(_) => false,
        }
    }

    /// The driver's appraisal of leaving a route of `on_route` [s] for one of `alternative` [s], if that is better by
    /// more than `band` [s]; `None` where it does not consider it.
    pub fn appraise_leaving(&self, on_route: f64, alternative: f64, band: f64) -> Option<Appraisal> {
        match self {
            LaneChangeModel::Mcdm(model) => model.appraise_leaving(on_route, alternative, band),
            _ => None,
        }
    }

    /// The same model with the weight of comfort multiplied by `factor`.
    pub fn with_comfort(&self, factor: f64) -> LaneChangeModel {
        match self {
            LaneChangeModel::Mcdm(model) => {
                let comfort = Comfort { weight: factor * model.comfort.weight, ..model.comfort };
                LaneChangeModel::Mcdm(Mcdm { comfort, ..model.clone() })
            }
            _ => self.clone(),
        }
    }

    /// Chances [first, second] that within one epoch the desire for either side comes, given the appraisals of the
    /// existing sides. With only one side this is the paper's rule.
    pub fn choose(&self, sides: [Option<&Appraisal>; 2]) -> [f64; 2] {
        match self {
            LaneChangeModel::Mcdm(model) => model.choose(sides),
            LaneChangeModel::Mobil(model) => model.choose(sides),
            LaneChangeModel::Lmrs(model) => model.choose(sides),
            LaneChangeModel::ConstantHazard(model) => model.choose(sides),
        }
    }

    /// A gain below which the desire certainly does not come within `epochs` epochs, if both sides have less; `draw`
    /// is a random number, uniform in [0, 1).
    #[inline]
    pub fn reach(&self, epochs: f64, draw: f64) -> f64 {
        match self {
            LaneChangeModel::Mcdm(model) => model.reach(epochs, draw),
            _ => f64::NEG_INFINITY,
        }
    }

    /// The side, 0 or 1, for which the desire comes within `epochs` epochs; `draw` is a random number, uniform in [0,
    /// 1).
    #[inline(always)]
    pub fn drawn(&self, sides: [Option<&Appraisal>; 2], epochs: f64, draw: f64) -> Option<usize> {
        let reach = self.reach(epochs, draw);
        if sides.into_iter().flatten().all(|it| it.gain < reach) {
            return None;
        }
        let [first, second] = self.choose(sides).map(|p| at_least_once_in(epochs, p));
        if draw < first { Some(0) } else { (draw < first + second).then_some(1) }
    }
}
