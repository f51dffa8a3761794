//! Whether traffic is as it was, bit for bit: hashes of what many runs come to, to be compared with those of another
//! commit.
//!
//! `cargo run --release -p laneweave-bench --bin hashes -- [MAP...]` prints a line for each run of ten minutes: on
//! these maps with two demands, on 20 random maps, and of 21 trials of `gridlock`. It fails if another number of
//! threads or another order of the chains in storage changes a hash.

use std::error::Error;
use std::path::Path;
use std::process::ExitCode;

use laneweave::maps::{Map, ReadOptions, generate, load, regulations};
use laneweave::network::Network;
use laneweave::sim::{Demand, Setup, World};
use laneweave::style::Population;
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
        let network = regulated(load(Path::new(&path), &ReadOptions::default())?);
        for demand in DEMANDS {
            is_same &= report(&format!("{name} {demand}"), |way| world(&network, demand, way))?;
        }
    }
    for seed in 1..=RANDOM_MAPS {
        let network = regulated(generate::random(seed).drawing.build()?);
        is_same &= report(&format!("random {seed}"), |way| world(&network, RANDOM_DEMAND, way))?;
    }
    for number in 0..TRIALS {
        let trial = |way: Way| Ok(Trial::new(number, way.threads, |it| way.store(it))?.world);
        is_same &= report(&format!("trial {number}"), trial)?;
    }
    Ok(if is_same { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

fn regulated(map: Map) -> Network {
    let rules = regulations(&map);
    map.network.regulated(&rules)
}

fn world(network: &Network, demand: f64, way: Way) -> Result<World, Box<dyn Error>> {
    let network = way.store(network.clone());
    let Population { driver_parameters, shares } = Population::usual(1)?;
    let demand = Demand::even(&network, demand, TRUCKS, shares);
    let setup = Setup { step: STEP_S, seed: 1, threads: way.threads };
    Ok(World::new(network, driver_parameters, demand, setup)?)
}

/// Carries out a run in all ways, and prints its hash. Returns whether all gave the same.
fn report(name: &str, world: impl Fn(Way) -> Result<World, Box<dyn Error>>) -> Result<bool, Box<dyn Error>> {
    let mut hashes = Vec::new();
    for way in Way::ALL {
        let mut world = world(way)?;
        (0..(DURATION_S / STEP_S) as u32).for_each(|_| world.step());
        hashes.push(world.state_hash());
    }
    let is_same = hashes.iter().all(|it| *it == hashes[0]);
    say(&format!("{name:44} {:016x}{}", hashes[0], if is_same { "" } else { " DIFFERS" }));
    Ok(is_same)
}
