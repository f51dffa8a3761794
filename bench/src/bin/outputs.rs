//! What it costs to write results: the same hour with nothing written, and with more and more of it.
//!
//! `cargo run --release -p laneweave-bench --bin outputs [-- DIR]` runs a motorway of 20 km and the town of the demo, on one
//! thread and on two, into a folder for the time being in DIR, and prints what each kind of output adds to the time of the run that leaves
//! none. `… -- short DIR` runs twenty minutes of the motorway once, with everything, to count instructions under callgrind.

use std::error::Error;
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::time::Instant;
use std::{env, fs, process};

use laneweave::maps::generate::{Motorway, motorway};
use laneweave::maps::lanelet2;
use laneweave::output::{Inputs, Provenance, Summary, observers};
use laneweave::record::fingerprint;
use laneweave::scenario::{Origin, Scenario, SumoFile, prepare};
use laneweave::simulation::simulate;
use laneweave_bench::say;

/// The allocator of the command.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// Rounds, of which the best counts: whatever else the machine does only ever slows one down.
const ROUNDS: usize = 7;
const HOUR_S: f64 = 3600.0;
/// Length of the motorway [m], and vehicles that come [veh/h].
const MOTORWAY_M: f64 = 20_000.0;
const DEMAND: f64 = 5000.0;
const SHORT_S: f64 = 1200.0;

/// What a run leaves.
#[derive(Clone, Copy, PartialEq)]
enum Leaves {
    /// Nothing: no observer looks at it.
    Nothing,
    /// The report, its figures and all tables but trajectories.
    NoTrajectories,
    /// Beside it where every vehicle was in each second.
    Trajectories,
    /// Beside that all lanelets in each minute, and all of SUMO's files.
    Everything,
}

impl Leaves {
    const ALL: [Leaves; 4] =
        [Leaves::Nothing, Leaves::NoTrajectories, Leaves::Trajectories, Leaves::Everything];

    fn name(self) -> &'static str {
        match self {
            Leaves::Nothing => "nothing",
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
    for (name, scenario) in [("motorway", &motorway), ("demo", &demo)] {
        for threads in [1, 2] {
            let mut best = [f64::INFINITY; Leaves::ALL.len()];
            for _ in 0..ROUNDS {
                for (best, leaves) in best.iter_mut().zip(Leaves::ALL) {
                    *best = best.min(run(scenario, HOUR_S, threads, leaves, dir)?);
                }
            }
            let added = best
                .iter()
                .zip(Leaves::ALL)
                .skip(1)
                .map(|(it, leaves)| format!("{} +{:.1} %", leaves.name(), 100.0 * (it / best[0] - 1.0)));
            let added: Vec<String> = added.collect();
            say(&format!("{name}, {threads} thread(s): {:.3} s; {}", best[0], added.join(", ")));
        }
    }
    Ok(())
}

/// Time [s] from the first step to the last file.
fn run(
    (scenario, origin): &(Scenario, Origin),
    duration_s: f64,
    threads: usize,
    leaves: Leaves,
    dir: &Path,
) -> Result<f64, Box<dyn Error>> {
    let mut scenario = leaves.of(scenario, dir);
    scenario.run.duration_s = duration_s;
    scenario.run.threads = NonZero::new(threads);
    let mut prepared = prepare(&scenario, origin)?;
    let provenance = Provenance::of(String::new(), scenario.run.seed, fingerprint(&scenario, origin)?);
    let mut watching = match leaves {
        Leaves::Nothing => Vec::new(),
        _ => observers(&scenario, &prepared, &provenance)?,
    };
    let start = Instant::now();
    let ending = simulate(&mut prepared, &mut watching, None, None, |_| true, || ())?;
    let inputs =
        Inputs { scenario: &scenario, ending: &ending, wall_s: 0.0, load_s: 0.0, provenance: &provenance };
    let summary = Summary::of(&prepared, inputs);
    for observer in watching {
        observer.finish(&prepared.world, &summary)?;
    }
    Ok(start.elapsed().as_secs_f64())
}
