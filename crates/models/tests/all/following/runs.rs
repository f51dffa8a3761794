//! Runs with exact ends: acceleration from rest, followers who settle, rings in equilibrium, obstacles.

use laneweave_models::follow::{CarFollowing, FollowingModel, Fvdm, Pace};

use crate::following::cars::{Car, LENGTH};
use crate::following::ring::Ring;
use crate::following::sets::{Published, k2010, literal_fvdm, t2000, urban};
use crate::following::stops::emergency;
use crate::near::assert_near;

/// A step of `dt` [s] on a free road.
type FreeStep = fn(&Published, Car, f64) -> Car;

fn free_acceleration(set: &Published, speed: f64) -> f64 {
    set.idm.acceleration(Pace::new(speed, set.desired), None)
}

/// First order in `dt`.
fn euler(set: &Published, car: Car, dt: f64) -> Car {
    car.moved(free_acceleration(set, car.speed), dt)
}

/// Second order in `dt`.
fn heun(set: &Published, car: Car, dt: f64) -> Car {
    let first = free_acceleration(set, car.speed);
    let second = free_acceleration(set, car.speed + first * dt);
    car.moved(0.5 * (first + second), dt)
}

/// Time [s] and place [m] at which a car that starts from rest reaches `share` of its desired speed.
fn from_rest(set: &Published, share: f64, dt: f64, step: FreeStep) -> (f64, f64) {
    let target = share * set.desired;
    let (mut time, mut car) = (0.0, Car::at(0.0, 0.0));
    loop {
        let next = step(set, car, dt);
        if next.speed >= target {
            let part = (target - car.speed) / (next.speed - car.speed);
            return (time + part * dt, car.position + part * (next.position - car.position));
        }
        (time, car) = (time + dt, next);
    }
}

#[test]
fn v5_free_acceleration_takes_the_exact_time_and_distance() {
    let tables = [
        (
            t2000(),
            [(0.5, 23.126798, 194.378091), (0.9, 50.343256, 857.708543), (0.99, 78.242591, 1750.450113)],
        ),
        (
            k2010(),
            [(0.5, 12.058973, 101.354290), (0.9, 26.250412, 447.233740), (0.99, 40.797923, 912.734702)],
        ),
        (urban(), [(0.5, 7.034401, 24.634723), (0.9, 15.312740, 108.702645), (0.99, 23.798788, 221.845240)]),
    ];
    for (set, table) in tables {
        for (share, time, distance) in table {
            let (took, went) = from_rest(&set, share, 0.01, heun);
            assert_near(took, time, 1e-5 * time);
            assert_near(went, distance, 1e-5 * distance);
        }
    }
}

#[test]
fn v6_halving_the_step_halves_the_error() {
    let error = |dt| from_rest(&k2010(), 0.9, dt, euler).0 - 26.250412;
    let errors = [0.4, 0.2, 0.1, 0.05].map(error);
    for (error, published) in errors.into_iter().zip([-0.212109, -0.106117, -0.053322, -0.026639]) {
        assert_near(error, published, 2e-4);
    }
    for pair in errors.windows(2) {
        assert_near(pair[0] / pair[1], 2.0, 0.1);
    }
}

#[test]
fn v7_a_follower_settles_at_the_equilibrium_gap() {
    const DT: f64 = 0.1;
    for (set, speed, gap) in [
        (t2000(), 5.0, 10.002532),
        (t2000(), 20.0, 36.443449),
        (k2010(), 10.0, 17.069271),
        (k2010(), 30.0, 80.145985),
        (urban(), 5.0, 7.059538),
        (urban(), 10.0, 14.032819),
    ] {
        let (mut leader, mut follower) = (Car::at_gap(2.0 * gap, speed), Car::at(0.0, 0.7 * speed));
        for _ in 0..30_000 {
            follower = follower.moved(follower.wish(&set.model(), set.desired, Some(leader)), DT);
            leader = leader.moved(0.0, DT);
        }
        assert_near(follower.behind(leader).gap, gap, 1e-3);
    }
}

#[test]
fn v8_a_ring_in_equilibrium_stays_there() {
    const DT: f64 = 0.1;
    for (model, desired, speed) in [
        (k2010().model(), k2010().desired, 3.0),
        (k2010().model(), k2010().desired, 20.0),
        (t2000().model(), t2000().desired, 25.0),
        (urban().model(), urban().desired, 10.0),
        (literal_fvdm(), 20.0, 13.5),
        (FollowingModel::Fvdm(Fvdm::default()), 120.0 / 3.6, 30.0),
    ] {
        let gap = model.equilibrium_gap(Pace::new(speed, desired));
        let mut ring = Ring::new(model, desired, gap, speed);
        for _ in 0..10_000 {
            ring.advance(DT);
        }
        for car in &ring.cars {
            assert_near(car.speed, speed, 1e-9);
        }
    }
}

#[test]
fn v9_rings_of_ten_densities_flow_as_the_fundamental_diagram_says() {
    const DT: f64 = 0.1;
    let set = k2010();
    let idm_gap = |speed: f64| {
        let free = 1.0 - (speed / set.desired).powi(4);
        (set.idm.jam_gap + speed * set.idm.time_gap) / free.sqrt()
    };
    let idm_speed = |gap: f64| {
        let (mut low, mut high) = (0.0, set.desired);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if idm_gap(middle) < gap { low = middle } else { high = middle }
        }
        low
    };
    let fvdm_speed = |gap: f64| 6.75 + 7.91 * (0.13 * gap - 1.57).tanh();
    // [veh/km]
    for density in [8.0, 12.0, 16.0, 20.0, 25.0, 30.0, 75.0, 85.0, 100.0, 120.0] {
        let gap = 1000.0 / density - LENGTH;
        let cases: [(_, _, f64); 2] =
            [(set.model(), set.desired, idm_speed(gap)), (literal_fvdm(), 20.0, fvdm_speed(gap))];
        for (model, desired, speed) in cases {
            let mut ring = Ring::new(model, desired, gap, 0.5 * speed);
            for _ in 0..5_000 {
                ring.advance(DT);
            }
            assert_near(density * ring.mean_speed(), density * speed, 5e-3 * density * speed);
        }
    }
}

#[test]
fn v16_an_approach_to_a_standing_obstacle_ends_at_the_jam_gap() {
    let set = k2010();
    for (speed, gap, final_gap, braking) in [
        (20.0, 200.0, 1.997, 2.096511),
        (20.0, 100.0, 1.997, 2.199363),
        (20.0, 60.0, 1.997, 7.710009),
        (30.0, 300.0, 1.997, 2.170436),
        (30.0, 150.0, 1.997, 5.728910),
    ] {
        let stop = emergency(set.model(), set.desired, speed, Car::at_gap(gap, 0.0), 0.0, 0.01);
        assert_near(stop.final_gap, final_gap, 0.02);
        assert_near(stop.hardest_braking, braking, 0.02 * braking);
    }
    let stop = emergency(literal_fvdm(), 14.66, 14.0, Car::at_gap(150.0, 0.0), 0.0, 0.01);
    assert_near(stop.final_gap, 2.3204, 0.02);
    assert_near(stop.hardest_braking, 7.187, 0.02 * 7.187);
}
