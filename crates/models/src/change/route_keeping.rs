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

    /// Whether the side helps the route: it takes a change off it, or it leaves more time for as many.
    pub(crate) fn is_helped(situation: &Situation) -> bool {
        let saved = RouteKeeping::changes_saved(situation);
        saved > 0.0 || saved == 0.0 && RouteKeeping::urgency_for(situation) > 0.0
    }

    /// Urgency, −1…1, with which the route asks for the side: that of the own lane if the side takes a change off the
    /// route, that of the side, negative, if it adds one. LMRS has the same form (Schakel, Knoop, van Arem 2012). Of
    /// two lanes with as many changes, one may end much sooner: then the difference counts (ours).
    pub(crate) fn urgency_for(situation: &Situation) -> f64 {
        let of = |lane: &LaneView| urgency(lane.route.changes, lane.route.remaining, situation.me.pace.speed);
        let [here, there] = [&situation.here, &situation.there].map(of);
        match RouteKeeping::changes_saved(situation) {
            saved if saved > 0.0 => here,
            saved if saved < 0.0 => -there,
            _ => here - there,
        }
    }

    /// The rows of route and urgency. One of them counts: either with its weight `decisive`, which no other gain
    /// outweighs, or with `weight`.
    pub(crate) fn rows(self, situation: &Situation, decisive: f64, weight: f64) -> [Row; 2] {
        match self {
            RouteKeeping::Lanes => {
                let saved = RouteKeeping::changes_saved(situation);
                let earning = if saved == 0.0 { RouteKeeping::urgency_for(situation) } else { saved };
                [Row { earning, weight: decisive }, Row::default()]
            }
            RouteKeeping::Urgency => {
                [Row::default(), Row { earning: RouteKeeping::urgency_for(situation), weight }]
            }
        }
    }
}
