//! Whether towns lock: random grids, and the town of `maps/`, under random demand of up to twice their estimated
//! capacity, from some entrances much more than from others, for two hours each.
//!
//! `cargo run --release -p laneweave-bench --bin gridlock -- [TRIALS] [FIRST]` runs so many trials (200), the first of
//! which has the number FIRST (0), and prints a line for each. It fails if in one of them a vehicle is stuck, no
//! vehicle leaves for ten minutes, or traffic does not stay free of collisions.

use std::error::Error;
use std::process::ExitCode;

use laneweave_bench::say;
use laneweave_bench::trial::{DURATION_S, STEP_S, Trial};

const TRIALS: u32 = 200;
/// Throughput is watched over this time [s].
const WATCHED_S: f64 = 600.0;

/// The allocator of the command.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let mut numbers = std::env::args().skip(1).map(|it| it.parse::<u32>());
    let trials = numbers.next().transpose()?.unwrap_or(TRIALS);
    let first = numbers.next().transpose()?.unwrap_or(0);
    let mut failed = 0;
    for number in first..first + trials {
        let outcome = drive(number)?;
        failed += u32::from(!outcome.is_fine());
        say(&outcome.line(number));
    }
    say(&format!("{failed} of {trials} trials failed"));
    Ok(if failed == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// The result of a trial.
struct Outcome {
    map: String,
    /// Demand as a multiple of the estimated capacity.
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

fn drive(number: u32) -> Result<Outcome, Box<dyn Error>> {
    let Trial { map, load, mut simulation } = Trial::new(number, 1, |it| it)?;
    let (mut before, mut fewest) = (0, u64::MAX);
    for step in 1..=(DURATION_S / STEP_S) as u32 {
        simulation.advance();
        if step % (WATCHED_S / STEP_S) as u32 == 0 {
            let left = simulation.counts().left;
            fewest = fewest.min(if before > 0 { left - before } else { u64::MAX });
            before = left;
        }
    }
    let (counts, counters) = (*simulation.counts(), simulation.counters());
    Ok(Outcome {
        map,
        load,
        entered: counts.entered,
        left: counts.left,
        on_road: simulation.on_road(),
        waiting: simulation.waiting_to_enter(),
        stuck: counters.stuck,
        fewest,
        collisions: counters.collisions,
        overlaps: counters.overlaps,
    })
}
