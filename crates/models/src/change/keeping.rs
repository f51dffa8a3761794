//! How a lane-change model without a route of its own follows one: two ways, so that models can be compared fairly.

use serde::{Deserialize, Serialize};

use super::mcdm::Row;
use super::situation::{LaneView, Situation};
use super::urgency::urgency;

/// How the driver follows a route, in a model that knows no route.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum RouteKeeping {
    /// It never leaves the lanes that lead on. While it is in none of them, it wants to change to one.
    Lanes,
    /// It changes lanes freely until it feels the urgency to be in a lane that leads on; the urgency has the same
    /// form as in [`super::Mcdm`].
    #[default]
    Urgency,
}

impl RouteKeeping {
    /// Changes that the side takes off the route's. It counts for drivers who stay in the lanes that lead on.
    pub(crate) fn changes_saved(situation: &Situation) -> f64 {
        f64::from(situation.here.route.changes) - f64::from(situation.there.route.changes)
    }

    /// Urgency that the side takes away, −1…1.
    pub(crate) fn urgency_relieved(situation: &Situation) -> f64 {
        let of = |lane: &LaneView| urgency(lane.route.changes, lane.route.remaining, situation.me.pace.speed);
        of(&situation.here) - of(&situation.there)
    }

    /// The rows of route and urgency. One of them counts: either with its weight `decisive`, which no other gain
    /// outweighs, or with `weight`.
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
