//! Changing lanes: the paper's Table I. Its columns are [`Outcomes`], its rows one file each.

mod comfort;
mod constant_hazard;
mod courtesy;
mod glance;
mod headway;
mod lateral;
mod link_time;
mod mcdm;
mod returning;
mod route;
mod safety;
mod situation;
mod speed;
mod urgency;

pub use comfort::{Comfort, discomfort};
pub use constant_hazard::ConstantHazard;
pub use courtesy::Courtesy;
pub use glance::Glance;
pub use headway::Flow;
pub use lateral::{moved_share, peak_lateral_acceleration, peak_lateral_speed};
pub use link_time::{bpr, link_time};
pub use mcdm::{Appraisal, Combination, INCENTIVES, Mcdm, Row, Rule, at_least_once_in};
pub use returning::Returning;
pub use route::{Route, expected_time};
pub use safety::{GapPair, Refusal, Safety, deceleration_to_avoid, time_to_collision};
pub use situation::{Behind, Driver, LaneView, Merging, RouteView, SIGHT, Situation};
pub use speed::{Speed, anticipated_speed};
pub use urgency::{Urgency, urgency};

use serde::{Deserialize, Serialize};

/// The three cases of the paper's Table I, as gains: larger is better.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcomes {
    /// C_o: keep the lane.
    pub keep: f64,
    /// C_cl: change, and be on the own route all the same.
    pub back: f64,
    /// C_cr: change, and lose the route with it.
    pub away: f64,
}

/// The chances that a driver still makes its route: from the own lane and from the target lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chances {
    /// P_n of the own lane.
    pub here: f64,
    /// P_n of the target lane: P_back where one change leads back.
    pub there: f64,
}

/// One row of the table. Its yield is derived, so that an explanation can show the row.
pub trait Incentive {
    /// μ: its weight.
    fn weight(&self) -> f64;

    /// The three cases of `situation`.
    fn outcomes(&self, situation: &Situation, chances: Chances) -> Outcomes;

    /// What the expected gain is divided by to make it a yield.
    fn scale(&self, situation: &Situation, outcomes: &Outcomes) -> f64;

    /// Y = (p·C_cl + (1 − p)·C_cr − C_o) / scale, p the chance from the target lane.
    fn earning(&self, situation: &Situation, chances: Chances) -> f64 {
        let outcomes = self.outcomes(situation, chances);
        let Outcomes { keep, back, away } = outcomes;
        (chances.there * back + (1.0 - chances.there) * away - keep) / self.scale(situation, &outcomes)
    }
}

/// The lane-change models a style can name.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "model", rename_all = "kebab-case")]
pub enum LaneChangeModel {
    /// Multi-criteria decision-making, the paper's.
    Mcdm(Mcdm),
    /// The control that every claim is held against.
    ConstantHazard(ConstantHazard),
}

impl LaneChangeModel {
    /// What the driver makes of one side.
    pub fn appraise(&self, situation: &Situation) -> Appraisal {
        match self {
            LaneChangeModel::Mcdm(model) => model.appraise(situation),
            LaneChangeModel::ConstantHazard(model) => model.appraise(situation),
        }
    }

    /// What the driver makes of leaving a route of `on_route` [s] for one of `alternative` [s], if it is better by more than
    /// `band` [s]; `None` where it does not think of it.
    pub fn appraise_leaving(&self, on_route: f64, alternative: f64, band: f64) -> Option<Appraisal> {
        match self {
            LaneChangeModel::Mcdm(model) => model.appraise_leaving(on_route, alternative, band),
            LaneChangeModel::ConstantHazard(_) => None,
        }
    }

    /// The same model where comfort weighs `factor` times as much.
    pub fn with_comfort(&self, factor: f64) -> LaneChangeModel {
        match self {
            LaneChangeModel::Mcdm(model) => {
                let comfort = Comfort { weight: factor * model.comfort.weight, ..model.comfort };
                LaneChangeModel::Mcdm(Mcdm { comfort, ..model.clone() })
            }
            LaneChangeModel::ConstantHazard(_) => self.clone(),
        }
    }

    /// Chances [first, second] that within one epoch the desire for either side comes, given the appraisals of
    /// the sides that there are. With one side only this is the paper's rule.
    pub fn choose(&self, sides: [Option<&Appraisal>; 2]) -> [f64; 2] {
        match self {
            LaneChangeModel::Mcdm(model) => model.choose(sides),
            LaneChangeModel::ConstantHazard(model) => model.choose(sides),
        }
    }

    /// A gain below which, on both sides, the desire certainly does not come within `epochs` epochs where `draw` was drawn evenly
    /// from [0, 1).
    #[inline]
    pub fn reach(&self, epochs: f64, draw: f64) -> f64 {
        match self {
            LaneChangeModel::Mcdm(model) => model.reach(epochs, draw),
            LaneChangeModel::ConstantHazard(_) => f64::NEG_INFINITY,
        }
    }

    /// The side, 0 or 1, for which the desire comes within `epochs` epochs where `draw` was drawn evenly from [0, 1).
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
