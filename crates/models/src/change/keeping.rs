//! How a lane-change model without a route of its own follows one: two ways, so that models can be compared fairly.

use serde::{Deserialize, Serialize};

use super::mcdm::Row;
use super::situation::{LaneView, Situation};
use super::urgency::urgency;

/// How the driver of a model that knows no route follows one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum RouteKeeping {
    /// It never leaves the lanes that lead on, and wants into one of them as long as it is in none.
    Lanes,
    /// It changes as it likes until the urgency to be in a lane that leads on, of the same form as in [`super::Mcdm`],
    /// is felt.
    #[default]
    Urgency,
}

impl RouteKeeping {
    /// Changes that the side takes off the route's: what counts for drivers who keep to the lanes that lead on.
    pub(crate) fn changes_saved(situation: &Situation) -> f64 {
        f64::from(situation.here.route.changes) - f64::from(situation.there.route.changes)
    }

    /// Urgency that the side takes away, −1…1.
    pub(crate) fn urgency_relieved(situation: &Situation) -> f64 {
        let of = |lane: &LaneView| urgency(lane.route.changes, lane.route.remaining, situation.me.pace.speed);
        of(&situation.here) - of(&situation.there)
    }

    /// The rows of route and urgency: one of them counts, with its weight `decisive`, which no other gain outweighs, or
    /// `weight`.
    pub(crate) fn rows(self, situation: &Situation, decisive: f64, weight: f64) -> [Row; 2] {
        match self {
            RouteKeeping::Lanes => {
                [Row { earning: RouteKeeping::changes_saved(situation), weight: decisive }, Row::default()]
            }
            RouteKeeping::Urgency => {
                [Row::default(), Row { earning: RouteKeeping::urgency_relieved(situation), weight }]
            }
        }
    }
}
