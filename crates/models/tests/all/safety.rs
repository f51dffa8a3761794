//! Which gaps are accepted.

use crate::near::assert_near;
use crate::situations::driver;
use laneweave_models::change::{Driver, GapPair, Refusal, Safety, deceleration_to_avoid, time_to_collision};
use laneweave_models::follow::{Ahead, FollowingModel, IdmPlus};
use proptest::prelude::*;

/// Time step [s].
const DT: f64 = 0.1;

/// A pair whose follower's model demands no braking.
fn pair(gap: f64, follower: f64, leader: f64) -> GapPair {
    GapPair { gap, follower, leader, demanded: 0.0 }
}

fn verdict(pair: GapPair) -> Result<(), Refusal> {
    Safety::default().accept(pair, DT)
}

#[test]
fn v41_time_to_collision_and_the_deceleration_that_avoids_it() {
    assert_near(time_to_collision(15.0, 15.0, 10.0), 3.0, 1e-12);
    assert_near(deceleration_to_avoid(15.0, 15.0, 10.0), 0.833333, 1e-6);
    assert_near(time_to_collision(8.0, 20.0, 10.0), 0.8, 1e-12);
    assert_near(deceleration_to_avoid(8.0, 20.0, 10.0), 6.25, 1e-12);
    for (follower, leader) in [(10.0, 10.0), (10.0, 12.0)] {
        for gap in [0.0, 8.0] {
            assert_eq!(time_to_collision(gap, follower, leader), f64::INFINITY);
            assert_eq!(deceleration_to_avoid(gap, follower, leader), 0.0);
        }
    }
}

#[test]
fn a_follower_who_brakes_comfortably_needs_its_time_gap_and_kinematics() {
    let follow = FollowingModel::IdmPlus(IdmPlus {
        acceleration: 2.0,
        deceleration: 2.0,
        time_gap: 1.0,
        jam_gap: 2.0,
        exponent: 4.0,
    });
    let with = |comfortable| Driver { comfortable, ..driver(&follow, 20.0, 40.0) };
    let [model_alone, comfortable] = [0.0, 2.0].map(with);
    // By hand: behind a leader at 16 m/s, 22 m ahead, s* = 2 + 20 + 20 · 4/(2 · 2) = 42 m: 2 (1 − (42/22)²).
    let slower = Ahead::steady(22.0, 16.0);
    assert_near(model_alone.demanded(slower), -5.289256, 1e-6);
    // Behind one as fast as itself s* = 22 m: 0. It comes to the slower one with 2 · 16/20 = 1.6 m/s², which is more
    // than 1.2 · 4²/(2 · 20).
    assert_near(comfortable.demanded(slower), -1.6, 1e-12);
    // 11 m are half of its time gap, however fast the leader: 2 (1 − 2²).
    assert_near(comfortable.demanded(Ahead::steady(11.0, 19.9)), -6.0, 1e-12);
    // Who does not close in is not braked for comfort.
    let as_fast = Ahead::steady(11.0, 20.0);
    assert_eq!(comfortable.demanded(as_fast), model_alone.demanded(as_fast));
}

#[test]
fn v41_a_gap_at_the_threshold_is_accepted_and_one_below_is_not() {
    assert_eq!(verdict(pair(15.0, 15.0, 10.0)), Ok(()));
    assert_eq!(verdict(pair(14.999, 15.0, 10.0)), Err(Refusal::TimeToCollision));
    assert_eq!(verdict(pair(8.0, 20.0, 10.0)), Err(Refusal::TimeToCollision));
    let impatient = Safety { min_time_to_collision: 0.8, ..Safety::default() };
    assert_eq!(impatient.accept(pair(8.0, 20.0, 10.0), DT), Err(Refusal::Forced));
}

#[test]
fn v41_equal_speeds_do_not_excuse_a_gap_below_the_least() {
    assert_eq!(verdict(pair(1.999, 10.0, 10.0)), Err(Refusal::Short));
    assert_eq!(verdict(pair(1.999, 10.0, 15.0)), Err(Refusal::Short));
    assert_eq!(verdict(pair(2.0, 10.0, 10.0)), Ok(()));
    assert_eq!(verdict(pair(-3.0, 0.0, 0.0)), Err(Refusal::Short));
}

#[test]
fn a_gap_may_force_a_braking_of_4_metres_per_second_squared_and_no_more() {
    // 15² / (2 · 28.125) = 4; the time to collision must not forbid it first.
    let safety = Safety { min_time_to_collision: 1.0, ..Safety::default() };
    assert_eq!(safety.accept(pair(28.125, 15.0, 0.0), DT), Ok(()));
    assert_eq!(safety.accept(pair(28.12, 15.0, 0.0), DT), Err(Refusal::Forced));
}

#[test]
fn a_gap_at_which_the_followers_own_model_would_brake_too_hard_is_refused() {
    let demanding = |demanded| GapPair { demanded, ..pair(40.0, 15.0, 15.0) };
    assert_eq!(verdict(demanding(-4.0)), Ok(()));
    assert_eq!(verdict(demanding(-4.001)), Err(Refusal::Demanded));
    assert_eq!(verdict(demanding(1.0)), Ok(()));
}

#[test]
fn a_gap_that_is_insecure_should_the_leader_brake_is_refused() {
    // v·dt = 2.5 m at 25 m/s behind an equally fast leader.
    assert_eq!(verdict(pair(2.5, 25.0, 25.0)), Ok(()));
    assert_eq!(verdict(pair(2.499, 25.0, 25.0)), Err(Refusal::Insecure));
    // (30² − 24²)/16 + 30 · 0.1 = 23.25 m, where the time to collision asks for 18 m.
    assert_eq!(verdict(pair(23.25, 30.0, 24.0)), Ok(()));
    assert_eq!(verdict(pair(23.249, 30.0, 24.0)), Err(Refusal::Insecure));
    // A longer step needs a longer gap.
    assert_eq!(Safety::default().accept(pair(23.25, 30.0, 24.0), 0.2), Err(Refusal::Insecure));
}

#[test]
fn a_critical_gap_grows_with_the_closing_speed() {
    let toledo =
        Safety { min_gap: 4.0, closing_growth: 0.3, min_time_to_collision: 0.0, ..Safety::default() };
    let critical = 4.0 * (0.3_f64 * 5.0).exp();
    assert_eq!(toledo.accept(pair(critical + 1e-6, 15.0, 10.0), DT), Ok(()));
    assert_eq!(toledo.accept(pair(critical - 1e-6, 15.0, 10.0), DT), Err(Refusal::Short));
    // Not where the gap opens.
    assert_eq!(toledo.accept(pair(4.0, 10.0, 15.0), DT), Ok(()));
}

#[test]
fn the_critical_lag_gap_is_in_the_place_of_the_lead_gap_for_the_follower_alone() {
    let safety = Safety { min_gap: 3.0, min_lag_gap: 5.0, ..Safety::default() };
    assert_eq!(safety.accept(pair(3.0, 10.0, 10.0), DT), Ok(()));
    assert_eq!(safety.of_follower().accept(pair(4.999, 10.0, 10.0), DT), Err(Refusal::Short));
    assert_eq!(safety.of_follower().accept(pair(5.0, 10.0, 10.0), DT), Ok(()));
    // It may be the shorter one. Without one both are the same.
    let bold = Safety { min_lag_gap: 2.5, ..safety };
    assert_eq!(bold.of_follower().accept(pair(2.5, 10.0, 10.0), DT), Ok(()));
    let same = Safety { min_lag_gap: 0.0, ..safety };
    assert_eq!(same.of_follower(), same);
}

#[test]
fn what_is_not_a_number_is_not_accepted() {
    let good = pair(50.0, 10.0, 10.0);
    assert_eq!(verdict(good), Ok(()));
    assert!(verdict(GapPair { gap: f64::NAN, ..good }).is_err());
    assert!(verdict(GapPair { demanded: f64::NAN, ..good }).is_err());
    assert!(verdict(GapPair { leader: f64::NAN, ..good }).is_err());
    assert!(verdict(GapPair { follower: f64::NAN, ..good }).is_err());
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_longer_gap_is_never_worse(
        gap in 0.0..80.0_f64, more in 0.0..40.0_f64, follower in 0.0..40.0_f64, leader in 0.0..40.0_f64,
        demanded in -6.0..2.0_f64,
    ) {
        let short = GapPair { demanded, ..pair(gap, follower, leader) };
        prop_assume!(verdict(short).is_ok());
        prop_assert_eq!(verdict(GapPair { gap: gap + more, ..short }), Ok(()));
    }
}
