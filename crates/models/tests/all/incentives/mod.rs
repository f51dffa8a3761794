//! The rows of the paper's table, one by one, against the worked numbers.

mod keeping;
mod list;
mod others;
mod route;

use laneweave_models::change::{Chances, Flow, LaneView, RouteView, Situation};
use laneweave_models::follow::{FollowingModel, Idm};

/// Chances of a driver who certainly makes its route from its lane, and with `there` from the other.
pub(crate) fn chances(there: f64) -> Chances {
    Chances { here: 1.0, there }
}

/// A driver who leaves the route by changing and has `remaining` [m] to come back.
pub(crate) fn leaving_route(situation: Situation<'_>, remaining: f64) -> Situation<'_> {
    let route = RouteView { changes: 1, remaining, ..situation.there.route };
    Situation { there: LaneView { route, ..situation.there }, ..situation }
}

pub(crate) static IDM: FollowingModel = FollowingModel::Idm(Idm {
    acceleration: 1.0,
    deceleration: 1.5,
    time_gap: 1.0,
    jam_gap: 2.0,
    exponent: 4.0,
});

pub(crate) fn flow(spacing: f64, speed: f64) -> Flow {
    Flow { spacing, speed, length: 5.0 }
}
