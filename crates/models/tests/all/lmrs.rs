//! LMRS: points with exact reference values, and the effects of the desire.

use crate::near::assert_near;
use crate::situations::{ON_ROUTE, behind, driver, empty_road};
use laneweave_models::Manner;
use laneweave_models::change::{
    LaneChangeModel, Lmrs, RouteKeeping, RouteView, Situation, Toward, anticipated_speed, urgency,
};
use laneweave_models::follow::{Ahead, FollowingModel, Idm};

static IDM: FollowingModel = FollowingModel::Idm(Idm {
    acceleration: 1.25,
    deceleration: 2.09,
    time_gap: 1.2,
    jam_gap: 3.0,
    exponent: 4.0,
});

/// d for a side.
fn desire(model: Lmrs, situation: &Situation) -> f64 {
    model.appraise(situation).gain
}

/// A driver at 25 m/s who desires 30 m/s, in lanes with these anticipated speeds, where it does not accelerate at
/// all.
fn between(toward: Toward, here: f64, there: f64) -> Situation<'static> {
    let mut situation = empty_road(driver(&IDM, 25.0, 30.0));
    situation.toward = toward;
    situation.here.ahead = Some(Ahead::steady(10.0, 25.0));
    (situation.here.anticipated_speed, situation.there.anticipated_speed) = (here, there);
    situation
}

fn in_a_wrong_lane(remaining: f64) -> RouteView {
    RouteView { changes: 1, remaining, ..ON_ROUTE }
}

#[test]
fn v45_the_route_desire_grows_towards_the_last_place() {
    assert_near(urgency(1, 100.0, 20.0), 0.883721, 1e-6);
    assert_near(urgency(1, 400.0, 10.0), 0.069767, 1e-6);
    assert_near(urgency(1, 100.0, 1.0), 0.661017, 1e-6);
    let mut situation = between(Toward::Nearside, 15.0, 15.0);
    situation.here.route = in_a_wrong_lane(100.0);
    situation.me.pace.speed = 20.0;
    // Below v_cong, with equal speeds, only the bias remains.
    let model = Lmrs::default();
    assert_near(desire(model, &situation), 0.883721 + 0.365, 1e-6);
    situation.toward = Toward::Offside;
    assert_near(desire(model, &situation), 0.883721, 1e-6);
    std::mem::swap(&mut situation.here.route, &mut situation.there.route);
    assert_near(desire(model, &situation), -0.883721, 1e-6);
}

#[test]
fn v45_the_speed_desire_fades_while_the_driver_accelerates() {
    let model = Lmrs::default();
    assert_near(model.speed_desire(Toward::Offside, [10.0, 15.0], 0.5), 0.155172, 1e-6);
    assert_near(model.speed_desire(Toward::Offside, [10.0, 15.0], -3.0), 5.0 * 3.6 / 69.6, 1e-12);
    assert_eq!(model.speed_desire(Toward::Offside, [10.0, 15.0], 2.0), 0.0);
}

#[test]
fn v45_the_voluntary_desire_counts_less_against_a_strong_route_desire() {
    let model = Lmrs::default();
    assert_near(model.voluntary_weight(0.65, -0.2), 0.654028, 1e-6);
    assert_near(model.voluntary_weight(-0.65, 0.2), 0.654028, 1e-6);
    assert_eq!(model.voluntary_weight(0.65, 0.2), 1.0);
    assert_eq!(model.voluntary_weight(0.577, -0.2), 1.0);
    assert_eq!(model.voluntary_weight(0.9, -0.2), 0.0);
}

#[test]
fn v45_the_accepted_time_gap_shrinks_with_desire_and_relaxes() {
    const LONGEST: f64 = 1.2;
    let manner = Manner::default();
    assert_near(LONGEST * manner.headway_relaxation(0.6), 0.816, 1e-9);
    let (dt, mut headway_relaxation) = (1e-4, manner.headway_relaxation(1.0));
    assert_near(LONGEST * headway_relaxation, 0.56, 1e-9);
    for _ in 0..250_000 {
        headway_relaxation = manner.relaxed(headway_relaxation, dt);
    }
    assert_near(LONGEST * headway_relaxation, 0.964557, 1e-6);
}

#[test]
fn v45_the_anticipated_speed_lies_between_the_leaders_and_the_desired_one() {
    assert_near(anticipated_speed(Ahead::steady(60.0, 8.0), 50.0 / 3.6), 9.197740, 1e-6);
}

#[test]
fn to_the_slow_side_only_a_loss_counts_in_free_traffic() {
    let model = Lmrs::default();
    let towards = |toward, here, there| model.speed_desire(toward, [here, there], 0.0);
    assert_eq!(towards(Toward::Nearside, 20.0, 25.0), 0.0);
    assert!(towards(Toward::Nearside, 20.0, 15.0) < -0.2);
    assert!(towards(Toward::Nearside, 10.0, 15.0) > 0.2, "congested");
    assert!(towards(Toward::Offside, 20.0, 25.0) > 0.2);
}

#[test]
fn who_loses_nothing_keeps_to_the_slow_side() {
    let model = LaneChangeModel::Lmrs(Lmrs::default());
    let chance = |situation: &Situation| model.choose([Some(&model.appraise(situation)), None])[0];
    assert_eq!(chance(&between(Toward::Nearside, 30.0, 30.0)), 1.0);
    assert_eq!(chance(&between(Toward::Nearside, 30.0, 29.0)), 0.0);
    assert_eq!(chance(&between(Toward::Offside, 30.0, 30.0)), 0.0);
    // d_free v_gain = 7.06 m/s.
    assert_eq!(chance(&between(Toward::Offside, 20.0, 27.0)), 0.0);
    assert_eq!(chance(&between(Toward::Offside, 20.0, 27.1)), 1.0);
}

#[test]
fn the_desire_does_not_ask_who_is_behind() {
    let mut situation = between(Toward::Offside, 20.0, 27.1);
    let alone = desire(Lmrs::default(), &situation);
    situation.there.behind = behind(3.0, driver(&IDM, 35.0, 40.0));
    assert_eq!(desire(Lmrs::default(), &situation), alone);
}

#[test]
fn the_stronger_the_desire_the_more_a_driver_does_for_it() {
    let lmrs = Lmrs::default();
    let model = LaneChangeModel::Lmrs(lmrs);
    assert_eq!((model.synchronizes_from(), model.asks_from()), (0.577, 0.788));
    let mut situation = between(Toward::Offside, 20.0, 20.0);
    let pressure = |situation: &Situation| model.pressure(situation, &model.appraise(situation));
    assert_eq!(pressure(&situation), 0.0);
    situation.here.anticipated_speed = 10.0;
    assert_near(pressure(&situation), 10.0 * 3.6 / 69.6, 1e-12);
    situation.here.route = in_a_wrong_lane(10.0);
    assert_eq!(pressure(&situation), 1.0, "never more");
}

#[test]
fn who_keeps_to_the_lanes_of_the_route_never_leaves_them_and_always_seeks_them() {
    let lanes = Lmrs { route: RouteKeeping::Lanes, ..Lmrs::default() };
    let mut situation = between(Toward::Offside, 5.0, 30.0);
    situation.there.route = in_a_wrong_lane(2000.0);
    assert!(desire(Lmrs::default(), &situation) > 0.365);
    assert_eq!(desire(lanes, &situation), -1.0);
    let mut situation = between(Toward::Offside, 30.0, 28.0);
    situation.here.route = in_a_wrong_lane(2000.0);
    assert!(desire(Lmrs::default(), &situation) < 0.0);
    assert!(desire(lanes, &situation) > 0.365);
}
