//! Drivers who react late: Newell's to the place of the leader, Herman's to its speed.

use std::f64::consts::TAU;

use laneweave_models::follow::{FollowingModel, Newell};

use crate::following::cars::{Car, LENGTH};
use crate::following::ring::Complex;
use crate::near::assert_near;

#[test]
fn v20_newell_drivers_follow_their_leaders_path_shifted_in_time_and_space() {
    const CARS: usize = 12;
    const DESIRED: f64 = 33.0;
    let newell = Newell::default();
    let (model, time_gap) = (FollowingModel::Newell(newell), newell.time_gap);
    let distance = LENGTH + newell.jam_gap;
    // A standing column; its leader drives freely, and accelerates evenly within each step of τ.
    let mut paths = vec![(0..CARS).map(|i| Car::at(-distance * i as f64, 0.0)).collect::<Vec<_>>()];
    for step in 0..200 {
        let now = paths.last().expect("it has begun");
        let wanted = 12.0 * (1.0 - (0.31 * f64::from(step)).cos()) + 3.0 * (1.7 * f64::from(step)).sin();
        let first = (wanted.max(0.0) - now[0].speed) / time_gap;
        let others = now.windows(2).map(|pair| pair[1].wish(&model, DESIRED, Some(pair[0])));
        let wishes = std::iter::once(first).chain(others);
        paths.push(now.iter().zip(wishes).map(|(car, wish)| car.moved(wish, time_gap)).collect());
    }
    for pair in paths.windows(2) {
        for car in 1..CARS {
            assert_near(pair[1][car].position, pair[0][car - 1].position - distance, 1e-9);
            assert_near(pair[1][car].speed, pair[0][car - 1].speed, 1e-9);
        }
    }
    assert!(paths[200][CARS - 1].position > 1000.0, "nobody moved");
}

#[test]
fn v20_newell_drivers_go_as_fast_as_they_like_where_nobody_is_in_the_way() {
    let (model, time_gap) = (FollowingModel::Newell(Newell::default()), Newell::default().time_gap);
    let (mut leader, mut car) = (Car::at_gap(200.0, 14.0), Car::at(0.0, 12.0));
    for _ in 0..20 {
        let before = car;
        car = car.moved(car.wish(&model, 12.0, Some(leader)), time_gap);
        leader = leader.moved(0.0, time_gap);
        assert_near(car.position - before.position, 12.0 * time_gap, 1e-9);
    }
}

/// Speeds [m/s] at steps of [`STEP`] of a driver who responds to its leader's relative speed a time T = 1 s later:
/// dv/dt = λ (v_l − v)(t − T), Herman et al. (1959). Before the beginning both drive at 0.
fn herman(sensitivity: f64, leader: &[f64]) -> Vec<f64> {
    let mut speeds = vec![0.0];
    let relative = |speeds: &[f64], at: usize| -> f64 {
        at.checked_sub(DELAY).map_or(0.0, |then| leader[then] - speeds[then])
    };
    for at in 1..leader.len() {
        let mean = 0.5 * (relative(&speeds, at - 1) + relative(&speeds, at));
        speeds.push(speeds[at - 1] + STEP * sensitivity * mean);
    }
    speeds
}

const STEP: f64 = 0.01;
/// T, in steps.
const DELAY: usize = 100;

/// The response of the driver to a leader whose speed jumps from 0 to 1 m/s.
fn step_response(sensitivity: f64, seconds: f64) -> Vec<f64> {
    herman(sensitivity, &vec![1.0; (seconds / STEP) as usize])
}

#[test]
fn v21_below_one_over_e_a_late_driver_does_not_oscillate() {
    let is_monotone = |speeds: &[f64]| speeds.windows(2).all(|pair| pair[1] >= pair[0] - 1e-12);
    let calm = step_response(0.3, 60.0);
    assert!(is_monotone(&calm));
    assert_near(calm[calm.len() - 1], 1.0, 1e-6);
    let nervous = step_response(0.45, 60.0);
    assert!(!is_monotone(&nervous));
    let highest = |speeds: &[f64]| speeds.iter().copied().fold(0.0, f64::max);
    // 1 − u at its highest, u(t) = Σ_(k ≤ t) (−λ)^k (t − k)^k / k!; the next follower swings further, though gains
    // are below 1.
    assert_near(highest(&nervous), 1.013587, 2e-6);
    assert_near(highest(&herman(0.45, &nervous)), 1.017006, 2e-6);
}

/// How much higher than its leader a late driver swings; the leader's speed swings with `frequency` [1/s].
fn herman_gain(sensitivity: f64, frequency: f64) -> f64 {
    const SETTLED: f64 = 200.0;
    let period = TAU / frequency;
    let measured = ((10.0 * period) / STEP).round() as usize;
    let steps = (SETTLED / STEP) as usize + measured;
    let leader: Vec<_> = (0..steps).map(|at| (frequency * at as f64 * STEP).sin()).collect();
    let follower = herman(sensitivity, &leader);
    let height = |speeds: &[f64]| {
        let turned = (steps - measured..steps)
            .map(|at| Complex::on_circle(-frequency * at as f64 * STEP).scaled(speeds[at]));
        turned.fold(Complex::on_circle(0.0).scaled(0.0), Complex::plus).size()
    };
    height(&follower) / height(&leader)
}

#[test]
fn v21_below_one_half_late_drivers_damp_what_their_leaders_do() {
    for (sensitivity, gains) in
        [(0.45, [0.989694, 0.924825, 0.674445]), (0.8, [1.018942, 1.124133, 1.476310])]
    {
        for (frequency, gain) in [0.2, 0.5, 1.0].into_iter().zip(gains) {
            assert_near(herman_gain(sensitivity, frequency), gain, 1e-4);
        }
    }
}

#[test]
fn v21_from_half_pi_on_a_late_driver_diverges() {
    let swing = |sensitivity: f64| {
        let speeds = step_response(sensitivity, 200.0);
        let largest = |part: &[f64]| part.iter().map(|it| (it - 1.0).abs()).fold(0.0, f64::max);
        let tenth = speeds.len() / 10;
        largest(&speeds[speeds.len() - tenth..]) / largest(&speeds[..tenth])
    };
    assert!(swing(0.8) < 1e-6);
    assert!(swing(1.5) < 0.1);
    assert!(swing(1.7) > 100.0);
}
