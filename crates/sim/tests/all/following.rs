//! Car-following in the simulator: the properties of the models hold when the world's step moves the vehicles.

use crate::roads::{Road, drivers};
use laneweave_models::Style;
use laneweave_models::follow::{FollowingModel, Fvdm, Idm, Pace};
use laneweave_network::ChainIndex;
use laneweave_sim::{Class, Kinematics, Placement, Setup, World};

/// Length of a car [m].
const LENGTH: f64 = 4.5;
/// A negligible desired speed [m/s].
const NEARLY_NOTHING: f64 = 1e-3;

#[track_caller]
fn assert_near(value: f64, expected: f64, tolerance: f64) {
    assert!((value - expected).abs() <= tolerance, "{value} is not {expected} within {tolerance}");
}

/// A published parameter set: the model and its desired speed [m/s].
#[derive(Clone, Copy)]
struct Published {
    follow: FollowingModel,
    desired: f64,
}

fn idm(acceleration: f64, deceleration: f64, time_gap: f64, desired_kmh: f64) -> Published {
    let follow = Idm { acceleration, deceleration, time_gap, jam_gap: 2.0, exponent: 4.0 };
    Published { follow: FollowingModel::Idm(follow), desired: desired_kmh / 3.6 }
}

/// Table I of Treiber et al. (2000), from memory.
fn t2000() -> Published {
    idm(0.73, 1.67, 1.6, 120.0)
}

/// Kesting et al. (2010), from memory.
fn k2010() -> Published {
    idm(1.4, 2.0, 1.5, 120.0)
}

/// A driver in a town.
fn urban() -> Published {
    idm(1.0, 1.5, 1.0, 50.0)
}

/// The FVDM of the aggressive test driver.
fn fvdm() -> Published {
    Published { follow: drivers::aggressive().follow, desired: 120.0 / 3.6 }
}

impl Published {
    fn style(&self, limit: f64) -> Style {
        Style { follow: self.follow, speed_factor: self.desired / limit, ..drivers::conservative() }
    }

    /// The desired speed as a vehicle of the simulator stores it [m/s].
    fn stored_desired(&self) -> f64 {
        f64::from(self.desired as f32)
    }
}

/// A driver who keeps its speed behind any leader, as long as kinematics allows.
fn unyielding() -> Published {
    let follow = Fvdm { sensitivity: 0.0, relative_sensitivity: 0.0, ..Fvdm::default() };
    Published { follow: FollowingModel::Fvdm(follow), desired: 1.0 }
}

/// A driver who brakes as hard as its vehicle can until it stands.
fn braker() -> Published {
    let follow = Fvdm { sensitivity: 100.0, relative_sensitivity: 0.0, ..Fvdm::default() };
    Published { follow: FollowingModel::Fvdm(follow), desired: NEARLY_NOTHING }
}

/// A road of one lane with the limit of `sets[0]`, on which `sets` drive.
fn one_lane(sets: &[Published], length: f64, is_ring: bool, step: f64) -> World {
    let limit = sets[0].desired;
    let network = Road { length, limit, is_ring, ..Road::default() }.network();
    let styles = sets.iter().map(|set| set.style(limit)).collect();
    let nobody = drivers::demand(&network, 0.0, 0.0, &[1.0]);
    World::new(network, styles, nobody, Setup { step, seed: 1, threads: 1 }).expect("the set-up makes sense")
}

/// Places a car at `x` [m] of the whole road. It follows the road.
fn place(world: &mut World, x: f64, speed: f64, parameters: u32) {
    let (mut chain, mut x) = (ChainIndex(0), x);
    while x > world.network().chain(chain).length {
        x -= world.network().chain(chain).length;
        chain = world.network().chain(chain).following[0];
    }
    world
        .place(Placement { chain, x, speed, class: Class::Car, parameters, destination: None })
        .expect("it fits on the road");
}

fn car(world: &World, id: u32) -> Kinematics {
    *world.vehicles().find(|vehicle| vehicle.id() == id).expect("it is on the road").motion
}

/// Time [s] and distance [m] in which a car from rest reaches `share` of its desired speed.
fn from_rest(set: Published, share: f64, step: f64) -> (f64, f64) {
    let mut world = one_lane(&[set], 3000.0, false, step);
    place(&mut world, LENGTH, 0.0, 0);
    let target = share * set.stored_desired();
    loop {
        let (time, before) = (world.clock().time(), car(&world, 0));
        world.step();
        let after = car(&world, 0);
        if after.speed >= target {
            let part = (target - before.speed) / (after.speed - before.speed);
            return (time + part * step, before.x + part * (after.x - before.x) - LENGTH);
        }
    }
}

#[test]
fn v5_a_car_from_rest_takes_the_exact_time_and_way() {
    // The ballistic step is of first order. It is early by dt/2·ln(1/(1 − x⁴)): 0.068 % at worst, when the driver in
    // town reaches 0.99 of its desired speed. Its distance is then 0.091 % short.
    const STEP: f64 = 0.01;
    let early = |share: f64| -0.5 * STEP * (1.0 - share.powi(4)).ln();
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
        for (share, time, way) in table {
            let (took, went) = from_rest(set, share, STEP);
            assert_near(took, time, 7e-4 * time);
            assert_near(took, time - early(share), 1e-5 * time);
            assert_near(went, way, 9.1e-4 * way);
        }
    }
}

#[test]
fn v6_halving_the_step_halves_the_error() {
    let errors = [0.4, 0.2, 0.1, 0.05].map(|step| from_rest(k2010(), 0.9, step).0 - 26.250412);
    for (error, published) in errors.into_iter().zip([-0.212109, -0.106117, -0.053322, -0.026639]) {
        assert_near(error, published, 2e-4);
    }
    for pair in errors.windows(2) {
        assert_near(pair[0] / pair[1], 2.0, 0.1);
    }
}

#[test]
fn v7_a_follower_settles_at_the_equilibrium_gap() {
    for (set, speed, gap) in [
        (t2000(), 5.0, 10.002532),
        (t2000(), 20.0, 36.443449),
        (k2010(), 10.0, 17.069271),
        (k2010(), 30.0, 80.145985),
        (urban(), 5.0, 7.059538),
        (urban(), 10.0, 14.032819),
    ] {
        // The ring road is so long that the leader does not see the follower.
        let mut world = one_lane(&[set, unyielding()], 2000.0, true, 0.1);
        place(&mut world, 1000.0, 0.7 * speed, 0);
        place(&mut world, 1000.0 + 2.0 * gap + LENGTH, speed, 1);
        (0..30_000).for_each(|_| world.step());
        let (follower, leader) = (car(&world, 0), car(&world, 1));
        assert_eq!(leader.speed, speed);
        let settled = (leader.rear() - follower.x).rem_euclid(world.network().chain(ChainIndex(0)).length);
        assert_near(settled, gap, 1e-3);
    }
}

/// A ring road with 100 cars at equal distances.
fn ring(set: Published, gap: f64, speed: f64) -> World {
    const CARS: usize = 100;
    let spacing = gap + LENGTH;
    let mut world = one_lane(&[set], CARS as f64 * spacing, true, 0.1);
    (0..CARS).for_each(|number| place(&mut world, (number as f64 + 0.5) * spacing, speed, 0));
    world
}

#[test]
fn v8_a_ring_in_equilibrium_stays_there_for_a_thousand_seconds() {
    for (set, speed) in [(k2010(), 3.0), (k2010(), 20.0), (t2000(), 25.0), (fvdm(), 30.0)] {
        let gap = set.follow.equilibrium_gap(Pace::new(speed, set.stored_desired()));
        let mut world = ring(set, gap, speed);
        for _ in 0..10_000 {
            world.step();
        }
        assert_eq!(world.on_road(), 100);
        for vehicle in world.vehicles() {
            assert_near(vehicle.speed(), speed, 1e-9);
        }
    }
}

#[test]
fn v9_rings_of_ten_densities_flow_as_the_fundamental_diagram_says() {
    let idm_speed = |gap: f64| {
        let desired = k2010().desired;
        let gap_at = |speed: f64| (2.0 + 1.5 * speed) / (1.0 - (speed / desired).powi(4)).sqrt();
        let (mut low, mut high) = (0.0, desired);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if gap_at(middle) < gap { low = middle } else { high = middle }
        }
        low
    };
    let fvdm_speed = |gap: f64| {
        let desired = fvdm().desired;
        let rise = (0.13 * (gap - 1.5) * 14.66 / desired - 1.57).tanh() + 1.57_f64.tanh();
        desired * rise / (1.0 + 1.57_f64.tanh())
    };
    // Density [veh/km].
    for density in [8.0, 12.0, 16.0, 20.0, 25.0, 30.0, 75.0, 85.0, 100.0, 120.0] {
        let gap = 1000.0 / density - LENGTH;
        for (set, speed) in [(k2010(), idm_speed(gap)), (fvdm(), fvdm_speed(gap))] {
            let mut world = ring(set, gap, 0.5 * speed);
            (0..3_000).for_each(|_| world.step());
            let mean = world.vehicles().map(|it| it.speed()).sum::<f64>() / world.on_road() as f64;
            assert_near(density * mean, density * speed, 5e-3 * density * speed);
        }
    }
}

#[test]
fn v15_a_jam_moves_upstream_with_fifteen_kilometres_per_hour() {
    const SLOW: f64 = 3.0;
    const SPEED: f64 = 10.0;
    const CARS: u32 = 100;
    let gap = t2000().follow.equilibrium_gap(Pace::new(SPEED, t2000().desired));
    let around = f64::from(CARS) * (gap + LENGTH);
    let mut world = one_lane(&[t2000()], around, true, 0.1);
    for number in 0..CARS {
        let out_of_place = if number == 0 { 1.0 } else { 0.0 };
        place(&mut world, (f64::from(number) + 0.5) * around / f64::from(CARS) + out_of_place, SPEED, 0);
    }
    (0..12_000).for_each(|_| world.step());
    // Time and place at which each car enters a jam.
    let mut stops = vec![Vec::new(); CARS as usize];
    for _ in 0..3_000 {
        let before: Vec<_> = (0..CARS).map(|id| car(&world, id).speed).collect();
        world.step();
        for (id, before) in (0..CARS).zip(before) {
            let now = car(&world, id);
            if before >= SLOW && now.speed < SLOW {
                stops[id as usize].push((world.clock().time(), now.x));
            }
        }
    }
    // This follows one jam from car to car: cars behind enter it later, and it moves backwards.
    let (begin, mut time, mut back) = (stops[99][0], stops[99][0].0, 0.0);
    let mut place = begin.1;
    for stops in stops[40..99].iter().rev() {
        let next = stops.iter().find(|it| it.0 > time).expect("there is a jam");
        back += (place - next.1).rem_euclid(world.network().chain(ChainIndex(0)).length);
        (time, place) = *next;
    }
    assert_near(3.6 * back / (time - begin.0), 15.0, 5.0);
}

/// What happened to a follower.
struct Stop {
    shortest_gap: f64,
    final_gap: f64,
    hardest_braking: f64,
    emergencies: u64,
}

/// A follower at `speed` [m/s], `gap` [m] behind a leader at `leader_speed` [m/s].
fn approach(set: Published, leader: Published, speed: f64, gap: f64, leader_speed: f64, step: f64) -> Stop {
    const LONG: f64 = 60.0;
    let mut world = one_lane(&[set, leader], 3000.0, false, step);
    place(&mut world, LENGTH, speed, 0);
    place(&mut world, LENGTH + gap + LENGTH, leader_speed, 1);
    let mut stop = Stop { shortest_gap: gap, final_gap: gap, hardest_braking: 0.0, emergencies: 0 };
    for _ in 0..(LONG / step) as usize {
        world.step();
        let (follower, leader) = (car(&world, 0), car(&world, 1));
        stop.final_gap = leader.rear() - follower.x;
        stop.shortest_gap = stop.shortest_gap.min(stop.final_gap);
        stop.hardest_braking = stop.hardest_braking.max(f64::from(-follower.acceleration));
    }
    stop.emergencies = world.counters().emergency_brakings;
    assert_eq!(world.counters().collisions, u64::from(stop.shortest_gap < 0.0));
    stop
}

#[test]
fn v16_an_approach_to_a_standing_car_ends_at_the_jam_gap() {
    for (speed, gap, braking) in
        [(20.0, 200.0, 2.096511), (20.0, 100.0, 2.199363), (30.0, 300.0, 2.170436), (30.0, 150.0, 5.728910)]
    {
        let stop = approach(k2010(), unyielding(), speed, gap, 0.0, 0.01);
        assert_near(stop.final_gap, 1.997, 0.02);
        assert_near(stop.hardest_braking, braking, 0.02 * braking);
        assert_eq!(stop.emergencies, 0);
    }
}

#[test]
fn v17_an_idm_driver_survives_a_leader_who_brakes_as_hard_as_possible() {
    for set in [t2000(), k2010()] {
        let gap = set.follow.equilibrium_gap(Pace::new(20.0, set.desired));
        for step in [0.01, 0.05, 0.1, 0.2, 0.25] {
            let stop = approach(set, braker(), 20.0, gap, 20.0, step);
            assert!(stop.shortest_gap > 0.0, "step {step}: gap {}", stop.shortest_gap);
        }
    }
    let gap = k2010().follow.equilibrium_gap(Pace::new(20.0, k2010().desired));
    let stop = approach(k2010(), braker(), 20.0, gap, 20.0, 0.01);
    assert_near(stop.final_gap, 1.997, 0.02);
    assert_near(stop.hardest_braking, 6.204, 0.02 * 6.204);
    assert_eq!(stop.emergencies, 0);
}

#[test]
fn v17_emergency_braking_saves_fvdm_drivers_from_gaps_at_which_the_model_alone_collides() {
    let literal = Fvdm { reading: laneweave_models::Reading::Literal, ..Fvdm::default() };
    let set = Published { follow: FollowingModel::Fvdm(literal), desired: 50.0 };
    for (speed, collides_below) in [(10.0, 9.792), (13.0, 14.637), (14.0, 16.673)] {
        for step in [0.01, 0.1, 0.25] {
            let stop = approach(set, braker(), speed, collides_below - 3.0, speed, step);
            assert!(stop.shortest_gap > 0.0, "step {step}: gap {}", stop.shortest_gap);
            assert!(stop.hardest_braking <= 8.0);
            assert!(stop.emergencies > 0);
        }
    }
}
