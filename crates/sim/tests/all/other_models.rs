//! MOBIL and LMRS on the road: what their rules require of driving, besides the decision.

use crate::roads::{Road, drivers};
use laneweave_generate::{Motorway, motorway};
use laneweave_models::Style;
use laneweave_models::change::{LaneChangeModel, Lmrs, Mobil, Traffic};
use laneweave_models::follow::{FollowingModel, Fvdm};
use laneweave_network::{ChainIndex, Network};
use laneweave_sim::{Class, Phase, Placement, Setup, Vehicle, World};

/// Length of a car [m].
const LENGTH: f64 = 4.5;

/// A driver who keeps its lane, and its speed behind any leader.
fn unyielding() -> Style {
    let follow = Fvdm { sensitivity: 0.0, relative_sensitivity: 0.0, ..Fvdm::default() };
    let stays = LaneChangeModel::Mobil(Mobil { threshold: f64::INFINITY, ..Mobil::default() });
    Style { follow: FollowingModel::Fvdm(follow), change: stays, ..drivers::conservative() }
}

/// A world without demand, with a driver of `style`, number 0, among drivers who keep lane and speed; `places` are
/// (lane, x, speed).
fn among_unyielding(network: Network, style: Style, places: &[(u32, f64, f64)]) -> World {
    let nobody = drivers::demand(&network, 0.0, 0.0, &[1.0]);
    let styles = vec![style, unyielding()];
    let setup = Setup { step: 0.1, seed: 1, threads: 1 };
    let mut world = World::new(network, styles, nobody, setup).expect("the set-up makes sense");
    for (number, (lane, x, speed)) in places.iter().enumerate() {
        world
            .place(Placement {
                chain: ChainIndex(*lane),
                x: *x,
                speed: *speed,
                class: Class::Car,
                parameters: u32::from(number > 0),
                destination: Some(0),
            })
            .expect("it fits on the road");
    }
    world
}

fn vehicle(world: &World, id: u32) -> Vehicle<'_> {
    world.vehicles().find(|it| it.id() == id).expect("it is on the road")
}

fn mobil(style: Style, traffic: Traffic) -> Style {
    Style { change: LaneChangeModel::Mobil(Mobil { traffic, ..Mobil::default() }), ..style }
}

/// Whether a MOBIL driver in the slow lane is ahead, after a minute, of a driver at `speed` [m/s] in the fast lane.
fn passes(style: Style, speed: f64, is_mirrored: bool) -> bool {
    let network = Road { lanes: 2, length: 4000.0, is_mirrored, ..Road::default() }.network();
    let mut world = among_unyielding(network, style, &[(0, 300.0, speed), (1, 360.0, speed)]);
    (0..600).for_each(|_| world.step());
    assert_eq!(world.counters().collisions, 0);
    vehicle(&world, 0).x() > vehicle(&world, 1).x()
}

#[test]
fn v44_nobody_passes_on_the_slow_side_above_60_kmh_in_european_traffic() {
    for (style, is_mirrored) in [(drivers::conservative(), false), (drivers::aggressive(), true)] {
        let passes = |traffic, speed| passes(mobil(style.clone(), traffic), speed, is_mirrored);
        assert!(!passes(Traffic::European, 22.0));
        assert!(passes(Traffic::European, 14.0), "below it one does");
        assert!(passes(Traffic::Symmetric, 22.0));
    }
}

#[test]
fn mobil_drivers_in_european_traffic_go_back_to_the_slow_lane_after_overtaking_and_others_stay() {
    let lane_after_a_minute = |traffic| {
        let network = Road { lanes: 2, length: 4000.0, ..Road::default() }.network();
        let style = mobil(drivers::conservative(), traffic);
        let mut world = among_unyielding(network, style, &[(0, 300.0, 20.0), (0, 340.0, 15.0)]);
        (0..600).for_each(|_| world.step());
        let me = vehicle(&world, 0);
        assert!(me.x() > vehicle(&world, 1).x());
        me.spot.chain
    };
    assert_eq!(lane_after_a_minute(Traffic::European), ChainIndex(0));
    assert_eq!(lane_after_a_minute(Traffic::Symmetric), ChainIndex(1));
}

/// Where the slow lane ends [m], and the limit there [m/s].
const END: f64 = 2500.0;
const LIMIT: f64 = 18.0;

/// A driver of `model` at a distance `before` the end of its lane [m], beside a dense row in the other lane at 12
/// m/s.
fn beside_a_row(model: Lmrs, before: f64) -> World {
    let plan = Motorway {
        lanes: 2,
        lane_drop_at: Some(END),
        length_m: 4000.0,
        speed_limit_kmh: LIMIT * 3.6,
        ..Motorway::default()
    };
    let network = motorway(&plan).expect("a road").build().expect("a network").network;
    /// From front to front [m]: there is no gap to change into.
    const SPACING: f64 = 2.0 * LENGTH;
    let row = (0..40).map(|number| (1, END - before + 200.0 - SPACING * f64::from(number), 12.0));
    let places: Vec<(u32, f64, f64)> = std::iter::once((0, END - before, LIMIT)).chain(row).collect();
    among_unyielding(
        network,
        Style { change: LaneChangeModel::Lmrs(model), ..drivers::conservative() },
        &places,
    )
}

#[test]
fn lmrs_drivers_fall_in_with_the_target_lane_from_the_desire_to_synchronize_on() {
    // 300 m before the end at 18 m/s the route desire is 0.61: more than d_sync, less than d_coop.
    let speed_after_6_s = |model| {
        let mut world = beside_a_row(model, 300.0);
        (0..60).for_each(|_| world.step());
        assert_eq!(vehicle(&world, 0).driver.phase, Phase::Wants);
        vehicle(&world, 0).speed()
    };
    let falls_in = speed_after_6_s(Lmrs::default());
    assert!(falls_in < 13.0, "{falls_in} m/s");
    let drives_on = speed_after_6_s(Lmrs { synchronize: 0.75, ..Lmrs::default() });
    assert!(drives_on > 17.0, "{drives_on} m/s");
}

#[test]
fn lmrs_drivers_are_let_in_from_the_desire_to_cooperate_on() {
    // The others let in a vehicle that signals; 250 m before the end the desire is 0.68.
    let is_let_in_soon = |cooperate| {
        let mut world = beside_a_row(Lmrs { synchronize: 0.6, cooperate, ..Lmrs::default() }, 250.0);
        let mut most = 0;
        for _ in 0..50 {
            world.step();
            let lets_in = |it: &Vehicle| it.lane_change.lets_in.0.is_finite();
            most = most.max(world.vehicles().filter(lets_in).count());
        }
        most > 0
    };
    assert!(is_let_in_soon(0.61));
    assert!(!is_let_in_soon(0.99));
}
