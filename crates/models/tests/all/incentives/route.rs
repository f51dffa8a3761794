//! The route, and the chance of coming back to it.

use crate::incentives::{IDM, chances, flow, leaving_route};
use crate::near::assert_near;
use crate::situations::{ON_ROUTE, driver, empty_road};
use crate::weights::mcdm;
use laneweave_models::Reading::{self, Literal, Repaired};
use laneweave_models::change::{
    Chances, Flow, Incentive, IncentiveName, Returning, Route, RouteReading, RouteView, Situation,
    expected_time,
};
use laneweave_models::follow::Ahead;

// The chance of coming back.

#[test]
fn the_repaired_chance_looks_at_the_lane_returned_to_and_the_literal_at_the_target() {
    let me = driver(&IDM, 12.0, 14.0);
    let mut situation = leaving_route(empty_road(me), 30.0);
    (situation.here.flow, situation.there.flow) = (flow(20.0, 10.0), flow(12.0, 4.0));
    let returning = |reading| Returning { reading, ..Returning::default() };
    let of = |reading: Reading, flow: Flow| returning(reading).chance(1, 30.0, 12.0, &flow);
    assert_eq!(returning(Literal).chances(&situation), chances(of(Literal, situation.there.flow)));
    assert_eq!(returning(Repaired).chances(&situation), chances(of(Repaired, situation.here.flow)));
    // In a wrong lane the driver has to get into the target lane.
    (situation.here.route, situation.there.route) = (situation.there.route, ON_ROUTE);
    let missing = returning(Repaired).chances(&situation);
    assert_eq!(missing, Chances { here: of(Repaired, situation.there.flow), there: 1.0 });
}

// Route.

/// The paper's P_back at T_h = 2 s.
pub(crate) fn literal_chance(remaining: f64) -> f64 {
    1.0 - f64::exp(-0.058 * 2.0 * remaining)
}

#[test]
fn the_expected_time_grows_as_the_turn_comes_near() {
    for (remaining, time) in [(50.0, 61.816533), (20.0, 118.964151), (10.0, 248.091709), (5.0, 395.939020)] {
        assert_near(expected_time(literal_chance(remaining), 60.0, 660.0), time, 1e-6);
    }
}

/// 40 s on a section of 400 m at 10 m/s, which the driver expects of both lanes, and 20 s beyond it.
fn minute_to_go(reading: Reading) -> (Route, Situation<'static>) {
    let me = driver(&IDM, 10.0, 10.0);
    let mut situation = empty_road(me);
    situation.section = 400.0;
    situation.here.route.onward = 20.0;
    situation.there.route.onward = 20.0;
    (Route { weight: 1.0, reading: reading.into(), ..Route::default() }, situation)
}

#[test]
fn the_route_yields_what_the_turn_is_worth() {
    // Without an alternative missing the turn costs 600 s; E[T] at S = 20 m is 118.964 s.
    for (reading, scale) in [(Literal, 60.0), (Repaired, 60.0)] {
        let (route, situation) = minute_to_go(reading);
        let leaving = leaving_route(situation, 20.0);
        let earning = route.earning(&leaving, chances(literal_chance(20.0)));
        assert_near(earning, (60.0 - 118.964) / scale, 1e-5);
    }
    // Half an hour away, the literal yield of the same minute is small; the repaired yield is the same.
    let yields = [Literal, Repaired].map(|reading| {
        let (route, mut situation) = minute_to_go(reading);
        situation.here.route.onward += 1740.0;
        situation.there.route =
            RouteView { onward: 1760.0, alternative: Some(1820.0), ..situation.there.route };
        route.earning(&leaving_route(situation, 1.0), chances(0.0))
    });
    assert_near(yields[0], -60.0 / 1800.0, 1e-12);
    assert_near(yields[1], -1.0, 1e-12);
}

#[test]
fn the_way_back_to_the_route_is_worth_what_leaving_it_costs() {
    let (route, situation) = minute_to_go(Repaired);
    let mut wrong_lane = leaving_route(situation, 10.0);
    (wrong_lane.here.route, wrong_lane.there.route) = (wrong_lane.there.route, wrong_lane.here.route);
    let here = literal_chance(10.0);
    assert_near(route.earning(&wrong_lane, Chances { here, there: 1.0 }), (248.092 - 60.0) / 60.0, 1e-5);
}

#[test]
fn who_finds_the_other_way_faster_by_more_than_its_band_does_not_come_back() {
    let (route, mut situation) = minute_to_go(Repaired);
    // The other route gains half a minute, whatever the chance of coming back.
    situation.there.route.alternative = Some(0.0);
    situation.here.route.onward = 50.0;
    situation.there.route.onward = 50.0;
    let leaving = |band| Situation { band, ..leaving_route(situation, 20.0) };
    for chance in [0.0, 0.5, 1.0] {
        assert_near(route.earning(&leaving(0.0), chances(chance)), 50.0 / 60.0, 1e-12);
        let with_band = route.earning(&leaving(60.0), chances(chance));
        assert_near(with_band, (1.0 - chance) * 50.0 / 60.0, 1e-12);
    }
}

#[test]
fn of_two_symmetric_lanes_that_is_better_from_which_a_better_way_forks_off() {
    let (route, mut situation) = minute_to_go(Repaired);
    situation.here.route.onward = 50.0;
    situation.there.route.onward = 50.0;
    let yields = |here, there| {
        let mut it = situation;
        (it.here.route.alternative, it.there.route.alternative) = (here, there);
        route.earning(&it, chances(1.0))
    };
    assert_near(yields(None, Some(20.0)), 30.0 / 60.0, 1e-12);
    assert_near(yields(Some(20.0), None), -30.0 / 60.0, 1e-12);
    assert_eq!((yields(Some(20.0), Some(20.0)), yields(None, Some(70.0))), (0.0, 0.0));
    situation.band = 40.0;
    let mut it = situation;
    it.there.route.alternative = Some(20.0);
    assert_eq!(route.earning(&it, chances(1.0)), 0.0);
}

#[test]
fn a_route_is_left_by_its_own_yield_alone_and_in_the_repaired_reading_only() {
    let model = mcdm(Repaired, [1.26, 0.58, 0.03, 0.61], 1.1);
    let appraisal = model.appraise_leaving(120.0, 60.0, 30.0).expect("half a minute is gained");
    assert_near(appraisal.gain, 0.58 * 0.5, 1e-12);
    assert_eq!(model.appraise_leaving(120.0, 100.0, 30.0), None);
    assert_eq!(
        model.appraise_leaving(1e6, 0.0, 0.0).map(|it| it.row(IncentiveName::Route).earning),
        Some(10.0)
    );
    assert_eq!(mcdm(Repaired, [1.26, 0.0, 0.03, 0.61], 1.1).appraise_leaving(120.0, 60.0, 0.0), None);
    assert_eq!(mcdm(Literal, [1.26, 0.58, 0.03, 0.61], 1.1).appraise_leaving(120.0, 60.0, 0.0), None);
}

#[test]
fn the_repaired_route_yield_is_clamped() {
    let (route, situation) = minute_to_go(Repaired);
    let costly = Route { penalty: 6000.0, ..route };
    assert_eq!(costly.earning(&leaving_route(situation, 1.0), chances(0.0)), -10.0);
    let literal = Route { reading: RouteReading::Literal, ..costly };
    assert_near(literal.earning(&leaving_route(situation, 1.0), chances(0.0)), -100.0, 1e-9);
}

#[test]
fn a_literal_route_yield_does_not_explode_at_the_destination() {
    let (route, mut situation) = minute_to_go(Literal);
    // Half a second to go, and a loss of two: −4 without a floor of a second under the denominator.
    (situation.section, situation.here.route.onward) = (5.0, 0.0);
    situation.there.route.alternative = Some(2.0);
    assert_near(route.earning(&leaving_route(situation, 1.0), chances(0.0)), -2.0, 1e-12);
}

#[test]
fn who_finds_the_other_route_faster_does_not_come_back() {
    // 60 s on the route, 50 s on the alternative, p = 0.6.
    for (reading, expected) in [(Literal, 0.6 * 60.0 + 0.4 * 50.0), (Repaired, 50.0)] {
        let (route, mut situation) = minute_to_go(reading);
        situation.there.route.alternative = Some(10.0);
        let earning = route.earning(&leaving_route(situation, 20.0), chances(0.6));
        assert_near(earning, (60.0 - expected) / 60.0, 1e-12);
    }
}

#[test]
fn a_symmetric_change_earns_of_the_route_only_its_speed_part() {
    for alternative in [None, Some(0.0), Some(500.0)] {
        let (route, mut situation) = minute_to_go(Repaired);
        situation.here.route.alternative = alternative;
        situation.there.route.alternative = alternative;
        assert_eq!(route.earning(&situation, chances(1.0)), 0.0);
        // 400 m at 8 and at 10 m/s: ten seconds.
        situation.here.anticipated_speed = 8.0;
        assert_near(route.earning(&situation, chances(1.0)), 10.0 / 60.0, 1e-12);
        let literal = Route { reading: RouteReading::Literal, ..route };
        situation.here.ahead = Some(Ahead::steady(20.0, 8.0));
        assert_eq!(literal.earning(&situation, chances(1.0)), 0.0);
    }
}

#[test]
fn a_travel_time_is_counted_at_a_metre_a_second_at_least() {
    let (route, mut situation) = minute_to_go(Repaired);
    situation.here.anticipated_speed = 0.0;
    // 400 s against 40 s.
    assert_near(route.earning(&situation, chances(1.0)), 6.0, 1e-12);
}

/// As [`minute_to_go`] in the separate reading, at 8 m/s in the own lane: ten seconds more over the section.
fn minute_to_go_apart() -> (Route, Situation<'static>) {
    let (route, mut situation) = minute_to_go(Repaired);
    situation.here.anticipated_speed = 8.0;
    (Route { reading: RouteReading::Separate, ..route }, situation)
}

#[test]
fn apart_from_speed_a_symmetric_change_earns_of_the_route_only_the_better_way_that_forks_off() {
    let (route, mut situation) = minute_to_go_apart();
    situation.here.route.onward = 50.0;
    situation.there.route.onward = 50.0;
    let yields = |here, there, band| {
        let mut it = Situation { band, ..situation };
        (it.here.route.alternative, it.there.route.alternative) = (here, there);
        route.earning(&it, chances(1.0))
    };
    for same in [None, Some(20.0), Some(500.0)] {
        assert_eq!(yields(same, same, 0.0), 0.0);
    }
    assert_near(yields(None, Some(20.0), 0.0), 30.0 / 60.0, 1e-12);
    assert_near(yields(Some(20.0), None, 0.0), -30.0 / 60.0, 1e-12);
    assert_near(yields(Some(35.0), Some(20.0), 0.0), 15.0 / 60.0, 1e-12);
    assert_eq!(yields(None, Some(20.0), 40.0), 0.0);
    // One of the lanes leads to a longer way on.
    situation.there.route.onward = 62.0;
    assert_near(route.earning(&situation, chances(1.0)), -12.0 / 60.0, 1e-12);
}

#[test]
fn apart_from_speed_leaving_the_route_earns_what_it_does_in_the_repaired_reading() {
    let (separate, situation) = minute_to_go_apart();
    let repaired = Route { reading: RouteReading::Repaired, ..separate };
    let leaving = leaving_route(situation, 20.0);
    for chance in [0.0, 0.6, 1.0] {
        let [one, other] = [separate, repaired].map(|it| it.earning(&leaving, chances(chance)));
        assert_eq!(one, other);
    }
    assert_eq!(separate.leaving(120.0, 60.0, 30.0), Some(0.5));
}
