//! MOBIL: its criterion with exact reference values, in symmetric and in European traffic, and the two ways to follow
//! a route.

use crate::near::assert_near;
use crate::situations::{ON_ROUTE, behind, driver, empty_road};
use laneweave_models::change::{
    Accelerations, Appraisal, IncentiveName, LaneChangeModel, LaneRule, LaneView, Mobil, RouteKeeping,
    RouteView, Situation, Toward, Traffic,
};
use laneweave_models::follow::{Ahead, CarFollowing, FollowingModel, Idm, Pace};
use proptest::prelude::*;

/// The drivers of Kesting et al.
const IDM: FollowingModel = FollowingModel::Idm(Idm {
    acceleration: 1.5,
    deceleration: 2.0,
    time_gap: 1.2,
    jam_gap: 2.0,
    exponent: 4.0,
});
static DRIVERS: FollowingModel = IDM;

/// Left-hand side of the criterion [m/s²].
fn advantage(model: &Mobil, toward: Toward, accelerations: &Accelerations) -> f64 {
    let [own, others] = model.gains(toward, LaneRule::Free, accelerations);
    own + model.politeness * others
}

/// The worked case of the catalogue.
const WORKED: Accelerations = Accelerations {
    own: [-1.673101, 1.023724],
    new_follower: [0.439446, -2.761785],
    old_follower: [0.147121, 0.565107],
};

fn european() -> Mobil {
    Mobil { traffic: Traffic::European, ..Mobil::default() }
}

fn wants(model: Mobil, situation: &Situation) -> bool {
    let model = LaneChangeModel::Mobil(model);
    let appraisal = model.appraise(situation);
    let [chance, _] = model.choose([Some(&appraisal), None]);
    assert_eq!(chance, f64::from(u8::from(appraisal.gain > appraisal.theta)));
    chance == 1.0
}

/// Two lanes at 30 m/s, desired 33.33 m/s, with the leaders `here` and `there`.
fn between(toward: Toward, here: Option<Ahead>, there: Option<Ahead>) -> Situation<'static> {
    let mut situation = empty_road(driver(&DRIVERS, 30.0, 100.0 / 3.0));
    situation.toward = toward;
    (situation.here.ahead, situation.there.ahead) = (here, there);
    situation
}

#[test]
fn v44_the_worked_case_weighs_others_by_politeness() {
    for (politeness, expected) in [(0.0, 2.696825), (0.2, 2.140176), (0.5, 1.305202), (1.0, -0.086420)] {
        let model = Mobil { politeness, ..Mobil::default() };
        let sum = advantage(&model, Toward::Offside, &WORKED);
        assert_near(sum, expected, 1e-6);
        assert_eq!(sum > model.threshold(Toward::Offside, LaneRule::Free), politeness < 1.0);
    }
}

#[test]
fn v44_in_european_traffic_the_fast_side_asks_four_tenths_and_the_slow_side_gives_two() {
    assert_near(european().threshold(Toward::Nearside, LaneRule::Free), -0.2, 1e-12);
    assert_near(european().threshold(Toward::Offside, LaneRule::Free), 0.4, 1e-12);
    let symmetric = Mobil::default();
    assert_eq!(
        [Toward::Nearside, Toward::Offside].map(|it| symmetric.threshold(it, LaneRule::NoPassingThere)),
        [0.1; 2]
    );
}

#[test]
fn v44_in_european_traffic_only_the_follower_on_the_fast_lane_counts() {
    let others = |toward| european().gains(toward, LaneRule::Free, &WORKED)[1];
    assert_near(others(Toward::Offside), -2.761785 - 0.439446, 1e-12);
    assert_near(others(Toward::Nearside), 0.565107 - 0.147121, 1e-12);
}

#[test]
fn v44_above_60_kmh_nobody_gains_by_passing_on_the_slow_side() {
    let slower = |speed| Some(Ahead::steady(40.0, speed));
    let gain = |model: Mobil, toward, here, there| {
        model.appraise(&between(toward, here, there)).row(IncentiveName::Speed).earning
    };
    // Back to the slow lane, past a slower leader on the fast one.
    assert_eq!(gain(european(), Toward::Nearside, slower(25.0), None), 0.0);
    assert!(gain(european(), Toward::Nearside, slower(16.0), None) > 1.0, "congested");
    assert!(gain(Mobil::default(), Toward::Nearside, slower(25.0), None) > 1.0);
    // Behind the leader in the fast lane a driver is no slower than beside it.
    assert_eq!(gain(european(), Toward::Offside, None, slower(25.0)), 0.0);
    assert!(gain(european(), Toward::Offside, None, slower(16.0)) < -1.0);
    let me = |speed, leader| european().stays_behind(speed, Ahead::steady(40.0, leader));
    assert_eq!([me(30.0, 25.0), me(25.0, 30.0), me(30.0, 16.0)], [true, false, false]);
}

#[test]
fn by_law_traffic_is_european_where_the_law_wants_drivers_on_the_slow_side_and_symmetric_elsewhere() {
    let by_law = Mobil { traffic: Traffic::Law, ..Mobil::default() };
    let slower = |speed| Some(Ahead::steady(40.0, speed));
    for toward in [Toward::Offside, Toward::Nearside] {
        for [here, there] in [[None, slower(25.0)], [slower(25.0), None], [slower(16.0), slower(28.0)]] {
            let situation = between(toward, here, there);
            let rules = [
                (LaneRule::Free, Mobil::default()),
                (LaneRule::SlowSide, Mobil::default()),
                (LaneRule::NoPassingThere, european()),
            ];
            for (lane_rule, same) in rules {
                let situation = Situation { lane_rule, ..situation };
                let appraisal = by_law.appraise(&situation);
                assert_eq!(appraisal, same.appraise(&situation));
                let [by_law, same] = [by_law, same].map(LaneChangeModel::Mobil);
                assert_eq!(by_law.minds_offside(lane_rule), same.minds_offside(lane_rule));
                let for_it = |model: &LaneChangeModel| model.is_for_the_slow_side(&situation, &appraisal);
                assert_eq!(for_it(&by_law), for_it(&same));
            }
        }
    }
}

#[test]
fn accelerations_are_those_of_everybodys_own_model() {
    let [slow, quick] = [driver(&DRIVERS, 22.0, 30.0), driver(&DRIVERS, 28.0, 36.0)];
    let mut situation =
        between(Toward::Offside, Some(Ahead::steady(20.0, 20.0)), Some(Ahead::steady(50.0, 31.0)));
    (situation.here.behind, situation.there.behind) = (behind(15.0, slow), behind(25.0, quick));
    let (me, length) = (situation.me.pace, situation.me.length);
    // Nobody brakes harder than vehicles can.
    let idm = |pace: Pace, gap, speed| IDM.acceleration(pace, Some(Ahead::steady(gap, speed))).max(-8.0);
    assert_eq!(idm(me, 20.0, 20.0), -8.0);
    let expected = Accelerations {
        own: [idm(me, 20.0, 20.0), idm(me, 50.0, 31.0)],
        new_follower: [idm(quick.pace, 25.0 + length + 50.0, 31.0), idm(quick.pace, 25.0, 30.0)],
        old_follower: [idm(slow.pace, 15.0, 30.0), idm(slow.pace, 15.0 + length + 20.0, 20.0)],
    };
    assert_eq!(Accelerations::of(&situation), expected);
    let appraisal = Mobil::default().appraise(&situation);
    assert_near(appraisal.gain, advantage(&Mobil::default(), Toward::Offside, &expected), 1e-12);
}

#[test]
fn a_change_that_would_make_the_new_follower_brake_too_hard_is_not_desired() {
    let mut situation = between(Toward::Offside, Some(Ahead::steady(15.0, 20.0)), None);
    assert!(wants(Mobil::default(), &situation));
    situation.there.behind = behind(20.0, driver(&DRIVERS, 38.0, 40.0));
    let [_, forced] = Accelerations::of(&situation).new_follower;
    assert!(forced < -4.0, "{forced}");
    let selfish = Mobil { politeness: 0.0, ..Mobil::default() };
    assert!(!wants(selfish, &situation));
    assert!(wants(Mobil { safe_deceleration: -forced + 0.1, ..selfish }, &situation));
    // A driver who has to change waits for the gap instead.
    situation.here.route = RouteView { changes: 1, remaining: 10.0, ..ON_ROUTE };
    assert!(wants(selfish, &situation));
}

#[test]
fn of_two_lanes_that_end_with_as_many_changes_left_the_one_that_ends_later_is_better() {
    let ends = |remaining: f64| RouteView { changes: 1, remaining, ..ON_ROUTE };
    for route in [RouteKeeping::Urgency, RouteKeeping::Lanes] {
        let model = Mobil { route, ..Mobil::default() };
        let mut situation = empty_road(driver(&IDM, 0.0, 20.0));
        situation.here.ahead = Some(Ahead::steady(28.0, 0.0));
        (situation.here.route, situation.there.route) = (ends(16.0), ends(243.0));
        let Appraisal { gain, theta, .. } = model.appraise(&situation);
        assert!(gain > theta, "{route:?}: {gain} {theta}");
        (situation.here.route, situation.there.route) = (ends(243.0), ends(16.0));
        assert!(model.appraise(&situation).gain < 0.0, "{route:?}");
    }
}

#[test]
fn who_keeps_to_the_lanes_of_the_route_never_leaves_them_and_always_seeks_them() {
    let lanes = Mobil { route: RouteKeeping::Lanes, ..Mobil::default() };
    let wrong = RouteView { changes: 1, remaining: 2000.0, ..ON_ROUTE };
    let mut situation = between(Toward::Offside, Some(Ahead::steady(15.0, 10.0)), None);
    assert!(wants(lanes, &situation));
    situation.there.route = wrong;
    assert!(!wants(lanes, &situation), "far before the turn already");
    assert!(wants(Mobil::default(), &situation), "by urgency only near the turn");
    let mut situation = between(Toward::Offside, None, Some(Ahead::steady(15.0, 10.0)));
    situation.here.route = wrong;
    assert!(wants(lanes, &situation));
    assert!(!wants(Mobil::default(), &situation));
}

#[test]
fn urgency_outweighs_any_loss_at_the_last_place_and_none_far_before_it() {
    let mut situation = between(Toward::Offside, None, Some(Ahead::steady(60.0, 27.0)));
    let at = |situation: &mut Situation<'static>, remaining| -> Appraisal {
        situation.here.route = RouteView { changes: 1, remaining, ..ON_ROUTE };
        Mobil::default().appraise(situation)
    };
    let [own, _] = [situation.here, situation.there]
        .map(|lane: LaneView| DRIVERS.acceleration(situation.me.pace, lane.ahead));
    let loss = own - DRIVERS.acceleration(situation.me.pace, situation.there.ahead);
    assert!((1.0..4.0).contains(&loss), "{loss}");
    assert_near(at(&mut situation, 0.0).gain, 8.0, 1e-12);
    // d = 1 − 147.5/295, or more in time: 1 − 147.5/(43 v).
    let d = 1.0 - (147.5 / situation.me.pace.speed / 43.0).min(0.5);
    assert_near(at(&mut situation, 147.5).gain, 8.0 * d - (1.0 - d) * loss, 1e-12);
    assert_near(at(&mut situation, 5000.0).gain, -loss, 1e-12);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 10_000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn v44_who_is_fully_polite_changes_exactly_if_the_sum_of_accelerations_rises(
        own in [-4.0..2.0_f64, -4.0..2.0_f64], new_follower in [-4.0..2.0_f64, -4.0..2.0_f64],
        old_follower in [-4.0..2.0_f64, -4.0..2.0_f64],
    ) {
        let model = Mobil { politeness: 1.0, threshold: 0.0, ..Mobil::default() };
        let accelerations = Accelerations { own, new_follower, old_follower };
        let sum = |at: usize| own[at] + new_follower[at] + old_follower[at];
        prop_assume!((sum(1) - sum(0)).abs() > 1e-9);
        let is_above = advantage(&model, Toward::Offside, &accelerations) > model.threshold(Toward::Offside, LaneRule::Free);
        prop_assert_eq!(is_above, sum(1) > sum(0));
    }
}
