//! Whether towns lock: random grids, and the town of `maps/`, under random demand of up to twice what they bear, from
//! some entrances much more than from others, for two hours each.
//!
//! `cargo run --release -p laneweave-bench --bin gridlock -- [TRIALS] [FIRST]` runs so many trials (200), the first of which has
//! the number FIRST (0), and prints a line for each. It fails if in one of them a vehicle is stuck, nobody leaves for ten
//! minutes, or traffic does not stay free of collisions.

use std::error::Error;
use std::process::ExitCode;

use laneweave::Capacity;
use laneweave::maps::generate::{Control, Grid, grid, town};
use laneweave::maps::{Drawing, regulations};
use laneweave::network::{DrivingSide, Network};
use laneweave::sim::{Assignment, Demand, Navigator, Purpose, Random, Rate, Setup, Share, World};
use laneweave::style::Population;
use laneweave_bench::say;

const TRIALS: u32 = 200;
const STEP_S: f64 = 0.1;
const DURATION_S: f64 = 7200.0;
/// Throughput is watched over this time [s].
const WATCHED_S: f64 = 600.0;
/// Travel times are measured so often [s].
const GUIDED_EVERY_S: f64 = 60.0;
const TRUCKS: f64 = 0.1;

/// The allocator of the command.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let mut numbers = std::env::args().skip(1).map(|it| it.parse::<u32>());
    let trials = numbers.next().transpose()?.unwrap_or(TRIALS);
    let first = numbers.next().transpose()?.unwrap_or(0);
    let mut failed = 0;
    for number in first..first + trials {
        let outcome = trial(number)?;
        failed += u32::from(!outcome.is_fine());
        say(&outcome.line(number));
    }
    say(&format!("{failed} of {trials} trials failed"));
    Ok(if failed == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// What became of a trial.
struct Outcome {
    map: String,
    /// Demand as a multiple of what the map bears.
    load: f64,
    entered: u64,
    left: u64,
    on_road: usize,
    waiting: usize,
    stuck: u64,
    /// Fewest vehicles that left in any ten minutes but the first.
    fewest: u64,
    collisions: u64,
    overlaps: u64,
}

impl Outcome {
    fn is_fine(&self) -> bool {
        self.stuck == 0 && self.fewest > 0 && self.collisions == 0 && self.overlaps == 0
    }

    fn line(&self, number: u32) -> String {
        let Outcome { map, load, entered, left, on_road, waiting, stuck, fewest, collisions, overlaps } =
            self;
        let verdict = if self.is_fine() { "fine" } else { "FAILED" };
        format!(
            "{number:4} {verdict:6} {map:34} load {load:.2}: {entered:6} entered, {left:6} left, {on_road:5} on the road, {waiting:6} waiting; in ten minutes at least {fewest:4} left; {stuck} stuck, {collisions} collisions, {overlaps} overlaps"
        )
    }
}

fn trial(number: u32) -> Result<Outcome, Box<dyn Error>> {
    let random = Random::new(u64::from(number));
    let draw = |of: u32| random.uniform(of, Purpose::Arrival, number);
    let (map, network) = map(number, &draw)?;
    let Population { characters, shares } = Population::usual(u64::from(number))?;
    let of_a_style = |it: &Share| (characters[it.first as usize].clone(), it.weight);
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
    let setup = Setup { step: STEP_S, seed: u64::from(number), threads: 1 };
    let mut world = World::new(network, characters, demand, setup)?.guided(GUIDED_EVERY_S)?;
    let (mut before, mut fewest) = (0, u64::MAX);
    for step in 1..=(DURATION_S / STEP_S) as u32 {
        world.step();
        if step % (WATCHED_S / STEP_S) as u32 == 0 {
            let left = world.counts().left;
            fewest = fewest.min(if before > 0 { left - before } else { u64::MAX });
            before = left;
        }
    }
    let (counts, tally) = (*world.counts(), world.tally());
    Ok(Outcome {
        map,
        load,
        entered: counts.entered,
        left: counts.left,
        on_road: world.on_road(),
        waiting: world.waiting(),
        stuck: tally.stuck,
        fewest,
        collisions: tally.collisions,
        overlaps: tally.overlaps,
    })
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

/// Makes some entrances and destinations count for much more than others.
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
