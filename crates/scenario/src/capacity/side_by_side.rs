//! The capacity of lanes side by side.
//!
//! Drivers who change lanes stand in two of them for some seconds, and leave gaps that nobody fills: lanes side by
//! side have less capacity than as many single ones. A simulation gives this capacity: a straight road, with the same
//! drivers, and a demand above capacity. For the default drivers its results are known in advance.

use laneweave_generate::{Motorway, motorway};
use laneweave_models::Style;
use laneweave_network::RoadLaw;
use laneweave_sim::{Demand, Fleet, Places, Setup, Share, World};

use laneweave_study::units::KMH_PER_MPS;

use crate::scenario;
use crate::style::Population;
use laneweave_study::units::SECONDS_PER_HOUR;

/// Travel time along the road at the limit [s].
const LENGTH_S: f64 = 40.0;
const STEP_S: f64 = 0.25;
/// Time until the road is full, and time of counting [s]: the error is then some two percent.
const UNTIL_FULL: f64 = 120.0;
const COUNTED: f64 = 600.0;
/// More than the capacity of any lane [veh/h].
const TOO_MANY: f64 = 3000.0;

/// Numbers of lanes for which the results are known.
const KNOWN_LANES: [usize; 3] = [2, 3, 4];
/// For limits [km/h] and these numbers of lanes, the vehicles that leave the road in the counted time, in the default
/// mixture of styles and classes. A test simulates them, and says what they are if drivers have changed.
const KNOWN: [(f64, [u64; 3]); 8] = [
    (30.0, [464, 703, 935]),
    (50.0, [585, 860, 1169]),
    (60.0, [619, 934, 1230]),
    (70.0, [629, 964, 1298]),
    (80.0, [697, 1020, 1358]),
    (100.0, [688, 1067, 1415]),
    (120.0, [700, 1072, 1422]),
    (130.0, [725, 1078, 1423]),
];

/// Flow over a road of so many `lanes` under `limit` [m/s] and the limit of `law` for long vehicles, of `drivers`, each
/// style with its weight, at a demand above capacity [veh/s]; `None` if there is no such road.
pub(super) fn flow(
    lanes: usize,
    limit: f64,
    drivers: &[(Style, f64)],
    fleet: &Fleet,
    law: &RoadLaw,
) -> Option<f64> {
    let law = RoadLaw { limit_of_long: law.limit_of_long, ..RoadLaw::FREE };
    let known = known(lanes, limit).filter(|_| law == RoadLaw::FREE && are_default(drivers, fleet));
    let left = known.map_or_else(|| simulated(lanes, limit, drivers, fleet, law), Some);
    left.map(|it| it as f64 / COUNTED)
}

/// The vehicles that leave the road in the counted time, if this is known for the default drivers.
fn known(lanes: usize, limit: f64) -> Option<u64> {
    let (_, left) = KNOWN.iter().find(|it| it.0 / KMH_PER_MPS == limit)?;
    KNOWN_LANES.iter().position(|it| *it == lanes).map(|it| left[it])
}

/// Whether these are the default drivers in the default vehicles.
fn are_default(drivers: &[(Style, f64)], fleet: &Fleet) -> bool {
    *fleet == scenario::Demand::default().fleet()
        && Population::usual_mixture().is_ok_and(|it| Population::by_speed(&it) == drivers)
}

/// The vehicles that leave the road in the counted time.
fn simulated(lanes: usize, limit: f64, drivers: &[(Style, f64)], fleet: &Fleet, law: RoadLaw) -> Option<u64> {
    let road = Motorway {
        lanes,
        length_m: LENGTH_S * limit,
        speed_limit_kmh: limit * SECONDS_PER_HOUR / 1000.0,
        ..Motorway::default()
    };
    let mut network = motorway(&road).ok()?.build().ok()?.network;
    network.law = law;
    let driver_parameters = drivers.iter().map(|(style, _)| style.clone()).collect();
    let shares =
        drivers.iter().zip(0..).map(|((_, weight), first)| Share { weight: *weight, first, count: 1 });
    let total = TOO_MANY * lanes as f64;
    let demand = Demand::over(&network, Places::at_gates(&network), total, *fleet, shares.collect());
    let setup = Setup { step: STEP_S, seed: 1, threads: 1 };
    let mut world = World::new(network, driver_parameters, demand, setup).ok()?;
    let drive = |world: &mut World, time: f64| (0..(time / STEP_S) as u32).for_each(|_| world.step());
    drive(&mut world, UNTIL_FULL);
    world.reset_counts();
    drive(&mut world, COUNTED);
    Some(world.counts().left)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_known_of_the_default_drivers_is_what_a_simulation_gives() {
        let drivers = Population::by_speed(&Population::usual_mixture().unwrap());
        let fleet = scenario::Demand::default().fleet();
        assert!(are_default(&drivers, &fleet) && !are_default(&drivers[..1], &fleet));
        let of_lanes = |limit: f64, lanes| {
            simulated(lanes, limit / KMH_PER_MPS, &drivers, &fleet, RoadLaw::FREE).unwrap()
        };
        let simulated = KNOWN.map(|(limit, _)| (limit, KNOWN_LANES.map(|lanes| of_lanes(limit, lanes))));
        assert_eq!(simulated, KNOWN);
    }

    #[test]
    fn faster_trucks_bring_more_over_a_road() {
        let drivers = Population::by_speed(&Population::usual_mixture().unwrap());
        let fleet = scenario::Demand::default().fleet();
        let flow = |limit_of_long| {
            let law = RoadLaw { limit_of_long, ..RoadLaw::FREE };
            flow(2, 120.0 / KMH_PER_MPS, &drivers, &fleet, &law).unwrap()
        };
        let [slow, fast] = [RoadLaw::FREE.limit_of_long, 105.0 / KMH_PER_MPS].map(flow);
        assert!(fast > 1.02 * slow, "{fast} and {slow} veh/s");
    }
}
