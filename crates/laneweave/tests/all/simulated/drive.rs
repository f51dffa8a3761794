//! Simulated traffic as a camera would record it, and the knowledge of its drivers.

use std::collections::HashMap;

use laneweave::style::Population;
use laneweave_generate::{Motorway, motorway};
use laneweave_models::Style;
use laneweave_network::{ChainIndex, Network, Side};
use laneweave_recorded::{Drone, Watch};
use laneweave_recordings::Recording;
use laneweave_sim::{Demand, Event, Place, Rate, Setup, Vehicle, World, perceive};

use crate::simulated::view::View;

/// Time between steps, which are frames [s].
pub(crate) const STEP: f64 = 0.04;
/// Standard deviation of the positions' noise along each axis [m].
const NOISE: f64 = 0.1;
/// Vehicles per hour on the road and on the ramp.
const ON_ROAD: f64 = 2300.0;
const ON_RAMP: f64 = 220.0;
/// Number of vehicles that stay on the road for each one that leaves it.
const STAYING: f64 = 9.0;
/// Share of trucks.
const TRUCKS: f64 = 0.1;
/// Between these times the knowledge of drivers is sampled so often [s]. Before the first, there are changes that began
/// before the recording; after the last, the recording ends before all vehicles have left the map.
pub(crate) struct Spans {
    /// Simulated time before the recording [s].
    pub(crate) warm_up: f64,
    /// Time of the recording [s].
    pub(crate) recorded: f64,
    /// Time after it, in which its last changes are completed [s].
    pub(crate) afterwards: f64,
    /// The times in between [s].
    pub(crate) kept: [f64; 2],
    /// Time between two samples [s].
    pub(crate) every: f64,
}

const ON_THE_MOTORWAY: Spans =
    Spans { warm_up: 120.0, recorded: 660.0, afterwards: 30.0, kept: [10.0, 480.0], every: 5.0 };

/// The true values in the simulator.
pub(crate) struct Truth {
    pub(crate) network: Network,
    pub(crate) driver_parameters: Vec<Style>,
    /// For each vehicle its driver parameters.
    pub(crate) character_of: HashMap<i64, u32>,
    /// The lane changes, by the time of the recording.
    pub(crate) changes: Vec<Made>,
    /// The knowledge of drivers.
    pub(crate) instants: Vec<Instant>,
}

/// A lane change: the times of its begin, its crossing and its end [s].
pub(crate) struct Made {
    pub(crate) vehicle: i64,
    pub(crate) began: f64,
    pub(crate) time: f64,
    pub(crate) ended: f64,
}

/// One instant of the simulation.
pub(crate) struct Instant {
    pub(crate) frame: i64,
    /// In order of vehicles.
    pub(crate) stands: Vec<Stand>,
    pub(crate) samples: Vec<Sample>,
}

/// The position of a vehicle.
#[derive(Debug, PartialEq)]
pub(crate) struct Stand {
    pub(crate) vehicle: i64,
    pub(crate) chain: ChainIndex,
    pub(crate) is_between_lanes: bool,
}

/// The knowledge of a driver about a side.
pub(crate) struct Sample {
    pub(crate) vehicle: i64,
    pub(crate) side: Side,
    pub(crate) view: Option<View>,
}

/// The usual drivers on three lanes with trucks, an on-ramp and an off-ramp, and the recording of them.
pub(crate) fn drive(seed: u64) -> (Truth, Recording) {
    let driver_parameters = Population::usual(seed).expect("built-in styles").driver_parameters;
    drive_in(world(seed), driver_parameters, &ON_THE_MOTORWAY, seed)
}

/// Drives in a world with these driver parameters, and records that.
pub(crate) fn drive_in(
    mut world: World,
    driver_parameters: Vec<Style>,
    spans: &Spans,
    seed: u64,
) -> (Truth, Recording) {
    let Spans { warm_up, recorded, afterwards, kept: [first_kept, last_kept], every } = *spans;
    let steps = |seconds: f64| (seconds / STEP).round() as i64;
    (0..steps(warm_up)).for_each(|_| world.step());
    let began = world.clock().time();
    let (mut watch, mut character_of) = (Watch::from_now(&world), HashMap::new());
    let (mut changes, mut instants) = (Vec::new(), Vec::new());
    for frame in 0..=steps(recorded + afterwards) {
        if frame <= steps(recorded) {
            watch.see(&world);
            let parameters = |it: Vehicle| (i64::from(it.id()), it.driver.parameters);
            character_of.extend(world.vehicles().map(parameters));
        }
        if (steps(first_kept)..=steps(last_kept)).contains(&frame) && frame % steps(every) == 0 {
            instants.push(instant(&world, frame));
        }
        world.step();
        for event in world.events() {
            let Event::LaneChange(it) = event else { continue };
            let (vehicle, time) = (i64::from(it.vehicle), it.time - began);
            if it.is_completed && (0.0..=recorded).contains(&time) {
                let start = it.started - began;
                changes.push(Made { vehicle, began: start, time, ended: start + it.duration });
            }
        }
    }
    let drone = Drone { noise: NOISE, seed: seed + 1, ..Drone::exact(1.0 / STEP) };
    let recording = drone.observe(&watch.into_recording());
    let network = world.network().clone();
    (Truth { network, driver_parameters, character_of, changes, instants }, recording)
}

fn world(seed: u64) -> World {
    let (on_ramp_at, off_ramp_at) = (vec![700.0], vec![2200.0]);
    let road = Motorway { length_m: 3000.0, on_ramp_at, off_ramp_at, ..Motorway::default() };
    let network = motorway(&road).expect("it fits").build().expect("it has lanes").network;
    let Population { driver_parameters, shares } = Population::usual(seed).expect("built-in styles");
    let by_lanes = |place: &Place, road, ramp| if place.chains().len() > 1 { road } else { ramp };
    let mut demand = Demand::even(&network, 0.0, TRUCKS, shares);
    let weights: Vec<f64> = demand.destinations.iter().map(|it| by_lanes(it, STAYING, 1.0)).collect();
    for origin in &mut demand.origins {
        origin.rate = Rate::constant(by_lanes(&origin.place, ON_ROAD, ON_RAMP));
        origin.weights.clone_from(&weights);
    }
    World::new(network, driver_parameters, demand, Setup { step: STEP, seed, threads: 1 })
        .expect("it makes sense")
}

/// The positions of all vehicles, and the knowledge of all drivers.
fn instant(world: &World, frame: i64) -> Instant {
    let scene = world.scene();
    let mut vehicles: Vec<Vehicle> = world.vehicles().collect();
    vehicles.sort_by_key(Vehicle::id);
    let id = |it: &Vehicle| i64::from(it.id());
    let stand = |it: &Vehicle| Stand {
        vehicle: id(it),
        chain: it.spot.chain,
        is_between_lanes: it.driver.phase.is_between_lanes(),
    };
    let sample = |it: &Vehicle, side| {
        let view = perceive(&scene, it.spot, side).as_ref().map(View::of);
        Sample { vehicle: id(it), side, view }
    };
    Instant {
        frame,
        stands: vehicles.iter().map(stand).collect(),
        samples: vehicles.iter().flat_map(|it| Side::BOTH.map(|side| sample(it, side))).collect(),
    }
}
