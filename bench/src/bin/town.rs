//! How fast the step is in a town: short lanes, lights, queues, and turns at every corner.
//!
//! `cargo run --release -p laneweave-bench --bin town` fills a grid of 20 by 20 junctions with lights and two lanes in each
//! direction until some 6,000 vehicles are on it, then measures a minute at steps of 0.1 s, on one core and on two.
//! `… -- short` measures half a minute of a grid of 6 by 6 junctions, as full, on one core only, to count instructions under
//! callgrind: `--toggle-collect='*measured*'` leaves out how it was filled.

use std::error::Error;
use std::time::Instant;

use laneweave::maps::generate::{Grid, grid};
use laneweave::maps::regulations;
use laneweave::sim::{Demand, Setup, World};
use laneweave::style::Population;

/// The allocator of the command.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// A grid of streets, and when it is full.
#[derive(Clone, Copy)]
struct Town {
    /// Streets in both directions.
    streets: usize,
    /// Vehicles that come [veh/h].
    demand: f64,
    /// Vehicles from which on is measured.
    vehicles: usize,
}

const TOWN: Town = Town { streets: 20, demand: 60_000.0, vehicles: 6000 };
const SMALL_TOWN: Town = Town { streets: 6, demand: 18_000.0, vehicles: 540 };
const TRUCKS: f64 = 0.1;
const STEP_S: f64 = 0.1;

fn main() -> Result<(), Box<dyn Error>> {
    if std::env::args().nth(1).as_deref() == Some("short") {
        return measure(SMALL_TOWN, 1, 300).map(|_| ());
    }
    let one = measure(TOWN, 1, 600)?;
    let two = measure(TOWN, 2, 600)?;
    say(&format!("two threads are {:.2} times one", two / one));
    Ok(())
}

/// Updates per second over `steps` steps of `town` when it is full.
fn measure(town: Town, threads: usize, steps: u32) -> Result<f64, Box<dyn Error>> {
    let mut world = empty_town(town, threads)?;
    while world.on_road() < town.vehicles {
        world.step();
    }
    let filled_s = world.clock().time();
    world.reset_counts();
    let wall_s = measured(&mut world, steps);
    let updates = world.tally().updates;
    let rate = updates as f64 / wall_s;
    say(&format!(
        "{0} by {0}: filled in {filled_s:.0} s, {1:5} vehicles, {threads} thread(s): {updates} updates, {2:4.2} million/s, {3:4.0} ns each, hash {4:016x}",
        town.streets,
        world.on_road(),
        rate / 1e6,
        1e9 / rate,
        world.state_hash(),
    ));
    Ok(rate)
}

/// Time that `steps` steps take [s].
#[inline(never)]
fn measured(world: &mut World, steps: u32) -> f64 {
    let start = Instant::now();
    for _ in 0..steps {
        world.step();
    }
    start.elapsed().as_secs_f64()
}

fn empty_town(town: Town, threads: usize) -> Result<World, Box<dyn Error>> {
    let Town { streets, demand, .. } = town;
    let map = grid(&Grid { rows: streets, columns: streets, ..Grid::default() })?.build()?;
    let network = map.network.clone().regulated(&regulations(&map));
    let Population { characters, shares } = Population::usual(1)?;
    let demand = Demand::even(&network, demand, TRUCKS, shares);
    Ok(World::new(network, characters, demand, Setup { step: STEP_S, seed: 1, threads })?)
}

#[expect(clippy::print_stdout, reason = "this is what it is for")]
fn say(line: &str) {
    println!("{line}");
}
