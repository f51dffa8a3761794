//! The capacity of lanes side by side.
//!
//! Drivers who change lanes stand in two of them for some seconds, and leave gaps that nobody fills: lanes side by
//! side have less capacity than as many single ones. A simulation gives this capacity: a straight road, with the same
//! drivers, and a demand above capacity.

use laneweave_generate::{Motorway, motorway};
use laneweave_models::Style;
use laneweave_sim::{Demand, Fleet, Places, Setup, Share, World};

use super::SECONDS_PER_HOUR;

/// Travel time along the road at the limit [s].
const LENGTH_S: f64 = 40.0;
const STEP_S: f64 = 0.25;
/// Time until the road is full, and time of counting [s]: the error is then some two percent.
const UNTIL_FULL: f64 = 120.0;
const COUNTED: f64 = 600.0;
/// More than the capacity of any lane [veh/h].
const TOO_MANY: f64 = 3000.0;

/// Flow over a road of so many `lanes` under `limit` [m/s], of `drivers`, each style with its weight, at a demand
/// above capacity [veh/s]; `None` if there is no such road.
pub(super) fn flow(lanes: usize, limit: f64, drivers: &[(Style, f64)], fleet: &Fleet) -> Option<f64> {
    let road = Motorway {
        lanes,
        length_m: LENGTH_S * limit,
        speed_limit_kmh: limit * SECONDS_PER_HOUR / 1000.0,
        ..Motorway::default()
    };
    let network = motorway(&road).ok()?.build().ok()?.network;
    let driver_parameters = drivers.iter().map(|(style, _)| style.clone()).collect();
    let shares =
        drivers.iter().zip(0..).map(|((_, weight), first)| Share { weight: *weight, first, count: 1 });
    let total = TOO_MANY * lanes as f64;
    let demand = Demand::over(Places::at_gates(&network), total, *fleet, shares.collect());
    let setup = Setup { step: STEP_S, seed: 1, threads: 1 };
    let mut world = World::new(network, driver_parameters, demand, setup).ok()?;
    let drive = |world: &mut World, time: f64| (0..(time / STEP_S) as u32).for_each(|_| world.step());
    drive(&mut world, UNTIL_FULL);
    world.reset_counts();
    drive(&mut world, COUNTED);
    Some(world.counts().left as f64 / COUNTED)
}
