//! Situations for tests: a driver on an empty road; a test then fills its lanes.

use laneweave_models::Reading::Literal;
use laneweave_models::change::{Behind, Driver, Flow, LaneRule, LaneView, RouteView, Situation, Toward};
use laneweave_models::follow::{FollowingModel, Fvdm, Pace};

/// Net length of every vehicle [m].
pub(crate) const LENGTH: f64 = 5.0;

/// The FVDM as the paper has it.
pub(crate) static LITERAL_FVDM: FollowingModel = FollowingModel::Fvdm(Fvdm {
    sensitivity: 0.41,
    relative_sensitivity: 0.5,
    range: 100.0,
    jam_gap: 0.0,
    length_scale: 1.0,
    reading: Literal,
});

/// A relaxed driver.
pub(crate) fn driver(follow: &FollowingModel, speed: f64, desired: f64) -> Driver<'_> {
    Driver { pace: Pace::new(speed, desired), acceleration: 0.0, follow, comfortable: 0.0, length: LENGTH }
}

/// A vehicle `gap` [m] behind.
pub(crate) fn behind(gap: f64, driver: Driver<'_>) -> Option<Behind<'_>> {
    Some(Behind { gap, driver })
}

/// A lane that the driver's route need not leave, with 60 s of travel time left.
pub(crate) const ON_ROUTE: RouteView =
    RouteView { changes: 0, remaining: f64::INFINITY, onward: 60.0, alternative: None };

/// Two empty lanes of equal worth.
pub(crate) fn empty_road(me: Driver<'_>) -> Situation<'_> {
    let flow = Flow { spacing: 300.0, speed: me.pace.desired, length: LENGTH };
    let lane =
        LaneView { ahead: None, behind: None, flow, anticipated_speed: me.pace.desired, route: ON_ROUTE };
    Situation {
        toward: Toward::Offside,
        me,
        here: lane,
        there: lane,
        section: 200.0,
        band: 0.0,
        lane_rule: LaneRule::Free,
        merging: [None; 2],
    }
}
