//! Random towns under random demand of up to twice their estimated capacity, from some entrances much more than from
//! others.

use std::error::Error;

use laneweave::Capacity;
use laneweave::maps::generate::{Control, Grid, grid, town};
use laneweave::maps::{Drawing, regulations};
use laneweave::network::{DrivingSide, Network};
use laneweave::sim::{Assignment, Demand, Navigator, Purpose, Random, Rate, Setup, Share, World};
use laneweave::style::Population;

/// Length of a step [s].
pub const STEP_S: f64 = 0.1;
/// How long vehicles arrive in a town [s].
pub const DURATION_S: f64 = 7200.0;
/// Interval between measurements of travel times [s].
const GUIDED_EVERY_S: f64 = 60.0;
const TRUCKS: f64 = 0.1;

/// A town and its traffic.
pub struct Trial {
    /// The description of its map.
    pub map: String,
    /// Demand as a multiple of the estimated capacity.
    pub load: f64,
    /// Its world, before any vehicle has arrived.
    pub world: World,
}

impl Trial {
    /// The trial with a number, the same one on every machine. `store` arranges the storage of its chains; so many
    /// `threads` share a step.
    ///
    /// # Errors
    /// If the map cannot be drawn, or if there can be no traffic on it.
    pub fn new(
        number: u32,
        threads: usize,
        store: impl FnOnce(Network) -> Network,
    ) -> Result<Trial, Box<dyn Error>> {
        let random = Random::new(u64::from(number));
        let draw = |of: u32| random.uniform(of, Purpose::Arrival, number);
        let (map, network) = map(number, &draw)?;
        let network = store(network);
        let Population { driver_parameters, shares } = Population::usual(u64::from(number))?;
        let of_a_style = |it: &Share| (driver_parameters[it.first as usize].clone(), it.weight);
        let typical: Vec<_> = shares.iter().map(of_a_style).collect();
        let mut demand = Demand::even(&network, 1000.0, TRUCKS, shares);
        let load = 0.5 + 1.5 * draw(10);
        skew(&mut demand, &random);
        let navigator = Navigator::towards(&network, &demand.destinations);
        let assignment = Assignment::new(&network, &navigator, &demand, [0.0, DURATION_S]);
        let capacity = Capacity::new(&network, &assignment, &demand, &typical).veh_h;
        let all: f64 = demand.origins.iter().map(|it| it.rate.highest()).sum();
        for origin in &mut demand.origins {
            origin.rate = origin.rate.times(&Rate::constant(load * capacity / all));
        }
        let setup = Setup { step: STEP_S, seed: u64::from(number), threads };
        let world = World::new(network, driver_parameters, demand, setup)?.guided(GUIDED_EVERY_S)?;
        Ok(Trial { map, load, world })
    }
}

/// A map by its number: every fifth is the town, the others are grids.
fn map(number: u32, draw: &impl Fn(u32) -> f64) -> Result<(String, Network), Box<dyn Error>> {
    if number.is_multiple_of(5) {
        return Ok(("town".to_owned(), regulated(&town(DrivingSide::Right))?));
    }
    let among = |of: u32, least: usize, most: usize| least + (draw(of) * (most - least + 1) as f64) as usize;
    let controls = [
        Control::Signals,
        Control::Signals,
        Control::Priority,
        Control::RightBeforeLeft,
        Control::AllWayStop,
    ];
    let drawn = Grid {
        rows: among(0, 2, 5),
        columns: among(1, 2, 5),
        lanes: among(2, 1, 2),
        block_length_m: 100.0 + 150.0 * draw(3),
        control: controls[among(4, 0, controls.len() - 1)],
        ..Grid::default()
    };
    let Grid { rows, columns, lanes, control, .. } = drawn;
    let name = format!("grid {rows} x {columns}, {lanes} lanes, {control:?}");
    Ok((name, regulated(&grid(&drawn)?)?))
}

fn regulated(drawing: &Drawing) -> Result<Network, Box<dyn Error>> {
    let map = drawing.build()?;
    let rules = regulations(&map);
    Ok(map.network.regulated(&rules))
}

/// Gives some entrances and destinations much more weight than others.
fn skew(demand: &mut Demand, random: &Random) {
    let weight = |subject: u32| {
        let draw = random.uniform(subject, Purpose::Destination, 0);
        0.1 + draw * draw
    };
    for (number, origin) in demand.origins.iter_mut().enumerate() {
        origin.rate = origin.rate.times(&Rate::constant(weight(number as u32)));
        for (destination, it) in origin.weights.iter_mut().enumerate() {
            *it = weight(1_000_000 + (1000 * (number % 3) + destination) as u32);
        }
    }
}
