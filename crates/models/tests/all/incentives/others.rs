//! Speed, courtesy, comfort and urgency.

use crate::incentives::route::literal_chance;
use crate::incentives::{IDM, chances, flow, leaving_route};
use crate::near::assert_near;
use crate::situations::{LITERAL_FVDM, ON_ROUTE, behind, driver, empty_road};
use crate::weights::mcdm;
use laneweave_models::Reading::{Literal, Repaired};
use laneweave_models::change::{
    Comfort, Courtesy, Incentive, IncentiveName, LaneChangeModel, LaneRule, LaneView, Merging, RouteView,
    Row, Situation, Speed, Urgency, anticipated_speed, discomfort, urgency,
};
use laneweave_models::follow::{Ahead, CarFollowing, Pace};

// Speed.

/// A leader behind which the literal optimal velocity is `speed` [m/s].
fn leader_allowing(speed: f64) -> Option<Ahead> {
    Some(Ahead::steady((((speed - 6.75) / 7.91_f64).atanh() + 1.57) / 0.13, 5.0))
}

#[test]
fn a_literal_speed_yield_is_divided_by_the_own_speed() {
    let speed = Speed { weight: 1.0, reading: Literal };
    let mut situation = empty_road(driver(&LITERAL_FVDM, 8.0, 50.0 / 3.6));
    // 5.0 if the floor of 1 m/s were forgotten.
    for (here, there, earning) in [(8.0, 11.0, 0.375), (0.2, 1.2, 1.0)] {
        (situation.here.ahead, situation.there.ahead) = (leader_allowing(here), leader_allowing(there));
        assert_near(
            situation.me.follow.anticipated_speed(situation.me.pace, situation.here.ahead),
            here,
            1e-9,
        );
        assert_near(speed.earning(&situation, chances(0.3)), earning, 1e-9);
    }
}

#[test]
fn a_repaired_speed_yield_is_divided_by_the_desired_speed() {
    let speed = Speed { weight: 1.0, reading: Repaired };
    let mut situation = empty_road(driver(&LITERAL_FVDM, 8.0, 50.0 / 3.6));
    (situation.here.anticipated_speed, situation.there.anticipated_speed) = (0.2, 1.2);
    assert_near(speed.earning(&situation, chances(0.3)), 0.072, 1e-12);
}

#[test]
fn the_anticipated_speed_of_a_lane() {
    let desired = 50.0 / 3.6;
    assert_near(anticipated_speed(Ahead::steady(60.0, 8.0), desired), 9.197740, 1e-6);
    assert_eq!(anticipated_speed(Ahead::steady(0.0, 8.0), desired), 8.0);
    assert_eq!(anticipated_speed(Ahead::steady(-1.0, 8.0), desired), 8.0);
    assert_eq!(anticipated_speed(Ahead::steady(295.0, 8.0), desired), desired);
    assert_eq!(anticipated_speed(Ahead::steady(60.0, 20.0), desired), desired);
}

// Courtesy.

const READINGS: [Courtesy; 2] =
    [Courtesy { weight: 1.0, reading: Literal }, Courtesy { weight: 1.0, reading: Repaired }];

#[test]
fn the_two_courtesies_of_the_worked_example_have_different_signs() {
    let [literal, repaired] =
        READINGS.map(|courtesy| courtesy.share(8.0, 11.0, 14.0) + courtesy.share(13.0, 12.0, 14.0));
    assert_near(literal, -0.5, 1e-12);
    assert_near(repaired, 0.142857, 1e-6);
}

#[test]
fn a_follower_at_its_desired_speed_does_not_make_courtesy_explode() {
    // −10 and −109 without a floor under the denominators 0.1 and 0.01 m/s.
    for (now, unguarded) in [(13.9, -10.0), (13.99, -109.0)] {
        let [literal, repaired] = READINGS.map(|courtesy| courtesy.share(now, 12.9, 14.0));
        assert_near(literal / (14.0 - now), unguarded, 1e-6);
        assert_near(repaired * 14.0, literal, 1e-12);
    }
}

#[test]
fn courtesy_is_nothing_where_nobody_is_concerned() {
    // Slower than its lane, but without a follower.
    let alone = empty_road(driver(&IDM, 10.0, 14.0));
    for courtesy in READINGS {
        assert_eq!(courtesy.earning(&alone, chances(1.0)), 0.0);
        assert_eq!(courtesy.earning(&leaving_route(alone, 50.0), chances(0.5)), 0.0);
    }
}

/// The driver, 10 m/s, leaves an old follower for a new one; all desire 14 m/s.
pub(crate) fn between_followers() -> Situation<'static> {
    let mut situation = empty_road(driver(&IDM, 10.0, 14.0));
    situation.here.ahead = Some(Ahead::steady(30.0, 9.0));
    situation.there.ahead = Some(Ahead::steady(25.0, 11.0));
    situation.here.behind = behind(8.0, driver(&IDM, 10.0, 14.0));
    situation.there.behind = behind(12.0, driver(&IDM, 11.0, 14.0));
    situation
}

/// The share of a follower at `speed` [m/s] that gets another leader.
fn share_of(courtesy: &Courtesy, speed: f64, now: Ahead, then: Ahead) -> f64 {
    let expected = |ahead: Ahead| {
        let pace = Pace::new(speed, 14.0);
        (speed + IDM.acceleration(pace, Some(ahead))).clamp(0.0, 14.0)
    };
    courtesy.share(expected(now), expected(then), 14.0)
}

#[test]
fn courtesy_adds_the_old_and_the_new_follower() {
    for courtesy in READINGS {
        let mut situation = between_followers();
        let ahead = |gap, speed| Ahead::steady(gap, speed);
        let relief = share_of(&courtesy, 10.0, ahead(8.0, 10.0), ahead(8.0 + 5.0 + 30.0, 9.0));
        let harm = share_of(&courtesy, 11.0, ahead(12.0 + 5.0 + 25.0, 11.0), ahead(12.0, 10.0));
        assert!(relief > 0.0 && harm < 0.0);
        // Slower than its lane's mean, 14 m/s, the driver is in the way.
        assert_near(courtesy.earning(&situation, chances(1.0)), relief + harm, 1e-12);
        // As fast as its lane, it is not.
        situation.here.flow.speed = 10.0;
        assert_near(courtesy.earning(&situation, chances(1.0)), harm, 1e-12);
        // A driver whose own route needs its lane gives way to nobody.
        situation.here.flow.speed = 14.0;
        assert_near(courtesy.earning(&leaving_route(situation, 50.0), chances(0.5)), harm, 1e-12);
    }
}

#[test]
fn courtesy_makes_room_for_a_merging_vehicle_the_more_the_closer_its_lane_ends() {
    for courtesy in READINGS {
        let mut situation = between_followers();
        situation.here.flow.speed = 10.0;
        let harm = courtesy.earning(&situation, chances(1.0));
        let (blocked, freed) = (Ahead::steady(12.0, 4.0), Ahead::steady(40.0, 12.0));
        let relief = share_of(&courtesy, 8.0, blocked, freed);
        for urgency in [0.0, 0.4, 1.0] {
            let driver = driver(&IDM, 8.0, 14.0);
            let merging = Some(Merging { driver, blocked: Some(blocked), freed: Some(freed), urgency });
            // As fast as its lane, the driver is not in the way of those behind: this is another case.
            for (all, counted) in [([merging, None], 1.0), ([None, merging], 1.0), ([merging; 2], 2.0)] {
                situation.merging = all;
                let earning = courtesy.earning(&situation, chances(1.0));
                assert_near(earning, harm + counted * (1.0 + urgency) * relief, 1e-12);
            }
        }
        assert_near(courtesy.earning(&leaving_route(situation, 50.0), chances(0.5)), harm, 1e-12);
    }
}

// Comfort.

#[test]
fn the_discomfort_of_a_change() {
    for (headway, aggressive, conservative) in [(0.5, 2.143547, 4.924578), (2.0, 0.466516, 0.203063)] {
        assert_near(discomfort(headway, 1.1), -aggressive, 1e-6);
        assert_near(discomfort(headway, 2.3), -conservative, 1e-6);
    }
    for short in [0.0, 0.1, 0.3] {
        assert_near(discomfort(short, 1.1), -(0.3_f64.powf(-1.1)), 1e-12);
    }
}

#[test]
fn who_will_have_to_come_back_pays_for_both_changes() {
    let mut situation = leaving_route(empty_road(driver(&IDM, 10.0, 14.0)), 10.0);
    (situation.here.flow, situation.there.flow) = (flow(12.0, 10.0), flow(20.0, 10.0));
    let p = literal_chance(10.0);
    for (beta, earning) in [(1.1, -1.028275), (2.3, -0.654433)] {
        let comfort = Comfort { weight: 1.0, reading: Literal, beta };
        assert_near(comfort.earning(&situation, chances(p)), earning, 1e-6);
        // A symmetric change is one change.
        let symmetric = Situation { there: LaneView { route: ON_ROUTE, ..situation.there }, ..situation };
        assert_near(comfort.earning(&symmetric, chances(1.0)), discomfort(2.0, beta), 1e-12);
        // The repaired reading takes the repaired headways: 1.3 and 0.5 s.
        let repaired = Comfort { reading: Repaired, ..comfort };
        let both = discomfort(1.3, beta) + p * discomfort(0.5, beta);
        assert_near(repaired.earning(&situation, chances(p)), both, 1e-12);
    }
}

// Urgency.

#[test]
fn urgency_grows_towards_the_last_place_for_a_change() {
    for (remaining, speed, degree) in
        [(100.0, 20.0, 0.883721), (400.0, 10.0, 0.069767), (100.0, 1.0, 0.661017)]
    {
        assert_near(urgency(1, remaining, speed), degree, 1e-6);
    }
    // Two changes: the same as half the distance.
    assert_near(urgency(2, 200.0, 20.0), 0.883721, 1e-6);
    assert_eq!(urgency(0, 0.0, 20.0), 0.0);
    assert_eq!(urgency(1, 5000.0, 20.0), 0.0);
    assert_eq!(urgency(1, 0.0, 0.0), 1.0);
    assert_eq!(urgency(1, -3.0, 20.0), 1.0);
    assert_near(urgency(1, 100.0, 0.0), 0.661017, 1e-6);
}

#[test]
fn a_change_earns_the_urgency_that_it_takes_away() {
    let mut situation = empty_road(driver(&IDM, 20.0, 20.0));
    situation.here.route = RouteView { changes: 1, remaining: 100.0, ..ON_ROUTE };
    let incentive = Urgency { weight: 0.9 };
    assert_near(incentive.earning(&situation, chances(1.0)), 0.883721, 1e-6);
    std::mem::swap(&mut situation.here, &mut situation.there);
    assert_near(incentive.earning(&situation, chances(1.0)), -0.883721, 1e-6);
}

#[test]
fn an_appraisal_has_the_yield_and_the_weight_of_each_incentive_in_its_row() {
    let mut model = mcdm(Repaired, [1.0, 2.0, 3.0, 4.0], 1.1);
    model.urgency.weight = 5.0;
    model.keeping.weight = 6.0;
    let situation =
        Situation { lane_rule: LaneRule::NoPassingThere, ..leaving_route(between_followers(), 40.0) };
    let chances = model.returning.chances(&situation);
    let expected = [
        (IncentiveName::Speed, 1.0, model.speed.earning(&situation, chances)),
        (IncentiveName::Route, 2.0, model.route.earning(&situation, chances)),
        (IncentiveName::Comfort, 3.0, model.comfort.earning(&situation, chances)),
        (IncentiveName::Courtesy, 4.0, model.courtesy.earning(&situation, chances)),
        (IncentiveName::Urgency, 5.0, model.urgency.earning(&situation, chances)),
        (IncentiveName::Keeping, 6.0, model.keeping.earning(&situation, chances)),
    ];
    let appraisal = model.appraise(&situation);
    for (name, weight, earning) in expected {
        assert_eq!(appraisal.row(name), Row { earning, weight }, "{name:?}");
    }
    let sum: f64 = appraisal.rows.iter().map(|row| row.earning * row.weight).sum();
    assert_near(appraisal.gain, sum, 1e-12);
}

#[test]
fn where_comfort_weighs_more_nothing_else_does() {
    let usual = LaneChangeModel::Mcdm(mcdm(Repaired, [1.0, 2.0, 3.0, 4.0], 1.1));
    let situation = leaving_route(between_followers(), 40.0);
    let [before, after] = [usual.appraise(&situation), usual.with_comfort(2.5).appraise(&situation)];
    let comfort = before.row(IncentiveName::Comfort);
    assert_eq!(after.row(IncentiveName::Comfort), Row { weight: 7.5, ..comfort });
    assert_near(after.gain, before.gain + 4.5 * comfort.earning, 1e-12);
    let coin = LaneChangeModel::ConstantHazard(Default::default());
    assert_eq!(coin.with_comfort(2.5), coin);
}
