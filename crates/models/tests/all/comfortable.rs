//! Comfortable braking above the car-following models: exact numbers, and what it promises for every situation.

use laneweave_models::Reading;
use laneweave_models::comfortable::comfortably;
use laneweave_models::follow::{Ahead, CarFollowing, FollowingModel, Fvdm, Idm, Pace};
use proptest::prelude::*;

fn fvdm() -> FollowingModel {
    FollowingModel::Fvdm(Fvdm { jam_gap: 1.5, reading: Reading::Repaired, ..Fvdm::default() })
}

fn idm() -> FollowingModel {
    FollowingModel::Idm(Idm {
        acceleration: 1.4,
        deceleration: 2.0,
        time_gap: 1.2,
        jam_gap: 2.0,
        exponent: 4.0,
    })
}

/// The acceleration of a driver at `speed` who wants `desired` [m/s], with comfortable braking of 2 m/s².
fn chosen(model: &FollowingModel, speed: f64, desired: f64, ahead: Ahead) -> f64 {
    let pace = Pace::new(speed, desired);
    comfortably(model, 2.0, pace, ahead, model.acceleration(pace, Some(ahead)))
}

fn assert_near(value: f64, expected: f64) {
    assert!((value - expected).abs() < 1e-9, "{value} is not {expected}");
}

#[test]
fn a_standing_queue_is_approached_with_little_more_braking_than_it_needs() {
    let queue = Ahead::standing(101.5);
    let wish = fvdm().acceleration(Pace::new(14.0, 15.0), Some(queue));
    assert!(wish < -6.0, "the model alone: {wish}");
    // 14² / (2 · 100) = 0.98, a fifth more is allowed.
    assert_near(chosen(&fvdm(), 14.0, 15.0, queue), -1.2 * 0.98);
    // 14² / (2 · 40) = 2.45.
    assert_near(chosen(&fvdm(), 14.0, 15.0, Ahead::standing(41.5)), -1.2 * 2.45);
}

#[test]
fn a_driver_brakes_no_later_than_comfortable_braking_is_needed() {
    let blind = FollowingModel::Fvdm(Fvdm { relative_sensitivity: 0.0, jam_gap: 1.5, ..Fvdm::default() });
    let wish = blind.acceleration(Pace::new(20.0, 20.0), Some(Ahead::standing(81.5)));
    assert!(wish > -0.5, "the model alone: {wish}");
    // 20² / (2 · 80) = 2.5.
    assert_near(chosen(&blind, 20.0, 20.0, Ahead::standing(81.5)), -2.5);
    assert!(chosen(&blind, 20.0, 20.0, Ahead::standing(121.5)) > -0.01);
}

#[test]
fn a_vehicle_that_cuts_in_as_fast_as_the_driver_is_left_to_drive_away_gently() {
    assert!(idm().acceleration(Pace::new(20.0, 30.0), Some(Ahead::steady(5.0, 20.0))) < -30.0);
    assert_near(chosen(&idm(), 20.0, 30.0, Ahead::steady(5.0, 20.0)), -2.0);
    // Half as fast: 10² / (2 · 28) with a fifth more is more than the gentle 2 · 10/20.
    assert_near(chosen(&fvdm(), 20.0, 30.0, Ahead::steady(29.5, 10.0)), -1.2 * 100.0 / 56.0);
}

#[test]
fn a_leader_who_brakes_is_followed_as_hard_as_it_takes() {
    // It stands after 20²/16 = 25 m: 20² / (2 · (38 + 25)) = 3.1746.
    let braking = Ahead { acceleration: -8.0, ..Ahead::steady(40.0, 20.0) };
    let hardest = -1.2 * 400.0 / 126.0;
    let pace = Pace::new(20.0, 30.0);
    assert_near(comfortably(&idm(), 2.0, pace, braking, -8.0), hardest);
    // One that brakes gently, far away: as it brakes, and the speed difference over the gap.
    let gently = Ahead { acceleration: -1.0, ..Ahead::steady(102.0, 20.0) };
    let needed: f64 = 25.0 * 25.0 / (2.0 * (100.0 + 200.0));
    assert_near(comfortably(&idm(), 2.0, Pace::new(25.0, 30.0), gently, -8.0), -(1.2 * needed).max(1.6));
}

#[test]
fn without_comfortable_braking_the_model_alone_decides() {
    let (pace, queue) = (Pace::new(14.0, 15.0), Ahead::standing(100.0));
    let wish = fvdm().acceleration(pace, Some(queue));
    assert_eq!(comfortably(&fvdm(), 0.0, pace, queue, wish), wish);
}

proptest! {
    #[test]
    fn whoever_follows_the_bound_stops_behind_a_standing_vehicle(
        speed in 1.0..45.0_f64, spare in 0.0..250.0_f64, is_idm in any::<bool>(),
    ) {
        let model = if is_idm { idm() } else { fvdm() };
        // Comfortable braking is still enough.
        let (mut speed, mut gap) = (speed, 4.0 + speed * speed / 4.0 + spare);
        let (dt, desired) = (0.05, speed.max(10.0));
        let mut hardest: f64 = 0.0;
        for _ in 0..6000 {
            let acceleration = chosen(&model, speed, desired, Ahead::standing(gap)).max(-speed / dt);
            hardest = hardest.max(-acceleration);
            gap -= (speed + 0.5 * acceleration * dt) * dt;
            speed += acceleration * dt;
            prop_assert!(gap > 0.0, "speed {speed}");
        }
        prop_assert!(hardest < 3.0, "braked with {hardest}");
    }
}
