//! Drivers at the end of their lane are let in.

use laneweave_generate::{Motorway, motorway as draw_motorway};
use laneweave_models::change::Safety;
use laneweave_models::{Manner, Style};
use laneweave_network::ChainIndex;
use laneweave_sim::{Class, Placement, Setup, World};

use crate::roads::drivers;

/// Where the slow lane ends [m].
const END: f64 = 2500.0;
/// Limit before the end of the lane, and speed of vehicles that pass freely [m/s].
const SPEED: f64 = 18.0;
/// Number of passing vehicles.
const PASSING: usize = 60;

/// A truck stands at the end of its lane, beside a dense row of `passing` drivers. The first of them is beside it.
fn truck_beside(passing: Style) -> World {
    beside(
        drivers::conservative(),
        passing,
        Row { class: Class::Truck, speed: SPEED, first: END - 18.0, spacing: 30.0 },
    )
}

/// The vehicle that stands at the end of its lane, and the vehicles that pass it.
struct Row {
    class: Class,
    /// Limit, and speed of those who pass [m/s].
    speed: f64,
    /// Front of the first of them [m], and distance between their fronts [m].
    first: f64,
    spacing: f64,
}

/// A vehicle of a `waiting` driver stands at the end of its lane, beside a row of `passing` drivers.
fn beside(waiting: Style, passing: Style, Row { class, speed, first, spacing }: Row) -> World {
    let plan = Motorway {
        lanes: 2,
        lane_drop_at: Some(END),
        length_m: 4000.0,
        speed_limit_kmh: speed * 3.6,
        ..Motorway::default()
    };
    let network = draw_motorway(&plan).expect("a road").build().expect("a network").network;
    let nobody = drivers::demand(&network, 0.0, 0.0, &[1.0]);
    let setup = Setup { step: 0.1, seed: 1, threads: 1 };
    let pace = speed.min(speed * passing.speed_factor);
    let mut world =
        World::new(network, vec![waiting, passing], nobody, setup).expect("the set-up makes sense");
    let mut put = |chain, x, speed, class, parameters| {
        world
            .place(Placement { chain, x, speed, class, parameters, destination: Some(0) })
            .expect("it fits on the road")
    };
    put(ChainIndex(0), END - 18.0, 0.0, class, 0);
    for number in 0..PASSING {
        put(ChainIndex(1), first - number as f64 * spacing, pace, Class::Car, 1);
    }
    world
}

/// Waiting time of that vehicle, two minutes at most [s], and the hardest braking in that time [m/s²].
fn wait(mut world: World) -> (f64, f64) {
    let mut hardest = 0.0_f64;
    while world.counts().route_changes == 0 && world.clock().time() < 120.0 {
        world.step();
        let decelerations = world.vehicles().map(|it| -f64::from(it.motion.acceleration));
        hardest = decelerations.fold(hardest, f64::max);
    }
    (world.clock().time(), hardest)
}

#[test]
fn who_stands_at_the_end_of_its_lane_is_let_in_by_who_is_far_enough_behind_to_brake_gently() {
    let (time, hardest) = wait(truck_beside(drivers::conservative()));
    assert!(time < 30.0, "{time} s");
    assert!(hardest < 2.5, "{hardest} m/s²");
}

#[test]
fn where_nobody_lets_others_in_it_waits_for_the_last_to_pass() {
    let manner = Manner { yield_deceleration: 0.0, ..Manner::default() };
    let (time, _) = wait(truck_beside(Style { manner, ..drivers::conservative() }));
    let last_passes = PASSING as f64 * 30.0 / SPEED;
    assert!(time > last_passes, "{time} s");
}

#[test]
fn who_accepts_only_a_long_gap_behind_is_left_one_by_who_lets_it_in() {
    // More than the 3 m that are left to others.
    let safety = Safety { min_lag_gap: 6.0, ..Safety::default() };
    let waiting = Style { safety, ..drivers::conservative() };
    let row = Row { class: Class::Truck, speed: SPEED, first: END - 18.0, spacing: 30.0 };
    let (time, hardest) = wait(beside(waiting, drivers::conservative(), row));
    assert!(time < 30.0, "{time} s");
    assert!(hardest < 2.5, "{hardest} m/s²");
}

#[test]
fn who_lets_another_in_where_all_crawl_holds_the_gap_open_until_it_is_taken() {
    // At 0.2 m/s, with hardly more than the gaps at standstill.
    let crawling = Style { speed_factor: 0.2 / SPEED, ..drivers::conservative() };
    let row = Row { class: Class::Car, speed: SPEED, first: END + 50.0, spacing: 4.5 + 2.3 };
    let mut world = beside(drivers::conservative(), crawling, row);
    while world.counts().route_changes == 0 && world.clock().time() < 600.0 {
        world.step();
    }
    let time = world.clock().time();
    assert!(time < 300.0, "{time} s, in which about nine vehicles pass");
}
