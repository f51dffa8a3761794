//! A lane drop (catalogue V52): the flow is not above the capacity of the remaining lanes, a queue lowers it by at
//! most 15 %, and no vehicle is stuck; and two lanes with equal inflow have equal densities.

use laneweave::generate::{Motorway, motorway};
use laneweave::models::Style;
use laneweave::models::follow::Pace;
use laneweave::network::{Network, RoadLaw, Side};
use laneweave::study::{Estimate, mean};
use laneweave::style::Population;
use laneweave_sim::{Class, Demand, Rate, Setup, Share, World, desired_speed};

const STEP_S: f64 = 0.1;
const SECONDS_PER_HOUR: f64 = 3600.0;
const SEEDS: u64 = 8;

fn road(lanes: usize, lane_drop_at: Option<f64>) -> Network {
    let road = Motorway { lanes, length_m: 3000.0, lane_drop_at, ..Motorway::default() };
    motorway(&road).expect("a road").build().expect("a network").network
}

/// The usual drivers, in cars, with the demand `rate`.
fn world(network: Network, rate: Rate, seed: u64) -> World {
    let Population { driver_parameters, shares } = Population::usual(seed).expect("built-in styles");
    let mut demand = Demand::even(&network, 0.0, 0.0, shares);
    demand.origins[0].rate = rate;
    World::new(network, driver_parameters, demand, Setup { step: STEP_S, seed, threads: 1 }).expect("a world")
}

fn drive(world: &mut World, seconds: f64, mut watch: impl FnMut(&World)) {
    for step in 0..(seconds / STEP_S) as u32 {
        world.step();
        if step % 100 == 0 {
            watch(world);
        }
    }
}

/// The mean over replications, printed on screen.
fn over_seeds<T>(what: &str, found: &[T], of: impl Fn(&T) -> f64) -> Estimate {
    let estimate = mean(&found.iter().map(of).collect::<Vec<_>>()).expect("replications");
    eprintln!("{what}: {:.4} ± {:.4} over {SEEDS} seeds", estimate.mean, estimate.half_width);
    estimate
}

/// Largest flow of two lanes full of the usual drivers in equilibrium, all at one speed [veh/h].
fn equilibrium_of_two_lanes() -> f64 {
    const CAR: Class = Class::Car;
    let Population { driver_parameters, shares } = Population::usual(1).expect("built-in styles");
    let limit = road(2, None).chains[0].limit(0.0);
    let spacing = |speed: f64| {
        let of = |it: &Style| {
            let pace = Pace::new(speed, desired_speed(CAR, it, limit, &RoadLaw::FREE));
            it.follow.equilibrium_gap(pace) + CAR.body().length
        };
        let total: f64 = shares.iter().map(|it| it.weight).sum();
        let mean = |it: &Share| {
            let drivers = &driver_parameters[it.first as usize..(it.first + it.count) as usize];
            it.weight / total * drivers.iter().map(of).sum::<f64>() / f64::from(it.count)
        };
        shares.iter().map(mean).sum::<f64>()
    };
    let speeds = (1..100).map(|it| limit * f64::from(it) / 100.0);
    2.0 * SECONDS_PER_HOUR * speeds.map(|it| it / spacing(it)).fold(0.0, f64::max)
}

/// Time before flows are measured, time of measuring, and time in which all leave after the end of demand [s].
const BEGIN: f64 = 300.0;
const MEASURED: f64 = 900.0;
const DISSOLVES: f64 = 900.0;

/// Vehicles that passed the end of one of three lanes, every 10 s, at `demand` [veh/h]. Afterwards no vehicle is
/// stuck there.
fn passed_a_drop(demand: f64, seed: u64) -> Vec<f64> {
    let rate = Rate::by_pieces(&[(0.0, demand), (BEGIN + MEASURED, 0.0)]).expect("a rate");
    let mut world = world(road(3, Some(2000.0)), rate, seed);
    drive(&mut world, BEGIN, |_| ());
    let mut passed = Vec::new();
    drive(&mut world, MEASURED, |world| passed.push(world.counts().left as f64));
    drive(&mut world, DISSOLVES, |_| ());
    let counters = world.counters();
    assert_eq!((world.on_road(), world.waiting(), counters.stuck, counters.collisions), (0, 0, 0, 0));
    passed
}

/// The largest flow over `count` samples [veh/h].
fn largest_flow(passed: &[f64], count: usize) -> f64 {
    let flows =
        passed.windows(count + 1).map(|it| (it[count] - it[0]) * SECONDS_PER_HOUR / (10 * count) as f64);
    flows.fold(0.0, f64::max)
}

#[test]
fn v52_a_queue_at_a_lane_drop_discharges_at_most_15_percent_below_capacity_and_dissolves() {
    /// Demand just below that with a queue, and far above it [veh/h].
    const NEAR: f64 = 4500.0;
    const ABOVE: f64 = 5500.0;
    let equilibrium = equilibrium_of_two_lanes();
    eprintln!("two lanes in equilibrium: {equilibrium:.0} veh/h");
    // The largest flow of five minutes, and that of a quarter of an hour with a queue.
    let flows: Vec<[f64; 2]> = (1..=SEEDS)
        .map(|seed| {
            let (near, above) = (passed_a_drop(NEAR, seed), passed_a_drop(ABOVE, seed));
            [largest_flow(&near, 30), largest_flow(&above, above.len() - 1)]
        })
        .collect();
    let capacity = over_seeds("largest flow before a queue", &flows, |it| it[0]).interval();
    over_seeds("discharge of a queue", &flows, |it| it[1]);
    let drop = over_seeds("capacity drop", &flows, |it| 1.0 - it[1] / it[0]).interval();
    assert!(capacity.upper <= equilibrium, "{capacity:?} is above {equilibrium}");
    assert!(drop.lower >= 0.0 && drop.upper <= 0.15, "{drop:?}");
}

/// Share of the vehicles on the middle kilometre of two equal lanes that are on the left one.
fn share_on_the_left(seed: u64) -> f64 {
    const FLOW: f64 = 2400.0;
    let mut world = world(road(2, None), Rate::constant(FLOW), seed);
    let (mut left, mut all) = (0.0, 0.0);
    drive(&mut world, 200.0, |_| ());
    drive(&mut world, 900.0, |world| {
        for it in world.vehicles().filter(|it| (1000.0..2000.0).contains(&it.x())) {
            let is_left = world.network().chain(it.spot.chain).stretches(Side::Left).is_empty();
            (left, all) = (left + f64::from(u8::from(is_left)), all + 1.0);
        }
    });
    left / all
}

#[test]
fn v52_two_lanes_of_equal_inflow_are_equally_full() {
    let shares: Vec<f64> = (1..=SEEDS).map(share_on_the_left).collect();
    let share = over_seeds("share on the left of two lanes", &shares, |it| *it).interval();
    assert!(share.lower >= 0.48 && share.upper <= 0.52, "{share:?}");
}
