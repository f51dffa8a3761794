//! Drivers let in a vehicle that a user drives as they let in each other.

use std::collections::{BTreeMap, BTreeSet};

use laneweave_network::{ChainIndex, Side};
use laneweave_sim::{Command, Control, Lateral, Longitudinal, Phase, Setup, Vehicle, VehicleId, World};

use crate::roads::{drivers, network};

const SEEDS: u64 = 20;
/// Student's t for 95 % and 20 seeds.
const T: f64 = 2.093;
/// Steps of a run: eight minutes, the first three of which fill the road.
const STEPS: u32 = 4800;
const FILLED: u32 = 1800;
/// Urgency from which a driver who waits for a gap asks others to let it in.
const ASKS_FROM: f32 = 0.3;

/// A place where drivers have to leave their lane.
struct Place {
    map: &'static str,
    vehicles_per_hour: f64,
    /// Vehicles are subjects from this distance before the end of the lane on [m].
    from: f64,
}

/// Steps in which a subject waits for a gap and asks, and those of them in which a driver lets it in.
#[derive(Default)]
struct Yields {
    asked: u32,
    granted: u32,
}

/// Traffic of drivers who are always concentrated: an inattentive one overlooks a signal for a while, and a driver who
/// gives up and wants the change again signals anew, while a user goes on.
fn world(place: &Place, seed: u64) -> World {
    let network = network(place.map);
    let demand = drivers::demand(&network, place.vehicles_per_hour, 0.1, &[0.3, 0.7]);
    let styles = vec![drivers::aggressive(), drivers::conservative()];
    World::new(network, styles, demand, Setup { step: 0.1, seed, threads: 1 }).expect("it makes sense")
}

/// The chains of the lane that ends, with the distance from the start of each to the end [m].
fn ending_lane(world: &World) -> BTreeMap<ChainIndex, f64> {
    let network = world.network();
    let (mut chain, mut left) = (network.lane_drops[0], 0.0);
    let mut found = BTreeMap::new();
    loop {
        left += network.chain(chain).length;
        found.insert(chain, left);
        let [before] = network.chain(chain).previous[..] else { return found };
        chain = before;
    }
}

/// Whether a driver lets in a vehicle that had this `speed` before the step [m/s].
fn is_let_in(world: &World, speed: f64) -> bool {
    let lets_in = |(gap, seen): (f32, f32)| gap.is_finite() && seen == speed as f32;
    world.vehicles().any(|it| lets_in(it.lane_change.lets_in))
}

/// A run in which every third vehicle on the lane that ends is a subject from the moment at which its driver wants to
/// leave the lane. If subjects are driven, their users order that change.
fn run(place: &Place, seed: u64, are_driven: bool) -> Yields {
    let mut world = world(place, seed);
    let lane = ending_lane(&world);
    let mut subjects: BTreeSet<VehicleId> = BTreeSet::new();
    let mut yields = Yields::default();
    (0..FILLED).for_each(|_| world.step());
    for _ in FILLED..STEPS {
        let is_near = |chain, x| lane.get(&chain).is_some_and(|end| end - x < place.from);
        let all = world.vehicles().filter(|it| it.id() % 3 == 0 && is_near(it.spot.chain, it.x()));
        let near: Vec<_> = all.collect();
        let decides = |it: &Vehicle| it.driver.phase != Phase::Cruises || it.driver.due <= world.clock().step;
        let wants = |id| world.intention(id).and_then(|it| it.changes_to) == Some(Side::Left);
        let others = near.iter().filter(|it| !subjects.contains(&it.id()) && decides(it));
        let new: Vec<VehicleId> = others.map(|it| it.id()).filter(|it| wants(*it)).collect();
        let asks = |it: &Vehicle| {
            let is_waiting = it.driver.phase == Phase::Wants && it.lane_change.urgency >= ASKS_FROM;
            is_waiting && subjects.contains(&it.id())
        };
        let asking = near.iter().filter(|it| asks(it)).map(|it| (it.id(), it.speed()));
        let asking: Vec<_> = asking.collect();
        for id in new {
            subjects.insert(id);
            if are_driven {
                let (longitudinal, lateral) = (Longitudinal::Driver, Lateral::Change(Side::Left));
                let control = Control::Drive { longitudinal, lateral };
                world.command(Command::Control(id, control)).expect("it is on the road");
            }
        }
        world.step();
        for (id, speed) in asking {
            if world.vehicle(id).is_some_and(|it| it.driver.phase == Phase::Wants) {
                yields.asked += 1;
                yields.granted += u32::from(is_let_in(&world, speed));
            }
        }
    }
    yields
}

/// The mean share of yields over the seeds in which somebody asked, and its 95 % confidence interval.
fn share(place: &Place, are_driven: bool) -> (f64, f64) {
    let runs: Vec<Yields> = (1..=SEEDS).map(|seed| run(place, seed, are_driven)).collect();
    let asked: u32 = runs.iter().map(|it| it.asked).sum();
    assert!(asked > 1000, "{}: {asked} requests only", place.map);
    let with_requests = runs.iter().filter(|it| it.asked > 0);
    let shares: Vec<f64> = with_requests.map(|it| f64::from(it.granted) / f64::from(it.asked)).collect();
    let n = shares.len() as f64;
    let mean = shares.iter().sum::<f64>() / n;
    let variance = shares.iter().map(|it| (it - mean) * (it - mean)).sum::<f64>() / (n - 1.0);
    (mean, T * (variance / n).sqrt())
}

fn assert_let_in_alike(place: &Place) {
    let [(simulated, interval), (external, _)] = [false, true].map(|it| share(place, it));
    assert!(
        (external - simulated).abs() <= interval,
        "{}: {external} is not {simulated} ± {interval}",
        place.map
    );
}

#[test]
fn at_a_lane_drop_drivers_let_in_an_external_vehicle_as_they_let_in_each_other() {
    assert_let_in_alike(&Place { map: "lane_drop.osm", vehicles_per_hour: 6000.0, from: 1200.0 });
}

#[test]
fn at_the_end_of_an_on_ramp_drivers_let_in_an_external_vehicle_as_they_let_in_each_other() {
    assert_let_in_alike(&Place { map: "on_ramp.osm", vehicles_per_hour: 5500.0, from: 240.0 });
}
