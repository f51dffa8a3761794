//! The cost of writing results: the same hour with no output, and with more and more of it.
//!
//! `cargo run --release -p laneweave-bench --bin outputs [-- DIR]` runs a motorway of 20 km and the town of the demo,
//! on one thread and on two, into a temporary folder in DIR. It prints how much time each kind of output adds to that
//! of the run without output: of the best rounds, and in the median of the differences within a round. For
//! comparison, a run without output is made while another core does unrelated work. `… -- short DIR` runs twenty
//! minutes of the motorway once, with all outputs, to count instructions under callgrind.

use std::error::Error;
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::time::Instant;
use std::{env, fs, process};

use laneweave::Simulation;
use laneweave::generate::{Motorway, motorway};
use laneweave::maps::lanelet2;
use laneweave::run::Run;
use laneweave::scenario::{Origin, Scenario, SumoFile};
use laneweave_bench::machine::{beside_a_busy_core, round_trip};
use laneweave_bench::say;

/// The allocator of the command.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

const HOUR_S: f64 = 3600.0;
/// Length of the motorway [m], and demand [veh/h].
const MOTORWAY_M: f64 = 20_000.0;
const DEMAND: f64 = 5000.0;
const SHORT_S: f64 = 1200.0;

/// The output of a run.
#[derive(Clone, Copy, PartialEq)]
enum Leaves {
    /// None: there is no observer.
    Nothing,
    /// None, but another core is busy.
    NothingBesideABusyCore,
    /// The report, its figures and all tables but trajectories.
    NoTrajectories,
    /// In addition, the trajectories at every second.
    Trajectories,
    /// In addition, all lanelets in each minute, and all of SUMO's files.
    Everything,
}

impl Leaves {
    const ALL: [Leaves; 5] = [
        Leaves::Nothing,
        Leaves::NothingBesideABusyCore,
        Leaves::NoTrajectories,
        Leaves::Trajectories,
        Leaves::Everything,
    ];

    fn name(self) -> &'static str {
        match self {
            Leaves::Nothing => "nothing",
            Leaves::NothingBesideABusyCore => "a busy core",
            Leaves::NoTrajectories => "no trajectories",
            Leaves::Trajectories => "trajectories",
            Leaves::Everything => "everything",
        }
    }

    fn of(self, scenario: &Scenario, dir: &Path) -> Scenario {
        let mut scenario = scenario.clone();
        let output = &mut scenario.output;
        output.dir = dir.into();
        output.record_s = f64::from(u8::from(matches!(self, Leaves::Trajectories | Leaves::Everything)));
        if self == Leaves::Everything {
            output.flows_s = 60.0;
            output.sumo = [SumoFile::Fcd, SumoFile::Tripinfo, SumoFile::Lanechange].into();
        }
        scenario
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments: Vec<String> = env::args().skip(1).collect();
    let is_short = arguments.first().is_some_and(|it| it == "short");
    arguments.drain(..usize::from(is_short));
    let parent = arguments.pop().map_or_else(env::temp_dir, PathBuf::from);
    let dir = parent.join(format!("laneweave-outputs-{}", process::id()));
    fs::create_dir_all(&dir)?;
    let measured = measure(is_short, &dir);
    fs::remove_dir_all(&dir)?;
    measured
}

fn measure(is_short: bool, dir: &Path) -> Result<(), Box<dyn Error>> {
    let map = dir.join("motorway.osm");
    let drawing = motorway(&Motorway { lanes: 3, length_m: MOTORWAY_M, ..Motorway::default() })?;
    fs::write(&map, lanelet2::write(&drawing))?;
    let (mut scenario, origin) = Origin::open(&map)?;
    scenario.demand.vehicles_per_hour = Some(DEMAND);
    let motorway = (scenario, origin);
    if is_short {
        run(&motorway, SHORT_S, 1, Leaves::Everything, dir)?;
        return Ok(());
    }
    let demo = Origin::demo()?;
    for (name, scenario, rounds) in [("motorway", &motorway, 7), ("demo", &demo, 21)] {
        for threads in [1, 2] {
            let mut times = Leaves::ALL.map(|_| Vec::new());
            let (mut nearest, mut farthest) = (f64::INFINITY, 0.0_f64);
            for _ in 0..rounds {
                let now = round_trip();
                (nearest, farthest) = (nearest.min(now), farthest.max(now));
                for (times, leaves) in times.iter_mut().zip(Leaves::ALL) {
                    times.push(run(scenario, HOUR_S, threads, leaves, dir)?);
                }
            }
            let [alone, others @ ..] = &times;
            say(&format!(
                "{name}, {threads} thread(s): {:.3} s at best; a message from core to core and back takes {nearest:.0} to {farthest:.0} ns",
                best(alone)
            ));
            for (others, leaves) in others.iter().zip(&Leaves::ALL[1..]) {
                let name = leaves.name();
                let [best, median] =
                    [best(others) / best(alone), median_ratio(others, alone)].map(|it| 100.0 * (it - 1.0));
                say(&format!("  {name:16} {best:+6.1} % of the best rounds, {median:+6.1} % in the median"));
            }
        }
    }
    Ok(())
}

/// The shortest time: other work of the machine only ever slows a round down.
fn best(times: &[f64]) -> f64 {
    times.iter().copied().fold(f64::INFINITY, f64::min)
}

/// The median of the ratios of times within a round.
fn median_ratio(times: &[f64], others: &[f64]) -> f64 {
    let mut ratios: Vec<f64> = times.iter().zip(others).map(|(it, other)| it / other).collect();
    ratios.sort_by(f64::total_cmp);
    ratios.get(ratios.len() / 2).copied().unwrap_or(f64::NAN)
}

/// Time [s] from the first step to the last file.
fn run(
    (scenario, origin): &(Scenario, Origin),
    duration_s: f64,
    threads: usize,
    leaves: Leaves,
    dir: &Path,
) -> Result<f64, Box<dyn Error>> {
    // The results of an earlier run are not replaced: their removal costs time.
    let dir = dir.join("run");
    let mut scenario = leaves.of(scenario, &dir);
    scenario.run.duration_s = duration_s;
    scenario.run.threads = NonZero::new(threads);
    let simulation = Simulation::from_scenario(&scenario, origin)?;
    let to_the_end = move || -> Result<f64, Box<dyn Error>> {
        let start = Instant::now();
        match leaves {
            Leaves::Nothing | Leaves::NothingBesideABusyCore => {
                let mut simulation = simulation;
                simulation.run(simulation.end_s())?;
            }
            _ => drop(Run::of(simulation, "a benchmark")?.complete(|_| true)?),
        }
        Ok(start.elapsed().as_secs_f64())
    };
    let time = match leaves {
        Leaves::NothingBesideABusyCore => beside_a_busy_core(to_the_end),
        _ => to_the_end(),
    };
    if dir.exists() {
        fs::remove_dir_all(dir)?;
    }
    time
}
