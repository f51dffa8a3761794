//! The lateral motion, and headway relaxation around a lane change.

use crate::near::assert_near;
use laneweave_models::lateral::{
    Crossing, LateralModel, moved_share, peak_lateral_acceleration, peak_lateral_speed,
};
use laneweave_models::{Attention, Manner};

/// Lane width [m] and duration [s] of the worked change.
const WIDTH: f64 = 3.5;
const DURATION: f64 = 4.0;

#[test]
fn v46_the_peaks_of_a_quintic_change() {
    assert_near(peak_lateral_speed(WIDTH, DURATION), 1.640625, 1e-5);
    assert_near(peak_lateral_acceleration(WIDTH, DURATION), 1.262954, 1e-5);
}

#[test]
fn v46_the_path_itself_has_these_peaks() {
    const STEPS: usize = 4000;
    let dt = DURATION / STEPS as f64;
    let place = |step: usize| WIDTH * moved_share(step as f64 / STEPS as f64);
    let (mut speed, mut acceleration) = (0.0_f64, 0.0_f64);
    for step in 1..STEPS {
        let (before, now, after) = (place(step - 1), place(step), place(step + 1));
        speed = speed.max((after - before) / (2.0 * dt));
        acceleration = acceleration.max(((after - now) - (now - before)).abs() / (dt * dt));
    }
    assert_near(speed, 1.640625, 1e-5);
    assert_near(acceleration, 1.262954, 1e-5);
}

#[test]
fn v46_the_path_starts_and_ends_at_rest_and_crosses_halfway() {
    assert_eq!(moved_share(0.0), 0.0);
    assert_eq!(moved_share(0.5), 0.5);
    assert_eq!(moved_share(1.0), 1.0);
    assert_eq!(moved_share(-0.2), 0.0);
    assert_eq!(moved_share(1.2), 1.0);
    for progress in [0.05, 0.2, 0.4] {
        assert_near(moved_share(progress) + moved_share(1.0 - progress), 1.0, 1e-12);
    }
    // Neither lateral speed nor acceleration at the ends: y grows with the cube.
    assert_near(moved_share(1e-4), 1e-11, 1e-14);
}

#[test]
fn every_lateral_model_goes_from_one_lane_to_the_other_and_crosses_halfway() {
    for model in [LateralModel::Quintic] {
        let shares: Vec<f64> = (0..=100).map(|it| model.moved_share(f64::from(it) / 100.0)).collect();
        assert_eq!((shares[0], shares[50], shares[100]), (0.0, 0.5, 1.0), "{model:?}");
        assert!(shares.is_sorted(), "{model:?}");
        assert_eq!((model.moved_share(-0.2), model.moved_share(1.2)), (0.0, 1.0), "{model:?}");
        let truck = Crossing { speed: 20.0, length: 12.0, duration: DURATION };
        for progress in [0.0, 0.3, 0.5, 0.9, 1.0] {
            let [front, rear] = model.bumpers(truck, progress);
            assert!(front >= rear && (0.0..=1.0).contains(&front) && rear >= 0.0, "{model:?} at {progress}");
        }
    }
}

#[test]
fn a_slow_vehicle_needs_way_not_time() {
    let car = |speed| Crossing { speed, length: 4.5, duration: DURATION };
    assert_eq!(
        (car(20.0).way(), car(20.0).pace(), car(20.0).progress_in(0.1, 0.0)),
        (80.0, 1.0, 0.1 / DURATION)
    );
    // 12 m at 2 m/s take 6 s.
    assert_eq!((car(2.0).way(), car(2.0).least_way()), (12.0, 12.0));
    assert_near(car(2.0).pace(), 2.0 / 3.0, 1e-12);
    assert_near(car(2.0).progress_in(1.0, 0.0), 1.0 / 6.0, 1e-12);
    assert_eq!(Crossing { length: 12.0, ..car(0.0) }.way(), 18.0);
}

#[test]
fn a_vehicle_that_stands_does_not_move_sideways() {
    let car = |speed| Crossing { speed, length: 4.5, duration: DURATION };
    for per_metre in [0.0, 0.5, 20.0] {
        assert_eq!((car(0.0).pace(), car(0.09).progress_in(0.1, per_metre)), (0.0, 0.0));
    }
}

#[test]
fn a_slow_vehicle_with_little_road_is_across_at_its_end() {
    let (length, duration, dt, road) = (4.5, DURATION, 0.01, 2.0);
    let (mut progress, mut way) = (0.0, 0.0);
    while progress < 1.0 {
        let per_metre = (1.0 - progress) / (road - way);
        let speed = Crossing { speed: 0.0, length, duration }.fastest(per_metre);
        progress += Crossing { speed, length, duration }.progress_in(dt, per_metre);
        way += speed * dt;
        assert!(way <= 1.01 * road, "{progress} after {way} m");
    }
    // It takes as long as any change.
    assert_near(way / (road / duration), duration, 0.02);
}

/// T_max of the worked example [s].
const RELAXED: f64 = 1.2;

#[test]
fn a_desire_of_three_fifths_accepts_a_time_gap_of_0_816_s() {
    let manner = Manner::default();
    assert_near(RELAXED * manner.headway_relaxation(0.6), 0.816, 1e-12);
    assert_near(RELAXED * manner.headway_relaxation(1.0), 0.56, 1e-12);
    assert_eq!(manner.headway_relaxation(0.0), 1.0);
    assert_eq!(manner.headway_relaxation(-2.0), 1.0);
    assert_eq!(manner.headway_relaxation(7.0), manner.headway_relaxation(1.0));
}

#[test]
fn an_accepted_short_gap_relaxes_exponentially() {
    let after_25_seconds = |steps: u32| {
        let manner = Manner::default();
        RELAXED
            * (0..steps).fold(manner.headway_relaxation(1.0), |share, _| {
                manner.relaxed(share, 25.0 / f64::from(steps))
            })
    };
    assert_near(after_25_seconds(2_500_000), 0.964557, 1e-6);
    let errors = [125, 250, 500].map(|steps| after_25_seconds(steps) - 0.964557);
    for pair in errors.windows(2) {
        assert_near(pair[0] / pair[1], 2.0, 0.1);
    }
    // A step longer than the relaxation time ends at the usual time gap, not beyond.
    assert_eq!(Manner::default().relaxed(0.5, 100.0), 1.0);
}

#[test]
fn the_defaults_are_those_that_the_field_uses() {
    let manner = Manner::default();
    assert_eq!(Attention::default().epoch, 1.0);
    assert!((3.0..=5.0).contains(&manner.change_duration));
    assert!((8.0..=10.0).contains(&manner.calm));
    assert_eq!((manner.adjust_deceleration, manner.yield_deceleration), (2.0, 2.0));
}
