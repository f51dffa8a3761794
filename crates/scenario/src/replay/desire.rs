//! The desired speed of a recorded driver, as far as its speed shows it when it becomes a driver.

use laneweave_models::Style;
use laneweave_network::Position;
use laneweave_sim::{Vehicle, World, desired_speed};

use crate::style::Population;

/// A driver with a longer time gap, or with nobody ahead, drives freely [s].
const FREE: f64 = 4.0;
/// A free driver that is slower than this share of the limit may still be speeding up.
const SPEEDING_UP: f64 = 0.5;
/// Standard deviation of the logarithm of a driver's desired speed around those of its style (ours).
const OTHERWISE: f64 = 0.15;
/// Standard deviation of a free driver's speed around its desired speed [m/s] (ours).
const SPREAD: f64 = 1.5;

/// The index of a set of driver parameters of the style that was drawn for `vehicle`. A set is the more likely, the
/// more its desired speed agrees with the speed of the vehicle now: a free driver drives as fast as it desires, any
/// other at most so. `uniform` is a random number between 0 and 1.
pub(super) fn parameters(vehicle: &Vehicle, world: &World, uniform: f64) -> u32 {
    let drawn = vehicle.driver.parameters;
    let style = &vehicle.style().name;
    let own = world.driver_parameters().iter().zip(0..).filter(|(it, _)| it.name == *style);
    let of_population: u32 = world.demand().population.iter().map(|it| it.count).sum();
    let log = |it: &Style, index: u32| log_prior(index / of_population) + log_likelihood(vehicle, it, world);
    let sets: Vec<(f64, u32)> = own.map(|(it, index)| (log(it, index), index)).collect();
    let most = sets.iter().map(|it| it.0).fold(f64::NEG_INFINITY, f64::max);
    let weights = || sets.iter().map(|(log, index)| (libm::exp(log - most), *index));
    let mut at = uniform * weights().map(|it| it.0).sum::<f64>();
    let found = weights().find(|(weight, _)| {
        at -= weight;
        at < 0.0
    });
    found.map_or(drawn, |it| it.1)
}

/// The logarithm of how likely a set is before a speed is seen, but for a constant: 0 for those of the population,
/// which come first, and less for those that desire other speeds.
fn log_prior(number: u32) -> f64 {
    let factor = (number as usize).checked_sub(1).and_then(|it| Population::OTHER_SPEEDS.get(it));
    let away = factor.map_or(0.0, |it| libm::log(*it) / OTHERWISE);
    -0.5 * away * away
}

/// The logarithm of how likely the speed of a vehicle is if its driver has this `style`, but for a constant.
fn log_likelihood(vehicle: &Vehicle, style: &Style, world: &World) -> f64 {
    let scene = world.scene();
    let (lanelet, _) = world.network().lanelet_at(Position::new(vehicle.spot.chain, vehicle.x()));
    let (speed, limit) = (vehicle.speed(), lanelet.speed_limit);
    let is_free = scene.ahead(scene.viewpoint(vehicle.spot)).is_none_or(|it| it.gap > FREE * speed)
        && speed > SPEEDING_UP * limit;
    let faster = speed - desired_speed(vehicle.driver.class, style, limit, &world.network().law);
    let off = if is_free { faster } else { faster.max(0.0) };
    -0.5 * (off / SPREAD) * (off / SPREAD)
}
