//! How much time and memory many worlds of one template take.
//!
//! `cargo run --release -p laneweave-bench --bin worlds` prints times and memory. `… -- SPAWNS RESETS` does only that:
//! the difference of two runs under callgrind counts instructions.

use std::error::Error;
use std::time::Instant;

use laneweave::{Simulation, Template};
use laneweave_bench::say;

/// A merge: worlds of it have some 30 vehicles after a minute.
const MAP: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../maps/on_ramp.osm");
const VEHICLES_PER_HOUR: f64 = 3000.0;
const UNTIL_S: f64 = 60.0;
const WORLDS: u64 = 1024;

fn main() -> Result<(), Box<dyn Error>> {
    let template = Simulation::builder(MAP).vehicles_per_hour(VEHICLES_PER_HOUR).template()?;
    let numbers: Result<Vec<u64>, _> = std::env::args().skip(1).map(|it| it.parse()).collect();
    match numbers?[..] {
        [spawns, resets] => count(&template, spawns, resets),
        _ => measure(&template),
    }
}

fn count(template: &Template, spawns: u64, resets: u64) -> Result<(), Box<dyn Error>> {
    for seed in 0..spawns {
        template.spawn(seed)?;
    }
    let mut world = template.spawn(1)?;
    for seed in 0..resets {
        // What a reset has to clear.
        world.steps(10);
        world.reset(seed)?;
    }
    Ok(())
}

fn measure(template: &Template) -> Result<(), Box<dyn Error>> {
    let before = resident_kb();
    let start = Instant::now();
    let worlds: Result<Vec<Simulation>, _> = (0..WORLDS).map(|it| template.spawn(it)).collect();
    let (mut worlds, spawned) = (worlds?, start.elapsed().as_secs_f64());
    let empty = resident_kb();
    for world in &mut worlds {
        world.run(UNTIL_S)?;
    }
    let full = resident_kb();
    let vehicles: usize = worlds.iter().map(Simulation::on_road).sum();
    let start = Instant::now();
    for (world, seed) in worlds.iter_mut().zip(1..) {
        world.reset(seed)?;
    }
    let reset = start.elapsed().as_secs_f64();
    let each = |it: f64| it / WORLDS as f64;
    say(&format!(
        "{WORLDS} worlds: a spawn takes {:.1} µs, a reset {:.1} µs; a world takes {:.1} kB, and {:.1} kB with {:.1} vehicles",
        1e6 * each(spawned),
        1e6 * each(reset),
        each((empty - before) as f64),
        each((full - before) as f64),
        each(vehicles as f64),
    ));
    Ok(())
}

/// The memory of this process [kB]; 0 where the system does not say.
fn resident_kb() -> i64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|it| it.strip_prefix("VmRSS:"));
    line.and_then(|it| it.trim().trim_end_matches("kB").trim().parse().ok()).unwrap_or(0)
}
