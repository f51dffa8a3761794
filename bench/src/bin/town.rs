//! How fast the step is in a town: short lanes, lights, queues, and turns at every corner.
//!
//! `cargo run --release -p laneweave-bench --bin town` fills a grid of 20 by 20 junctions with lights and two lanes in
//! each direction until some 6,000 vehicles are on it, then measures a minute at steps of 0.1 s in twelve rounds, on
//! one core and then on two: two towns at once would not fit into a cache. `… -- short` measures half a minute of a
//! grid of 6 by 6 junctions, as full, on one core only, to count instructions under callgrind:
//! `--toggle-collect='*measured*'` leaves out how it was filled.

use std::error::Error;
use std::time::Instant;

use laneweave::Simulation;
use laneweave::generate::{Grid, grid};
use laneweave_bench::{Rates, say};

/// The allocator of the command.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// A grid of streets, and the number of vehicles at which it is full.
#[derive(Clone, Copy)]
struct Town {
    /// Streets in both directions.
    streets: usize,
    /// Demand [veh/h].
    demand: f64,
    /// Number of vehicles at which measuring begins.
    vehicles: usize,
}

const TOWN: Town = Town { streets: 20, demand: 60_000.0, vehicles: 6000 };
const SMALL_TOWN: Town = Town { streets: 6, demand: 18_000.0, vehicles: 540 };
const TRUCKS: f64 = 0.1;
const STEP_S: f64 = 0.1;

fn main() -> Result<(), Box<dyn Error>> {
    if std::env::args().nth(1).as_deref() == Some("short") {
        return measure(SMALL_TOWN, 1, [1, 300]).map(|_| ());
    }
    let (one, two) = (measure(TOWN, 1, [12, 50])?, measure(TOWN, 2, [12, 50])?);
    say(&format!("two threads are {:.2} times one", two.best() / one.best()));
    Ok(())
}

/// Measures so many rounds of so many steps of `town` when it is full.
fn measure(town: Town, threads: usize, [rounds, steps]: [u32; 2]) -> Result<Rates, Box<dyn Error>> {
    let mut town = Measured::of(town, threads)?;
    (0..rounds).for_each(|_| town.go_on(steps));
    town.print();
    Ok(town.rates)
}

/// A full town under measurement.
struct Measured {
    simulation: Simulation,
    town: Town,
    threads: usize,
    /// Time at which it was full [s].
    filled_s: f64,
    /// Updates until then.
    filling: u64,
    rates: Rates,
}

impl Measured {
    fn of(town: Town, threads: usize) -> Result<Measured, Box<dyn Error>> {
        let mut simulation = empty_town(town, threads)?;
        while simulation.on_road() < town.vehicles {
            simulation.advance();
        }
        let (filled_s, filling) = (simulation.time_s(), simulation.counters().updates);
        Ok(Measured { simulation, town, threads, filled_s, filling, rates: Rates::default() })
    }

    /// One more round.
    fn go_on(&mut self, steps: u32) {
        let updates = self.simulation.counters().updates;
        let wall_s = measured(&mut self.simulation, steps);
        self.rates.push(self.simulation.counters().updates - updates, wall_s);
    }

    fn print(&self) {
        let (best, median) = (self.rates.best(), self.rates.median());
        say(&format!(
            "{0} by {0}: filled in {1:.0} s, {2:5} vehicles, {3} thread(s): {4} updates, {5:4.2} million/s at best, {6:4.2} in the median, {7:4.0} ns each, hash {8:016x}",
            self.town.streets,
            self.filled_s,
            self.simulation.on_road(),
            self.threads,
            self.simulation.counters().updates - self.filling,
            best / 1e6,
            median / 1e6,
            1e9 / best,
            self.simulation.state_hash(),
        ));
    }
}

/// Time that `steps` steps take [s].
#[inline(never)]
fn measured(simulation: &mut Simulation, steps: u32) -> f64 {
    let start = Instant::now();
    (0..steps).for_each(|_| simulation.advance());
    start.elapsed().as_secs_f64()
}

fn empty_town(town: Town, threads: usize) -> Result<Simulation, Box<dyn Error>> {
    let Town { streets, demand, .. } = town;
    let map = grid(&Grid { rows: streets, columns: streets, ..Grid::default() })?.build()?;
    let simulation = Simulation::builder(map)
        .vehicles_per_hour(demand)
        .scenario(|it| (it.demand.trucks, it.guidance.interval_s) = (TRUCKS, 0.0))
        .step_s(STEP_S)
        .threads(threads);
    Ok(simulation.build()?)
}
