//! Whether traffic is as it was, bit for bit: hashes of what many runs come to, to be compared with those of another
//! commit.
//!
//! `cargo run --release -p laneweave-bench --bin hashes -- [MAP...]` prints a line for each run of ten minutes: on
//! these maps with two demands, on 20 random maps, and of 21 trials of `gridlock`. It fails if another number of
//! threads or another order of the chains in storage changes a hash.

use std::error::Error;
use std::path::Path;
use std::process::ExitCode;

use laneweave::Simulation;
use laneweave::generate;
use laneweave::maps::{Map, ReadOptions, load};
use laneweave::network::Network;
use laneweave_bench::say;
use laneweave_bench::trial::{STEP_S, Trial};

/// The allocator of the command.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

const DURATION_S: f64 = 600.0;
/// Demand on a map from a file, and on a random one [veh/h].
const DEMANDS: [f64; 2] = [1500.0, 3000.0];
const RANDOM_DEMAND: f64 = 600.0;
const RANDOM_MAPS: u64 = 20;
const TRIALS: u32 = 21;
const TRUCKS: f64 = 0.1;

/// How a run is carried out; this must not change it.
#[derive(Clone, Copy)]
struct Way {
    threads: usize,
    is_reversed: bool,
}

impl Way {
    const ALL: [Way; 3] = [
        Way { threads: 1, is_reversed: false },
        Way { threads: 2, is_reversed: false },
        Way { threads: 1, is_reversed: true },
    ];

    fn store(self, network: Network) -> Network {
        if self.is_reversed { network.with_chains_reversed() } else { network }
    }
}

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let mut is_same = true;
    for path in std::env::args().skip(1) {
        let name = Path::new(&path).file_name().unwrap_or_default().to_string_lossy().into_owned();
        let map = load(Path::new(&path), &ReadOptions::default())?;
        for demand in DEMANDS {
            is_same &= report(&format!("{name} {demand}"), |way| simulation(&map, demand, way))?;
        }
    }
    for seed in 1..=RANDOM_MAPS {
        let map = generate::random(seed).drawing.build()?;
        is_same &= report(&format!("random {seed}"), |way| simulation(&map, RANDOM_DEMAND, way))?;
    }
    for number in 0..TRIALS {
        let trial = |way: Way| Ok(Trial::new(number, way.threads, |it| way.store(it))?.simulation);
        is_same &= report(&format!("trial {number}"), trial)?;
    }
    Ok(if is_same { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

fn simulation(map: &Map, demand: f64, way: Way) -> Result<Simulation, Box<dyn Error>> {
    let map = Map { network: way.store(map.network.clone()), ..map.clone() };
    let simulation = Simulation::builder(map)
        .vehicles_per_hour(demand)
        .scenario(|it| it.demand.trucks = TRUCKS)
        .step_s(STEP_S)
        .threads(way.threads);
    Ok(simulation.build()?)
}

/// Carries out a run in all ways, and prints its hash. Returns whether all gave the same.
fn report(
    name: &str,
    simulation: impl Fn(Way) -> Result<Simulation, Box<dyn Error>>,
) -> Result<bool, Box<dyn Error>> {
    let mut hashes = Vec::new();
    for way in Way::ALL {
        let mut simulation = simulation(way)?;
        simulation.run(DURATION_S)?;
        hashes.push(simulation.state_hash());
    }
    let is_same = hashes.iter().all(|it| *it == hashes[0]);
    say(&format!("{name:44} {:016x}{}", hashes[0], if is_same { "" } else { " DIFFERS" }));
    Ok(is_same)
}
