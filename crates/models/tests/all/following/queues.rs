//! Queues: how they start when a light turns green, and how their ends move.

use laneweave_models::follow::{FollowingModel, Idm};

use crate::following::cars::{Car, LENGTH};

/// All vehicles but the first follow for a step of `dt` [s].
fn follow(model: &FollowingModel, desired: f64, cars: &mut [Car], dt: f64) {
    let before = cars.to_vec();
    for (car, leader) in cars[1..].iter_mut().zip(&before) {
        *car = car.moved(car.wish(model, desired, Some(*leader)), dt);
    }
}

/// Times [s] after the beginning of green at which the fronts of a standing queue pass the line; the first vehicle
/// stands at the line.
fn passages(model: FollowingModel, desired: f64, cars: usize) -> Vec<f64> {
    const DT: f64 = 0.01;
    let jam_gap = 2.0;
    let mut queue: Vec<Car> = (0..cars).map(|it| Car::at(-(LENGTH + jam_gap) * it as f64, 0.0)).collect();
    let mut passed = vec![0.0];
    let mut time = 0.0;
    while passed.len() < cars {
        follow(&model, desired, &mut queue, DT);
        queue[0] = queue[0].moved(queue[0].wish(&model, desired, None), DT);
        time += DT;
        let next = &queue[passed.len()];
        if next.position >= 0.0 {
            passed.push(time - next.position / next.speed);
        }
    }
    passed
}

#[track_caller]
fn assert_within(value: f64, expected: f64, share: f64) {
    assert!((value / expected - 1.0).abs() <= share, "{value} is not {expected} within {share}");
}

#[test]
fn v22_a_queue_discharges_at_the_published_headways() {
    let town = 50.0 / 3.6;
    let usual = Idm { acceleration: 1.0, deceleration: 1.5, time_gap: 1.0, ..Idm::default() };
    let passed = passages(FollowingModel::Idm(usual), town, 21);
    // The first headway is that between the first two.
    for (number, expected) in [(5, 2.499), (10, 2.163), (20, 1.988)] {
        assert_within(passed[number] - passed[number - 1], expected, 0.02);
    }
    let livelier = Idm { acceleration: 1.5, deceleration: 2.0, time_gap: 1.2, ..Idm::default() };
    let passed = passages(FollowingModel::Idm(livelier), town, 21);
    assert_within(passed[20] - passed[19], 2.116, 0.02);
}

#[test]
fn v24_the_end_of_a_queue_moves_as_flow_and_density_say() {
    const DT: f64 = 0.05;
    const CARS: usize = 120;
    // 15 veh/km at 1500 veh/h run into 90 veh/km at 900 veh/h: 100 km/h into 10 km/h.
    let (fast, slow) = (100.0 / 3.6, 10.0 / 3.6);
    let (far, near) = (1000.0 / 15.0, 1000.0 / 90.0);
    // IDM drivers in equilibrium in both states, as far as the desired speed does not affect the slow state.
    let jam_gap = 2.0;
    let time_gap = (near - LENGTH - jam_gap) / slow;
    let share = (jam_gap + fast * time_gap) / (far - LENGTH);
    let desired = fast / (1.0 - share * share).powf(0.25);
    let idm = Idm { acceleration: 1.4, deceleration: 2.0, time_gap, jam_gap, exponent: 4.0 };
    let model = FollowingModel::Idm(idm);
    let mut cars: Vec<Car> = (0..CARS).map(|it| Car::at(-far * it as f64, fast)).collect();
    // When and where each vehicle first drives at less than the mean of the two speeds.
    let mut joined: Vec<Option<(f64, f64)>> = vec![None; CARS];
    for step in 0..24_000 {
        follow(&model, desired, &mut cars, DT);
        let braking = if cars[0].speed > slow { -1.0 } else { 0.0 };
        cars[0] = cars[0].moved(braking, DT);
        for (car, joined) in cars.iter().zip(&mut joined) {
            if joined.is_none() && car.speed < 0.5 * (fast + slow) {
                *joined = Some((f64::from(step) * DT, car.position));
            }
        }
    }
    let [from, to] = [20, CARS - 1].map(|it| joined[it].expect("it has come to the queue"));
    assert_within((to.1 - from.1) / (to.0 - from.0), -8.0 / 3.6, 0.1);
}
