//! Random towns under random demand of up to twice their estimated capacity, from some entrances much more than from
//! others.

use laneweave::Id;
use std::error::Error;

use laneweave::Simulation;
use laneweave::generate::{Control, Grid, grid, town};
use laneweave::maps::Map;
use laneweave::network::{DrivingSide, Network};
use laneweave::scenario::OdRow;
use laneweave::sim::{Purpose, Random};

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
    /// Its simulation, before any vehicle has arrived.
    pub simulation: Simulation,
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
        store: impl Fn(Network) -> Network,
    ) -> Result<Trial, Box<dyn Error>> {
        let random = Random::new(u64::from(number));
        let draw = |of: u32| random.uniform(of, Purpose::Arrival, number);
        let (name, map) = map(number, &draw)?;
        let map = Map { network: store(map.network), ..map };
        let loaded = |od: Vec<OdRow>| {
            let demand = |it: &mut laneweave::scenario::Scenario| {
                (it.demand.trucks, it.guidance.interval_s) = (TRUCKS, GUIDED_EVERY_S);
                it.demand.od = od;
            };
            let simulation = Simulation::builder(map.clone()).scenario(demand);
            simulation.seed(u64::from(number)).step_s(STEP_S).duration_s(DURATION_S).threads(threads).build()
        };
        let even = loaded(Vec::new())?;
        let [origins, destinations] =
            [even.origins().into_iter().map(|(id, _)| id).collect(), even.destinations()];
        let mut rows = skewed(&origins, &destinations, &|from, to| even.leads(from, to), &random);
        // A demand of one vehicle an hour in all shows the capacity for these shares.
        let load = 0.5 + 1.5 * draw(10);
        let all = load * loaded(rows.clone())?.capacity().veh_h;
        rows.iter_mut().for_each(|it| it.vehicles_per_hour *= all);
        Ok(Trial { map: name, load, simulation: loaded(rows)? })
    }
}

/// A map by its number: every fifth is the town, the others are grids.
fn map(number: u32, draw: &impl Fn(u32) -> f64) -> Result<(String, Map), Box<dyn Error>> {
    if number.is_multiple_of(5) {
        return Ok(("town".to_owned(), town(DrivingSide::Right).build()?));
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
    Ok((name, grid(&drawn)?.build()?))
}

/// A demand of one vehicle an hour in all, of which some entrances and destinations have much more than others. Trips
/// go where one `leads`.
fn skewed(
    origins: &[Id],
    destinations: &[Id],
    leads: &dyn Fn(Id, Id) -> bool,
    random: &Random,
) -> Vec<OdRow> {
    let weight = |subject: u32| {
        let draw = random.uniform(subject, Purpose::Destination, 0);
        0.1 + draw * draw
    };
    let leads_anywhere = |from: Id| destinations.iter().any(|it| *it != from && leads(from, *it));
    let used = origins.iter().enumerate().filter(|(_, from)| leads_anywhere(**from));
    let all: f64 = used.map(|(number, _)| weight(number as u32)).sum();
    let mut rows = Vec::new();
    for (number, from) in origins.iter().enumerate() {
        let to_others = |it: &usize| destinations[*it] != *from && leads(*from, destinations[*it]);
        let shares: Vec<(usize, f64)> = (0..destinations.len())
            .filter(to_others)
            .map(|it| (it, weight(1_000_000 + (1000 * (number % 3) + it) as u32)))
            .collect();
        let sum: f64 = shares.iter().map(|it| it.1).sum();
        let rate = weight(number as u32) / all;
        rows.extend(shares.into_iter().map(|(destination, share)| OdRow {
            from: from.to_string(),
            to: destinations[destination].to_string(),
            vehicles_per_hour: rate * share / sum,
        }));
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_town_and_a_grid_have_traffic_that_can_be_driven() {
        for number in 0..2 {
            let trial = Trial::new(number, 1, |it| it).expect("there are routes");
            assert!(trial.simulation.origins().iter().any(|(_, rate)| *rate > 0.0), "{}", trial.map);
        }
    }
}
