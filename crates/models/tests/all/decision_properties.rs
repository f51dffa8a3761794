//! Properties of every decision, on random situations.

use crate::situations::{LENGTH, behind, driver, empty_road};
use crate::weights::mcdm;
use laneweave_models::Reading::{self, Literal, Repaired};
use laneweave_models::change::{
    Appraisal, Behind, Combination, Comfort, Driver, Flow, GainBound, LaneChangeModel, LaneRule, LaneView,
    Mcdm, Merging, RouteReading, RouteView, Rule, Situation, Toward, at_least_once_in,
};
use laneweave_models::follow::{Ahead, FollowingModel, Fvdm, Idm, Pace};
use proptest::option;
use proptest::prelude::*;

/// Random cases of the three signs.
const CASES: u32 = 100_000;
/// Largest change of a gain by rounding.
const ROUNDING: f64 = 1e-9;

fn cases(cases: u32) -> ProptestConfig {
    ProptestConfig { cases, failure_persistence: None, ..ProptestConfig::default() }
}

fn any_reading() -> impl Strategy<Value = Reading> {
    prop_oneof![Just(Literal), Just(Repaired)]
}

/// The models of the drivers.
static MODELS: [FollowingModel; 3] = [
    FollowingModel::Idm(Idm {
        acceleration: 0.73,
        deceleration: 1.67,
        time_gap: 1.6,
        jam_gap: 2.0,
        exponent: 4.0,
    }),
    FollowingModel::Fvdm(fvdm(Literal)),
    FollowingModel::Fvdm(fvdm(Repaired)),
];

const fn fvdm(reading: Reading) -> Fvdm {
    Fvdm {
        sensitivity: 0.41,
        relative_sensitivity: 0.5,
        range: 100.0,
        jam_gap: 0.0,
        length_scale: 1.0,
        reading,
    }
}

fn any_follow() -> impl Strategy<Value = &'static FollowingModel> {
    (0..MODELS.len()).prop_map(|at| &MODELS[at])
}

fn any_driver() -> impl Strategy<Value = Driver<'static>> {
    (any_follow(), 0.0..40.0_f64, 5.0..45.0_f64)
        .prop_map(|(follow, speed, desired)| driver(follow, speed, desired))
}

fn any_ahead() -> impl Strategy<Value = Ahead> {
    (0.5..200.0_f64, 0.0..40.0_f64).prop_map(|(gap, speed)| Ahead::steady(gap, speed))
}

fn any_behind() -> impl Strategy<Value = Behind<'static>> {
    (0.5..150.0_f64, any_driver()).prop_map(|(gap, driver)| Behind { gap, driver })
}

fn any_route() -> impl Strategy<Value = RouteView> {
    (0_u32..3, 0.0..500.0_f64, 0.0..1000.0_f64, option::of(0.0..2000.0_f64)).prop_map(
        |(changes, remaining, onward, alternative)| RouteView { changes, remaining, onward, alternative },
    )
}

fn any_lane() -> impl Strategy<Value = LaneView<'static>> {
    let flow =
        (6.0..300.0_f64, 0.0..40.0_f64).prop_map(|(spacing, speed)| Flow { spacing, speed, length: LENGTH });
    (option::of(any_ahead()), option::of(any_behind()), flow, 0.0..40.0_f64, any_route()).prop_map(
        |(ahead, behind, flow, anticipated_speed, route)| LaneView {
            ahead,
            behind,
            flow,
            anticipated_speed,
            route,
        },
    )
}

fn any_merging() -> impl Strategy<Value = Merging<'static>> {
    (any_driver(), option::of(any_ahead()), any_ahead(), 0.0..1.0_f64).prop_map(
        |(driver, blocked, freed, urgency)| Merging { driver, blocked, freed: Some(freed), urgency },
    )
}

fn any_situation() -> impl Strategy<Value = Situation<'static>> {
    let merging = [option::of(any_merging()), option::of(any_merging())];
    let toward = prop_oneof![Just(Toward::Offside), Just(Toward::Nearside)];
    let rule = prop_oneof![Just(LaneRule::Free), Just(LaneRule::SlowSide), Just(LaneRule::NoPassingThere)];
    (any_driver(), any_lane(), any_lane(), 1.0..300.0_f64, merging, toward, rule).prop_map(
        |(me, here, there, section, merging, toward, lane_rule)| Situation {
            toward,
            me,
            here,
            there,
            section,
            band: 0.0,
            lane_rule,
            merging,
        },
    )
}

/// The paper's incentives, urgency and keeping, all weighed.
fn any_model() -> impl Strategy<Value = Mcdm> {
    let (weights, keeping) = (prop::array::uniform4(0.01..2.0_f64), -0.2..0.5_f64);
    (any_reading(), weights, 0.5..3.0_f64, 0.0..1.0_f64, keeping, any::<bool>()).prop_map(
        |(reading, weights, beta, urgency, keeping, is_separate)| {
            let mut model = mcdm(reading, weights, beta);
            model.urgency.weight = urgency;
            model.keeping.weight = keeping;
            if is_separate && reading == Repaired {
                model.route.reading = RouteReading::Separate;
            }
            model
        },
    )
}

proptest! {
    #![proptest_config(cases(CASES))]

    #[test]
    fn v34_a_longer_alternative_never_raises_the_gain(
        model in any_model(), mut situation in any_situation(), alternative in 0.0..2000.0_f64,
        longer in 0.0..2000.0_f64,
    ) {
        situation.there.route.alternative = Some(alternative);
        let before = model.appraise(&situation).gain;
        situation.there.route.alternative = Some(alternative + longer);
        prop_assert!(model.appraise(&situation).gain <= before + ROUNDING);
    }

    #[test]
    fn v34_a_faster_target_never_lowers_the_gain(
        model in any_model(), mut situation in any_situation(), faster in 0.0..20.0_f64,
    ) {
        // A new follower would lose the faster leader; this is a harm to it, and another case. Where drivers keep to
        // the slow side, a faster leader in the overtaking lane lets the own lane go faster, too.
        situation.there.behind = None;
        situation.lane_rule = LaneRule::Free;
        let before = model.appraise(&situation).gain;
        situation.there.anticipated_speed += faster;
        if let Some(ahead) = &mut situation.there.ahead {
            ahead.speed += faster;
            ahead.gap += faster;
        }
        prop_assert!(model.appraise(&situation).gain >= before - ROUNDING);
    }

    #[test]
    fn v34_more_harm_to_the_new_follower_never_raises_the_gain(
        model in any_model(), mut situation in any_situation(), follower in any_driver(), gap in 0.5..30.0_f64,
        share in 0.0..1.0_f64,
    ) {
        // The follower loses a free road, so that only the gap to the driver counts. It is short of the range of
        // FVDM; beyond it, a faster leader would not make it accelerate.
        situation.there.ahead = None;
        situation.there.behind = behind(gap, follower);
        let before = model.appraise(&situation).gain;
        situation.there.behind = behind(share * gap, follower);
        prop_assert!(model.appraise(&situation).gain <= before + ROUNDING);
    }

    #[test]
    fn v34_less_room_for_a_merging_vehicle_never_raises_the_gain(
        model in any_model(), mut situation in any_situation(), merging in any_merging(), gap in 0.5..30.0_f64,
        speed in 0.0..40.0_f64, share in 0.0..1.0_f64,
    ) {
        situation.merging[0] = Some(Merging { freed: Some(Ahead::steady(gap, speed)), ..merging });
        let before = model.appraise(&situation).gain;
        situation.merging[0] = Some(Merging { freed: Some(Ahead::steady(share * gap, speed)), ..merging });
        prop_assert!(model.appraise(&situation).gain <= before + ROUNDING);
    }

    #[test]
    fn a_longer_look_never_finds_more_than_the_bound(
        model in any_model(), mut situation in any_situation(), hidden in 0.0..20.0_f64,
        combination in prop_oneof![Just(Combination::Linear), Just(Combination::Exponential)],
    ) {
        let model = Mcdm { combination, ..model };
        situation.merging = [None; 2];
        for lane in [&mut situation.here, &mut situation.there] {
            lane.route = RouteView { changes: 0, remaining: f64::INFINITY, ..lane.route };
        }
        let Situation { toward, me, here, there, section, band, .. } = situation;
        let (leaders, rule) = ([here.ahead, there.ahead], situation.lane_rule);
        let speeds = |hidden: f64| {
            let speeds = [here.anticipated_speed, there.anticipated_speed + hidden];
            if model.minds_offside(rule) { model.without_passing(toward, me.pace.speed, leaders, speeds) } else { speeds }
        };
        let harm = there.behind.map_or(0.0, |it| model.courtesy.harm(&me, there.ahead, &it));
        let bound = |hidden: f64| GainBound {
            desired: me.pace.desired,
            anticipated_speeds: speeds(hidden),
            routes: [here.route, there.route],
            section,
            band,
            courtesy: model.courtesy.relief(&me, &here) + harm,
            slow_side: if rule.keeps() { model.keeping.toward(toward, leaders, me.pace.desired) } else { 0.0 },
        };
        prop_assert!(model.gain_at_most(&bound(hidden)) >= model.appraise(&situation).gain);
        // Only the comfort is left out where the longer look finds the same anticipated speed.
        if model.speed.reading == Repaired {
            let without_comfort = Mcdm { comfort: Comfort { weight: 0.0, ..model.comfort }, ..model };
            let exact = without_comfort.appraise(&situation).gain;
            prop_assert!((model.gain_at_most(&bound(0.0)) - exact).abs() < ROUNDING);
        }
    }
}

fn any_extreme_speed() -> impl Strategy<Value = f64> {
    prop_oneof![Just(0.0), Just(1e-9), Just(14.0), Just(60.0)]
}

fn any_extreme_length() -> impl Strategy<Value = f64> {
    prop_oneof![Just(0.0), Just(1e-3), Just(20.0), Just(300.0), Just(1e6)]
}

fn any_extreme_ahead() -> impl Strategy<Value = Option<Ahead>> {
    option::of((any_extreme_length(), any_extreme_speed()).prop_map(|(gap, speed)| Ahead::steady(gap, speed)))
}

fn any_extreme_lane() -> impl Strategy<Value = LaneView<'static>> {
    let follower = (any_extreme_length(), any_follow(), any_extreme_speed())
        .prop_map(|(gap, follow, speed)| Behind { gap, driver: driver(follow, speed, 14.0) });
    let spacing = prop_oneof![any_extreme_length(), Just(f64::INFINITY)];
    let flow =
        (spacing, any_extreme_speed()).prop_map(|(spacing, speed)| Flow { spacing, speed, length: LENGTH });
    let route = (0_u32..4, any_extreme_length(), any_extreme_length(), option::of(any_extreme_length()))
        .prop_map(|(changes, remaining, onward, alternative)| RouteView {
            changes,
            remaining: if changes == 0 { f64::INFINITY } else { remaining },
            onward,
            alternative,
        });
    (any_extreme_ahead(), option::of(follower), flow, any_extreme_speed(), route).prop_map(
        |(ahead, behind, flow, anticipated_speed, route)| LaneView {
            ahead,
            behind,
            flow,
            anticipated_speed,
            route,
        },
    )
}

proptest! {
    #![proptest_config(cases(20_000))]

    #[test]
    fn v35_every_yield_and_every_chance_is_finite(
        model in any_model(), follow in any_follow(), speed in any_extreme_speed(), here in any_extreme_lane(),
        there in any_extreme_lane(), section in any_extreme_length(),
        sigma in prop_oneof![Just(0.0), Just(1e-3), Just(1.0)],
        rule in prop_oneof![Just(Rule::Threshold), Just(Rule::Logit)], headway_relaxation in 0.4..1.0_f64,
    ) {
        let me = Driver { pace: Pace { speed, desired: 14.0, headway_relaxation }, acceleration: 0.0, follow, comfortable: 0.0, length: LENGTH };
        let model = Mcdm { rule, sigma, ..model };
        let situation = Situation { here, there, section, ..empty_road(me) };
        let appraisal = model.appraise(&situation);
        prop_assert!(appraisal.gain.is_finite());
        for row in appraisal.rows {
            prop_assert!(row.earning.is_finite());
        }
        for sides in [[Some(&appraisal), None], [None, Some(&appraisal)], [Some(&appraisal); 2]] {
            let [first, second] = model.choose(sides);
            prop_assert!((0.0..=1.0).contains(&first) && (0.0..=1.0).contains(&second));
            prop_assert!(first + second <= 1.0 + 1e-12);
        }
    }

    #[test]
    fn what_is_drawn_follows_from_the_chances(
        gains in prop::array::uniform2(-2.0..2.0_f64), sides in 1..4_u8, sigma in prop_oneof![Just(0.0), 0.001..1.0_f64],
        rule in prop_oneof![Just(Rule::Threshold), Just(Rule::Logit)], epochs in prop_oneof![Just(1.0), 0.1..20.0_f64],
        draw in prop_oneof![0.0..1.0_f64, (0.0..60.0_f64).prop_map(|it| (-it).exp2())],
    ) {
        let model = Mcdm { rule, sigma, ..Mcdm::default() };
        let appraisals = gains.map(|gain| Appraisal { gain, ..model.appraise(&empty_road(driver(&MODELS[0], 10.0, 14.0))) });
        let side = |number: usize| (sides >> number & 1 == 1).then_some(&appraisals[number]);
        let (model, sides) = (LaneChangeModel::Mcdm(model), [side(0), side(1)]);
        let [first, second] = model.choose(sides).map(|chance| at_least_once_in(epochs, chance));
        let expected = if draw < first { Some(0) } else { (draw < first + second).then_some(1) };
        prop_assert_eq!(model.drawn(sides, epochs, draw), expected);
    }
}
