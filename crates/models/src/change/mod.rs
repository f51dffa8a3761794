//! Changing lanes: the paper's Table I. Its columns are [`Outcomes`], each row is a file, and a line in the list of
//! `incentives.rs`. The models for comparison stand beside it.

mod comfort;
mod constant_hazard;
mod courtesy;
mod gain_bound;
mod headway;
mod incentives;
mod keeping;
mod link_time;
mod lmrs;
mod mcdm;
mod mobil;
mod model;
mod returning;
mod route;
mod route_keeping;
mod safety;
mod situation;
mod speed;
mod urgency;

pub use comfort::{Comfort, discomfort};
pub use constant_hazard::ConstantHazard;
pub use courtesy::Courtesy;
pub use gain_bound::GainBound;
pub use headway::Flow;
pub(crate) use incentives::with_incentives;
pub use incentives::{INCENTIVES, IncentiveName};
pub use keeping::Keeping;
pub use link_time::{bpr, link_time};
pub use lmrs::Lmrs;
pub use mcdm::{Appraisal, Combination, Mcdm, Row, Rule, at_least_once_in};
pub use mobil::{Accelerations, Mobil, Traffic};
pub use model::{Flaw, LaneChangeModel};
pub use returning::Returning;
pub use route::{Route, RouteReading, expected_time};
pub use route_keeping::RouteKeeping;
pub use safety::{GapPair, Refusal, Safety, deceleration_to_avoid, time_to_collision};
pub use situation::{Behind, Driver, LaneRule, LaneView, Merging, RouteView, SIGHT, Situation, Toward};
pub use speed::{Speed, anticipated_speed};
pub use urgency::{Urgency, urgency};

/// The three cases of the paper's Table I, as gains: larger is better.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcomes {
    /// C_o: keep the lane.
    pub keep: f64,
    /// C_cl: change, and still be on the own route.
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

    /// The yield with which it speaks most for a side with the gain bound `bound`, given that it has a weight. `None`
    /// if it is not known: then drivers always look on, which costs time but is never wrong.
    fn most(&self, _bound: &GainBound) -> Option<f64> {
        None
    }
}
