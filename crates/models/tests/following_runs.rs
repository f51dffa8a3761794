//! Car-following over time: acceleration from rest, platoons, rings, obstacles, emergency stops.

mod parameter_sets;

use laneweave_models::Reading;
use laneweave_models::braking::{HARDEST_BRAKING, is_secure, secure_speed};
use laneweave_models::follow::{Ahead, CarFollowing, FollowingModel, Fvdm, Pace};
use parameter_sets::{Published, k2010, t2000, urban};
use proptest::prelude::*;

/// Net length of every vehicle [m].
const LENGTH: f64 = 5.0;

#[track_caller]
fn assert_near(value: f64, expected: f64, tolerance: f64) {
    assert!((value - expected).abs() <= tolerance, "{value} is not {expected} within {tolerance}");
}

/// A vehicle on a line.
#[derive(Clone, Copy, Debug)]
struct Car {
    /// Front bumper [m].
    position: f64,
    /// Speed [m/s].
    speed: f64,
}

impl Car {
    /// The car after `dt` [s] at a constant acceleration [m/s²]; it stops within the step if it must.
    fn moved(self, acceleration: f64, dt: f64) -> Car {
        let speed = self.speed + acceleration * dt;
        if speed >= 0.0 {
            Car { position: self.position + 0.5 * (self.speed + speed) * dt, speed }
        } else {
            let braking = self.speed * self.speed / (-2.0 * acceleration);
            Car { position: self.position + braking, speed: 0.0 }
        }
    }

    fn behind(self, leader: Car) -> Ahead {
        Ahead { gap: leader.position - LENGTH - self.position, speed: leader.speed }
    }
}

/// What became of a follower whose leader brakes at 8 m/s² until it stands.
struct Stop {
    shortest_gap: f64,
    final_gap: f64,
    hardest_braking: f64,
}

/// A follower at `speed` [m/s] whose leader, as fast, `gap` [m] ahead, brakes at `leader_braking` [m/s²].
fn emergency(
    model: FollowingModel,
    desired: f64,
    speed: f64,
    leader: Car,
    leader_braking: f64,
    dt: f64,
) -> Stop {
    const LONG: f64 = 60.0;
    let (mut leader, mut follower) = (leader, Car { position: 0.0, speed });
    let mut stop = Stop { shortest_gap: f64::INFINITY, final_gap: 0.0, hardest_braking: 0.0 };
    for _ in 0..(LONG / dt) as usize {
        let ahead = follower.behind(leader);
        let acceleration = model.acceleration(Pace::new(follower.speed, desired), Some(ahead));
        follower = follower.moved(acceleration, dt);
        leader = leader.moved(-leader_braking, dt);
        stop.final_gap = follower.behind(leader).gap;
        stop.shortest_gap = stop.shortest_gap.min(stop.final_gap);
        if follower.speed > 0.0 {
            stop.hardest_braking = stop.hardest_braking.max(-acceleration);
        }
    }
    stop
}

/// A car `gap` [m] ahead of a follower at 0.
fn at_gap(gap: f64, speed: f64) -> Car {
    Car { position: gap + LENGTH, speed }
}

fn literal_fvdm() -> FollowingModel {
    FollowingModel::Fvdm(Fvdm { reading: Reading::Literal, ..Fvdm::default() })
}

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
    let (mut time, mut car) = (0.0, Car { position: 0.0, speed: 0.0 });
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
        let (mut leader, mut follower) =
            (at_gap(2.0 * gap, speed), Car { position: 0.0, speed: 0.7 * speed });
        for _ in 0..30_000 {
            let ahead = follower.behind(leader);
            let pace = Pace::new(follower.speed, set.desired);
            follower = follower.moved(set.idm.acceleration(pace, Some(ahead)), DT);
            leader = leader.moved(0.0, DT);
        }
        assert_near(follower.behind(leader).gap, gap, 1e-3);
    }
}

/// Identical cars on a ring.
struct Ring {
    model: FollowingModel,
    desired: f64,
    circumference: f64,
    cars: Vec<Car>,
}

impl Ring {
    const CARS: usize = 100;

    fn new(model: FollowingModel, desired: f64, gap: f64, speed: f64) -> Ring {
        let spacing = gap + LENGTH;
        let cars = (0..Ring::CARS).map(|i| Car { position: i as f64 * spacing, speed }).collect();
        Ring { model, desired, circumference: Ring::CARS as f64 * spacing, cars }
    }

    fn advance(&mut self, dt: f64) {
        let before = self.cars.clone();
        for (i, car) in self.cars.iter_mut().enumerate() {
            let lap = if i + 1 == before.len() { self.circumference } else { 0.0 };
            let leader = before[(i + 1) % before.len()];
            let ahead = car.behind(Car { position: leader.position + lap, ..leader });
            *car = car.moved(self.model.acceleration(Pace::new(car.speed, self.desired), Some(ahead)), dt);
        }
    }

    fn mean_speed(&self) -> f64 {
        self.cars.iter().map(|car| car.speed).sum::<f64>() / self.cars.len() as f64
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
        let stop = emergency(set.model(), set.desired, speed, at_gap(gap, 0.0), 0.0, 0.01);
        assert_near(stop.final_gap, final_gap, 0.02);
        assert_near(stop.hardest_braking, braking, 0.02 * braking);
    }
    let stop = emergency(literal_fvdm(), 14.66, 14.0, at_gap(150.0, 0.0), 0.0, 0.01);
    assert_near(stop.final_gap, 2.3204, 0.02);
    assert_near(stop.hardest_braking, 7.187, 0.02 * 7.187);
}

#[test]
fn v17_an_idm_driver_survives_a_leader_who_brakes_as_hard_as_possible() {
    for set in [t2000(), k2010()] {
        let gap = set.model().equilibrium_gap(Pace::new(20.0, set.desired));
        for dt in [0.01, 0.05, 0.1, 0.2, 0.25] {
            let stop = emergency(set.model(), set.desired, 20.0, at_gap(gap, 20.0), HARDEST_BRAKING, dt);
            assert!(stop.shortest_gap > 0.0, "dt {dt}: gap {}", stop.shortest_gap);
        }
    }
    let set = k2010();
    let gap = set.model().equilibrium_gap(Pace::new(20.0, set.desired));
    let stop = emergency(set.model(), set.desired, 20.0, at_gap(gap, 20.0), HARDEST_BRAKING, 0.01);
    assert_near(stop.final_gap, 1.997, 0.02);
    assert_near(stop.hardest_braking, 6.204, 0.02 * 6.204);
}

/// The shortest gap [m] of a literal FVDM follower at `speed` [m/s] that does not end in a collision.
fn shortest_safe_gap(speed: f64, leader_speed: f64) -> f64 {
    let collides = |gap: f64| {
        emergency(literal_fvdm(), 50.0, speed, at_gap(gap, leader_speed), HARDEST_BRAKING, 0.002).shortest_gap
            < 0.0
    };
    let (mut short, mut long) = (1.0, 60.0);
    while long - short > 1e-3 {
        let middle = 0.5 * (short + long);
        if collides(middle) { short = middle } else { long = middle }
    }
    long
}

#[test]
fn v17_fvdm_alone_collides_below_the_published_gaps() {
    for (speed, behind_braking, behind_standing) in
        [(10.0, 9.792, 11.992), (13.0, 14.637, 17.097), (14.0, 16.673, 18.914)]
    {
        assert_near(shortest_safe_gap(speed, speed), behind_braking, 0.05);
        assert_near(shortest_safe_gap(speed, 0.0), behind_standing, 0.05);
    }
}

#[test]
fn v17_fvdm_survives_from_its_own_equilibrium() {
    for (speed, gap, left, braking) in
        [(10.0, 15.436, 1.363, 4.42), (13.0, 20.322, 1.009, 5.13), (14.0, 24.131, 1.334, 4.89)]
    {
        let equilibrium = literal_fvdm().equilibrium_gap(Pace::new(speed, 50.0));
        assert_near(equilibrium, gap, 1e-3);
        let stop = emergency(literal_fvdm(), 50.0, speed, at_gap(equilibrium, speed), HARDEST_BRAKING, 0.01);
        assert_near(stop.shortest_gap, left, 0.02);
        assert_near(stop.hardest_braking, braking, 0.02);
    }
}

fn any_model() -> impl Strategy<Value = FollowingModel> {
    prop_oneof![
        Just(t2000().model()),
        Just(k2010().model()),
        Just(urban().model()),
        Just(literal_fvdm()),
        Just(FollowingModel::Fvdm(Fvdm::default())),
    ]
}

/// One step of a driver whom the kinematic bound keeps secure, and who cannot brake harder than a vehicle can.
fn bounded_step(model: FollowingModel, desired: f64, car: Car, ahead: Ahead, dt: f64) -> Car {
    let wanted = car.speed + model.acceleration(Pace::new(car.speed, desired), Some(ahead)) * dt;
    let hardest = car.speed - HARDEST_BRAKING * dt;
    let next = wanted.min(secure_speed(car.speed, ahead, dt)).max(hardest).max(0.0);
    car.moved((next - car.speed) / dt, dt)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn v17_and_v18_from_a_secure_start_nobody_collides_under_the_kinematic_bound(
        model in any_model(), desired in 5.0..50.0_f64, speed in 0.0..40.0_f64, leader_speed in 0.0..40.0_f64,
        spare in 0.0..30.0_f64, dt in 0.02..0.5_f64,
        actions in prop::collection::vec((-HARDEST_BRAKING..3.0_f64, 1_usize..40), 1..20),
    ) {
        let lead = (speed * speed - leader_speed * leader_speed) / (2.0 * HARDEST_BRAKING);
        let gap = lead.max(0.0) + speed * dt + spare + 1e-9;
        let (mut leader, mut follower) = (at_gap(gap, leader_speed), Car { position: 0.0, speed });
        prop_assert!(is_secure(speed, follower.behind(leader), dt));
        for (action, steps) in actions {
            for _ in 0..steps {
                let ahead = follower.behind(leader);
                let next = bounded_step(model, desired, follower, ahead, dt);
                leader = leader.moved(action, dt);
                let acceleration = (next.speed - follower.speed) / dt;
                prop_assert!(next.speed >= 0.0 && next.position >= follower.position);
                prop_assert!(acceleration >= -HARDEST_BRAKING - 1e-9);
                follower = next;
                let left = follower.behind(leader).gap;
                prop_assert!(left > -1e-9, "gap {left}");
            }
        }
    }

    #[test]
    fn v18_accelerations_are_finite_and_no_harder_than_from_rest_on_a_free_road(
        model in any_model(), exponent in -3.0..6.0_f64, speed in prop_oneof![Just(0.0), 0.0..60.0_f64],
        leader_speed in prop_oneof![Just(0.0), 0.0..60.0_f64], desired in 1.0..60.0_f64,
        tightness in 0.4..1.0_f64,
    ) {
        let pace = Pace { speed, desired, tightness };
        let ahead = Ahead { gap: 10.0_f64.powf(exponent), speed: leader_speed };
        let acceleration = model.acceleration(pace, Some(ahead));
        prop_assert!(acceleration.is_finite());
        let limit = match model {
            FollowingModel::Idm(idm) => idm.acceleration,
            FollowingModel::Fvdm(fvdm) => {
                fvdm.sensitivity * (desired - speed)
                    + fvdm.relative_sensitivity * (leader_speed - speed).max(0.0)
            }
        };
        prop_assert!(acceleration <= limit + 1e-9, "{acceleration} above {limit}");
        let prospect = model.prospect(pace, Some(ahead));
        prop_assert!((0.0..=desired).contains(&prospect));
    }
}
