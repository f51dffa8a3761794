//! The decision: yields weighted and combined, the rules, and what must never sway them.

use crate::near::assert_near;
use crate::situations::{LENGTH, LITERAL_FVDM, ON_ROUTE, behind, driver, empty_road};
use crate::weights::mcdm;
use laneweave_models::Reading::{self, Literal, Repaired};
use laneweave_models::change::{
    Appraisal, Chances, Combination, Comfort, ConstantHazard, Courtesy, Flow, INCENTIVES, Incentive,
    LaneChangeModel, LaneView, Mcdm, Route, RouteView, Row, Rule, Situation, Speed, at_least_once_in,
    expected_time,
};
use laneweave_models::follow::{Ahead, FollowingModel, Fvdm, Idm, Pace};

/// Weights μ₁…μ₄ and β of the paper's table.
const AGGRESSIVE: ([f64; 4], f64) = ([1.26, 0.58, 0.03, 0.61], 1.1);
const CONSERVATIVE: ([f64; 4], f64) = ([0.44, 0.41, 0.09, 1.72], 2.3);

/// A side with the gain `gain`, which has to be above `theta`.
fn side(gain: f64, theta: f64) -> Appraisal {
    Appraisal { rows: [Row::default(); INCENTIVES], gain, theta }
}

/// The stochastic rule.
fn logit(theta: f64, sigma: f64) -> Mcdm {
    Mcdm { rule: Rule::Logit, theta, sigma, ..Mcdm::default() }
}

/// The worked case: V 8 → 11 m/s, T 60/52/75 s, T_h 1.2 s here and 2 s there.
fn worked_case() -> Situation<'static> {
    const SECTION: f64 = 200.0;
    // The inverse of the literal optimal velocity.
    let leader_allowing =
        |speed: f64| Some(Ahead::steady((((speed - 6.75) / 7.91_f64).atanh() + 1.57) / 0.13, 5.0));
    let flow = |headway: f64| Flow { spacing: 10.0 * headway, speed: 10.0, length: LENGTH };
    let mut situation = empty_road(driver(&LITERAL_FVDM, 8.0, 14.0));
    situation.section = SECTION;
    situation.here.ahead = leader_allowing(8.0);
    situation.there.ahead = leader_allowing(11.0);
    (situation.here.flow, situation.there.flow) = (flow(1.2), flow(2.0));
    situation.here.route.onward = 60.0 - SECTION / 8.0;
    situation.there.route = RouteView {
        changes: 1,
        remaining: 50.0,
        onward: 52.0 - SECTION / 11.0,
        alternative: Some(75.0 - SECTION / 11.0),
    };
    situation
}

#[test]
fn v33_the_worked_case_of_both_classes_and_both_courtesies() {
    const P: f64 = 0.6;
    let chances = Chances { here: 1.0, there: P };
    let situation = worked_case();
    // Courtesy's G and h at θ = 0 for the literal and the repaired reading.
    for ((weights, beta), discomfort, literal, repaired) in [
        (AGGRESSIVE, -0.957483, (0.127176, 0.531751), (0.519318, 0.626988)),
        (CONSERVATIVE, -0.597552, (-0.756980, 0.319302), (0.348735, 0.586311)),
    ] {
        for (courtesy, (gain, chance)) in [(Literal, literal), (Repaired, repaired)] {
            let model = Mcdm { rule: Rule::Logit, sigma: 1.0, ..mcdm(Literal, weights, beta) };
            let Mcdm { speed, route, comfort, .. } = model;
            let courtesy = Courtesy { reading: courtesy, ..model.courtesy };
            let earnings = [
                speed.earning(&situation, chances),
                route.earning(&situation, chances),
                comfort.earning(&situation, chances),
                courtesy.share(8.0, 11.0, 14.0) + courtesy.share(13.0, 12.0, 14.0),
            ];
            assert_near(earnings[0], 0.375, 1e-9);
            assert_near(earnings[1], -0.02, 1e-9);
            assert_near(earnings[2], discomfort, 1e-6);
            let rows = [0, 1, 2, 3].map(|i| Row { earning: earnings[i], weight: weights[i] });
            assert_near(model.combine(&rows), gain, 1e-6);
            assert_near(model.choose([Some(&side(model.combine(&rows), 0.0)), None])[0], chance, 1e-6);
            assert_near(model.choose([None, Some(&side(model.combine(&rows), 0.0))])[1], chance, 1e-6);
        }
    }
}

#[test]
fn v33_the_route_term_breaks_even_at_15_of_23() {
    let route = Route { weight: 1.0, reading: Literal.into(), ..Route::default() };
    let there = 15.0 / 23.0;
    assert_near(there, 0.652174, 1e-6);
    assert_near(route.earning(&worked_case(), Chances { here: 1.0, there }), 0.0, 1e-9);
    assert_near(expected_time(there, 52.0, 75.0), 60.0, 1e-9);
}

#[test]
fn v36_who_weighs_nothing_never_wants_to_change_by_the_threshold_rule() {
    let situation = worked_case();
    for theta in [0.0, 0.1] {
        let indifferent = Mcdm { theta, ..mcdm(Literal, [0.0; 4], 1.1) };
        let appraisal = indifferent.appraise(&situation);
        assert_eq!((appraisal.rows, appraisal.gain), ([Row::default(); INCENTIVES], 0.0));
        assert_eq!(indifferent.choose([Some(&appraisal), Some(&appraisal)]), [0.0, 0.0]);
    }
}

#[test]
fn v36_who_weighs_nothing_wants_to_change_by_the_noise_alone() {
    let noise = 1.0 / 40.0;
    let indifferent =
        Mcdm { rule: Rule::Logit, theta: 4.5 * noise, sigma: noise, ..mcdm(Repaired, [0.0; 4], 1.1) };
    let appraisal = indifferent.appraise(&worked_case());
    let [one, none] = indifferent.choose([Some(&appraisal), None]);
    assert_near(one, 1.0 / (1.0 + 4.5_f64.exp()), 1e-15);
    assert_eq!(none, 0.0);
    let both = indifferent.choose([Some(&appraisal), Some(&appraisal)]);
    assert_near(both[0], 1.0 / (2.0 + 4.5_f64.exp()), 1e-15);
    assert_eq!(both[0], both[1]);
    // 4.595120 is the threshold of one change in a hundred epochs.
    assert_near(logit(4.595120, 1.0).choose([Some(&side(0.0, 4.595120)), None])[0], 0.01, 1e-8);
}

#[test]
fn left_and_right_compete_in_one_logit() {
    let (left, right) = (side(0.3, 0.1), side(-0.2, 0.1));
    let (l, r) = (((0.3 - 0.1) / 0.5_f64).exp(), ((-0.2 - 0.1) / 0.5_f64).exp());
    let chances = logit(0.1, 0.5).choose([Some(&left), Some(&right)]);
    assert_near(chances[0], l / (1.0 + l + r), 1e-15);
    assert_near(chances[1], r / (1.0 + l + r), 1e-15);
    assert_eq!(logit(0.1, 0.5).choose([None, None]), [0.0, 0.0]);
}

#[test]
fn the_threshold_rule_is_the_limit_of_the_logit() {
    for gains in [[0.3, -0.2], [-0.2, 0.3], [0.3, 0.2], [0.2, 0.3], [0.05, 0.08], [-1.0, -2.0]] {
        let [left, right] = gains.map(|gain| side(gain, 0.1));
        let sides = [Some(&left), Some(&right)];
        let limit = Mcdm { rule: Rule::Threshold, ..logit(0.1, 0.0) }.choose(sides);
        assert_eq!(limit, logit(0.1, 0.0).choose(sides));
        assert_eq!(limit, logit(0.1, 1e-6).choose(sides));
        let best = f64::max(gains[0], gains[1]);
        assert_eq!(limit, gains.map(|gain| f64::from(u8::from(gain == best && gain > 0.1))));
    }
    // G = θ is not enough.
    assert_eq!(mcdm(Literal, [0.0; 4], 1.1).choose([Some(&side(0.0, 0.0)), None]), [0.0, 0.0]);
}

#[test]
fn an_exponential_combination_weighs_losses_more_than_gains() {
    let model = Mcdm { combination: Combination::Exponential, ..Mcdm::default() };
    let gain = |earning| model.combine(&[Row { earning, weight: 2.0 }]);
    assert_near(gain(0.5), 2.0 * (1.0 - (-0.5_f64).exp()), 1e-12);
    assert_near(gain(-0.5), 2.0 * (1.0 - 0.5_f64.exp()), 1e-12);
    assert!(gain(0.5) + gain(-0.5) < 0.0);
}

/// The vehicles of two equal lanes in equilibrium at `speed`; those there are `offset` [m] ahead of those here.
fn equal_lanes(
    follow: &FollowingModel,
    speed: f64,
    desired: f64,
    offset: f64,
    alternative: Option<f64>,
) -> Situation<'_> {
    let vehicle = driver(follow, speed, desired);
    let gap = follow.equilibrium_gap(Pace::new(speed, desired));
    let spacing = gap + LENGTH;
    let lane = |gap_ahead: f64, gap_behind: f64| LaneView {
        ahead: Some(Ahead::steady(gap_ahead, speed)),
        behind: behind(gap_behind, vehicle),
        flow: Flow { spacing, speed, length: LENGTH },
        anticipated_speed: speed,
        route: RouteView { alternative, ..ON_ROUTE },
    };
    let there = lane(offset - LENGTH, spacing - offset - LENGTH);
    Situation { here: lane(gap, gap), there, ..empty_road(vehicle) }
}

#[test]
fn v37_identical_vehicles_in_equilibrium_do_not_want_to_change() {
    let models = [
        (FollowingModel::Idm(Idm::default()), [5.0, 15.0, 25.0], 120.0 / 3.6),
        (LITERAL_FVDM, [3.0, 8.0, 13.0], 14.0),
        (FollowingModel::Fvdm(Fvdm::default()), [5.0, 15.0, 25.0], 120.0 / 3.6),
    ];
    for (follow, speeds, desired) in models {
        for speed in speeds {
            let gap = follow.equilibrium_gap(Pace::new(speed, desired));
            for share in [0.0, 0.25, 0.5, 0.75, 1.0] {
                for alternative in [None, Some(10.0), Some(600.0)] {
                    for (reading, (weights, beta)) in
                        [Literal, Repaired].into_iter().flat_map(|it| [(it, AGGRESSIVE), (it, CONSERVATIVE)])
                    {
                        let offset = LENGTH + share * (gap - LENGTH);
                        let situation = equal_lanes(&follow, speed, desired, offset, alternative);
                        let model = mcdm(reading, weights, beta);
                        let appraisal = model.appraise(&situation);
                        assert!(
                            appraisal.gain < 0.0,
                            "{reading:?} {follow:?} {speed} {offset}: {appraisal:?}"
                        );
                        assert_eq!(model.choose([Some(&appraisal), Some(&appraisal)]), [0.0, 0.0]);
                    }
                }
            }
        }
    }
}

#[test]
fn a_chance_per_second_of_a_hundredth_is_one_per_tenth_of_a_second_of_a_thousandth() {
    assert_near(at_least_once_in(0.1, 0.01), 0.001005, 1e-6);
    assert_eq!(at_least_once_in(1.0, 0.01), 0.01);
    assert_near(at_least_once_in(2.0, 0.01), 0.0199, 1e-15);
    assert_eq!(at_least_once_in(0.5, 0.0), 0.0);
    assert_eq!(at_least_once_in(0.5, 1.0), 1.0);
}

#[test]
fn the_chance_of_an_epoch_does_not_depend_on_how_it_is_divided() {
    for p in [0.01_f64, 0.3, 0.99] {
        for parts in [2, 7, 10] {
            let without = 1.0 - at_least_once_in(1.0 / f64::from(parts), p);
            assert_near(without.powi(parts), 1.0 - p, 1e-12);
        }
    }
}

#[test]
fn the_gain_below_which_no_desire_comes_is_neither_too_high_nor_far_too_low() {
    let (theta, sigma, ln_2) = (0.1, 0.02, std::f64::consts::LN_2);
    let model = LaneChangeModel::Mcdm(logit(theta, sigma));
    // 2⁻¹⁰, divided among two sides: θ − 11 σ ln 2.
    assert_near(model.reach(1.0, (-10.0_f64).exp2()), theta - 11.0 * sigma * ln_2, 1e-12);
    for epochs in [0.1, 1.0, 3.0, 20.0] {
        for draw in [0.9, 0.6, 0.03, 0.0011, 1e-6, 3e-12] {
            let chance = |gain| {
                let chances = model.choose([Some(&side(gain, theta)); 2]);
                chances.map(|it| at_least_once_in(epochs, it)).iter().sum::<f64>()
            };
            let reach = model.reach(epochs, draw);
            assert!(chance(reach) <= draw, "{epochs} epochs, {draw}: {}", chance(reach));
            // The bound is a power of two, and nearly exact where the chance is small.
            let is_exact = epochs >= 1.0 && draw < 0.01;
            assert!(!is_exact || chance(reach + 1.1 * sigma * ln_2) > draw, "{epochs} epochs, {draw}");
        }
    }
    assert_eq!(model.reach(1.0, 0.0), f64::NEG_INFINITY);
    let exact = LaneChangeModel::Mcdm(Mcdm { rule: Rule::Threshold, ..logit(theta, sigma) });
    assert_eq!(exact.reach(1.0, 0.5), theta);
}

#[test]
fn a_constant_hazard_knows_the_route_and_nothing_else() {
    let model = LaneChangeModel::ConstantHazard(ConstantHazard { hazard: 0.02 });
    let choose = |first: Option<&Situation>, second: Option<&Situation>| {
        let [first, second] = [first, second].map(|it| it.map(|situation| model.appraise(situation)));
        model.choose([first.as_ref(), second.as_ref()])
    };
    let equal = empty_road(driver(&LITERAL_FVDM, 8.0, 14.0));
    let mut slow = equal;
    slow.there.anticipated_speed = 1.0;
    let away = worked_case();
    let mut back = away;
    std::mem::swap(&mut back.here, &mut back.there);
    assert_eq!(model.appraise(&back), side(1.0, 0.0));
    assert_eq!(choose(Some(&equal), None), [0.02, 0.0]);
    assert_eq!(choose(Some(&slow), Some(&equal)), [0.01, 0.01]);
    assert_eq!(choose(Some(&away), Some(&equal)), [0.0, 0.02]);
    assert_eq!(choose(Some(&back), Some(&equal)), [1.0, 0.0]);
    assert_eq!(choose(Some(&equal), Some(&back)), [0.0, 1.0]);
    assert_eq!(choose(Some(&away), Some(&away)), [0.0, 0.0]);
}

#[test]
fn the_paper_model_appraises_and_chooses_as_itself_under_its_name() {
    let (weights, beta) = AGGRESSIVE;
    let model = Mcdm { theta: -1.0, ..mcdm(Repaired, weights, beta) };
    let named = LaneChangeModel::Mcdm(model.clone());
    let appraisal = named.appraise(&worked_case());
    assert_eq!(appraisal, model.appraise(&worked_case()));
    assert_eq!(appraisal.theta, -1.0);
    assert_eq!(named.choose([Some(&appraisal), None]), model.choose([Some(&appraisal), None]));
}

#[test]
fn the_defaults_weigh_nothing_and_are_the_repaired_reading() {
    let reading: Reading = Reading::default();
    assert_eq!(reading, Repaired);
    let Mcdm { speed, route, comfort, courtesy, .. } = Mcdm::default();
    assert_eq!(speed, Speed { weight: 0.0, reading });
    assert_eq!(comfort, Comfort { weight: 0.0, reading, beta: 1.1 });
    assert_eq!(courtesy, Courtesy { weight: 0.0, reading });
    assert_eq!(ConstantHazard::default().hazard, 0.01);
    assert_eq!(
        (route.weight, route.reading, route.reference, route.penalty),
        (0.0, reading.into(), 60.0, 600.0)
    );
}
