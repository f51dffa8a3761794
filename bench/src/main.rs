//! Updates per second on a motorway of 40 km and four lanes, and how the cost grows from a thousand vehicles to a
//! million at equal density.
#[path = "../../crates/sim/tests/roads/drivers.rs"]
mod drivers;

use std::time::Instant;

use laneweave_maps::generate::{Motorway, motorway};
use laneweave_network::Network;
use laneweave_sim::{Class, NewVehicle, Random, Purpose, Setup, World};

/// Vehicles per kilometre and lane.
const DENSITY: f64 = 12.5;
const LANES: usize = 4;

fn network(length_m: f64) -> Network {
    let plan = Motorway { lanes: LANES, length_m, lanelet_length_m: 500.0, ..Motorway::default() };
    motorway(&plan).unwrap().network().unwrap().0
}

/// A motorway with traffic on it, driven in.
fn world(length_m: f64, threads: usize, warm_up: u32) -> World {
    let network = network(length_m);
    let flow = DENSITY * 26.0 * 3.6 * LANES as f64;
    let demand = drivers::demand(&network, flow, 0.1, &[0.119, 0.881]);
    let setup = Setup { step: 0.1, seed: 1, threads };
    let characters = vec![drivers::aggressive(), drivers::conservative()];
    let chains: Vec<(u32, f64)> = network.chains.iter().zip(0..).map(|(c, i)| (i, c.length)).collect();
    let mut world = World::new(network, characters, demand, setup).unwrap();
    let random = Random::new(7);
    let mut number = 0;
    for (chain, length) in chains {
        let mut x = 40.0;
        while x < length {
            let draw = |purpose| random.uniform(number, purpose, 0);
            let class = if draw(Purpose::Class) < 0.1 { Class::Truck } else { Class::Car };
            world.place(NewVehicle {
                chain: laneweave_network::ChainIndex(chain),
                x,
                speed: 25.0,
                class,
                character: u32::from(draw(Purpose::Style) > 0.119),
                destination: Some(0),
            });
            x += 1000.0 / DENSITY * (0.7 + 0.6 * draw(Purpose::Arrival));
            number += 1;
        }
    }
    for _ in 0..warm_up {
        world.step();
    }
    world
}

fn resident_mb() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find(|line| line.starts_with("VmRSS")).unwrap_or("VmRSS: 0 kB");
    line.split_whitespace().nth(1).and_then(|it| it.parse::<f64>().ok()).unwrap_or(0.0) / 1024.0
}

fn measure(name: &str, length_m: f64, threads: usize, steps: u32) -> f64 {
    let before = resident_mb();
    let mut world = world(length_m, threads, 300);
    world.reset_counts();
    let start = Instant::now();
    for _ in 0..steps {
        world.step();
    }
    let wall = start.elapsed().as_secs_f64();
    let tally = world.tally();
    let rate = tally.updates as f64 / wall;
    let n = world.on_road();
    println!(
        "{name}: {n} vehicles, {threads} threads: {:.2} M updates/s, {:.1} ns/update, step {:.0} us, considered every {:.2} s, {:.0} B/vehicle, hash {:016x}",
        rate / 1e6, 1e9 / rate, wall / f64::from(steps) * 1e6,
        tally.updates as f64 * 0.1 / tally.considerations as f64,
        (resident_mb() - before) * 1048576.0 / n as f64,
        world.state_hash()
    );
    rate
}

fn main() {
    let mode = std::env::args().nth(1).unwrap_or_default();
    if mode == "short" {
        measure("40 km", 40_000.0, 1, 300);
        return;
    }
    if mode == "million" {
        measure("20,000 km", 20_000_000.0, 1, 30);
        return;
    }
    if mode == "one" {
        measure("40 km", 40_000.0, 1, 3000);
        return;
    }
    let one = measure("40 km", 40_000.0, 1, 3000);
    let two = measure("40 km", 40_000.0, 2, 3000);
    println!("two threads: {:.2} times", two / one);
    if mode == "scale" {
        measure("20 km", 20_000.0, 1, 3000);
        measure("200 km", 200_000.0, 1, 1000);
        measure("2,000 km", 2_000_000.0, 1, 100);
        measure("20,000 km", 20_000_000.0, 1, 50);
        measure("20,000 km", 20_000_000.0, 2, 50);
    }
}
