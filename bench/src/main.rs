//! How fast the step is, and how its cost grows.
//!
//! `cargo run --release -p laneweave-bench` measures a motorway of 40 km and four lanes with some 2,000 vehicles at
//! steps of 0.1 s, every driver not in a change considering lanes once a second, on one core and on two; what two cores of
//! the machine can give at most; then the same density on longer roads, up to a million vehicles; then the memory that a
//! vehicle needs.
//! `… -- short` runs 300 steps of the first on one core only, to count instructions under callgrind.

use std::alloc::{GlobalAlloc, Layout};
use std::error::Error;
use std::sync::atomic::{AtomicU32, AtomicUsize, Ordering};
use std::time::Instant;

use laneweave::maps::generate::{Motorway, motorway};
use laneweave::network::{ChainIndex, Network};
use laneweave::sim::{Class, Demand, NewVehicle, Purpose, Random, Setup, World};
use laneweave::style::Population;

#[global_allocator]
static ALLOCATOR: Counting = Counting(AtomicUsize::new(0));

/// The allocator of the command, counting the bytes in use.
struct Counting(AtomicUsize);

#[expect(unsafe_code, reason = "memory in use is known to the allocator only")]
// SAFETY: everything is passed on.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        self.0.fetch_add(layout.size(), Ordering::Relaxed);
        // SAFETY: as for this method.
        unsafe { mimalloc::MiMalloc.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        self.0.fetch_sub(layout.size(), Ordering::Relaxed);
        // SAFETY: as for this method.
        unsafe { mimalloc::MiMalloc.dealloc(pointer, layout) }
    }
}

/// Bytes in use.
fn in_use() -> f64 {
    ALLOCATOR.0.load(Ordering::Relaxed) as f64
}

const LANES: usize = 4;
/// Vehicles per kilometre and lane.
const DENSITY: f64 = 12.5;
/// Mean speed that goes with it [m/s]; what drives out at the end comes in at the start.
const SPEED: f64 = 26.0;
const TRUCKS: f64 = 0.1;
const STEP_S: f64 = 0.1;
/// Steps before measuring, in which changes of lane set in.
const WARM_UP: u32 = 100;

fn main() -> Result<(), Box<dyn Error>> {
    if std::env::args().nth(1).as_deref() == Some("short") {
        return Measurement::of(40.0, 1, 300).map(|it| it.print("40 km"));
    }
    let one = Measurement::of(40.0, 1, 6000)?;
    one.print("40 km");
    let two = Measurement::of(40.0, 2, 6000)?;
    two.print("40 km");
    say(&format!("two threads are {:.2} times one", two.rate() / one.rate()));
    say(&format!(
        "two motorways of 20 km on a thread each, in step, are {:.2} times one",
        limit_of_two_threads()?
    ));
    let small = Measurement::of(20.0, 1, 6000)?;
    small.print("20 km");
    Measurement::of(200.0, 1, 600)?.print("200 km");
    Measurement::of(2_000.0, 1, 60)?.print("2,000 km");
    let large = Measurement::of(20_000.0, 1, 30)?;
    large.print("20,000 km");
    say(&format!("from a thousand to a million, an update costs {:.2} times", small.rate() / large.rate()));
    Measurement::of(20_000.0, 2, 30)?.print("20,000 km");
    Ok(())
}

/// One measured run.
struct Measurement {
    vehicles: usize,
    threads: usize,
    updates: u64,
    considerations: u64,
    steps: u32,
    wall_s: f64,
    bytes_per_vehicle: f64,
    hash: u64,
}

impl Measurement {
    /// Runs `steps` steps of a motorway of `length_km`.
    fn of(length_km: f64, threads: usize, steps: u32) -> Result<Measurement, Box<dyn Error>> {
        let mut world = empty_motorway(1000.0 * length_km, threads)?;
        let empty = in_use();
        fill(&mut world);
        for _ in 0..WARM_UP {
            world.step();
        }
        world.reset_counts();
        let start = Instant::now();
        for _ in 0..steps {
            world.step();
        }
        let wall_s = start.elapsed().as_secs_f64();
        let vehicles = world.on_road();
        let tally = world.tally();
        Ok(Measurement {
            vehicles,
            threads,
            updates: tally.updates,
            considerations: tally.considerations,
            steps,
            wall_s,
            bytes_per_vehicle: (in_use() - empty) / vehicles as f64,
            hash: world.state_hash(),
        })
    }

    /// Updates per second.
    fn rate(&self) -> f64 {
        self.updates as f64 / self.wall_s
    }

    fn print(&self, road: &str) {
        let considered_every = self.updates as f64 * STEP_S / self.considerations as f64;
        let simulated_s = f64::from(self.steps) * STEP_S;
        say(&format!(
            "{road:>9}: {:7} vehicles, {} thread(s): {:5.1} million updates/s, {:5.1} ns each, {:5.1} times real time, considered every {considered_every:.2} s, {:4.0} B/vehicle, hash {:016x}",
            self.vehicles,
            self.threads,
            self.rate() / 1e6,
            1e9 / self.rate(),
            simulated_s / self.wall_s,
            self.bytes_per_vehicle,
            self.hash,
        ));
    }
}

/// How many times faster two motorways of half the length are on two threads than on one, if the threads share nothing
/// but wait for each other after every step: what the machine leaves of two cores.
fn limit_of_two_threads() -> Result<f64, Box<dyn Error>> {
    let half = || -> Result<World, Box<dyn Error>> {
        let mut world = empty_motorway(20_000.0, 1)?;
        fill(&mut world);
        (0..WARM_UP).for_each(|_| world.step());
        world.reset_counts();
        Ok(world)
    };
    let alone = in_step(half()?, &AtomicU32::new(0), 1);
    let (one, other, arrived) = (half()?, half()?, AtomicU32::new(0));
    let together = std::thread::scope(|scope| {
        let other = scope.spawn(|| in_step(other, &arrived, 2));
        in_step(one, &arrived, 2) + other.join().unwrap_or_default()
    });
    Ok(together / alone)
}

/// Updates per second of a world that waits after every step until as many as `threads` have `arrived`.
fn in_step(mut world: World, arrived: &AtomicU32, threads: u32) -> f64 {
    let start = Instant::now();
    for step in 1..=3000 {
        world.step();
        arrived.fetch_add(1, Ordering::AcqRel);
        while arrived.load(Ordering::Acquire) < threads * step {
            std::hint::spin_loop();
        }
    }
    world.tally().updates as f64 / start.elapsed().as_secs_f64()
}

fn empty_motorway(length_m: f64, threads: usize) -> Result<World, Box<dyn Error>> {
    let road = Motorway { lanes: LANES, length_m, lanelet_length_m: 500.0, ..Motorway::default() };
    let network = motorway(&road)?.build()?.network;
    let Population { characters, shares } = Population::usual(1)?;
    let demand = Demand::even(&network, DENSITY * SPEED * 3.6 * LANES as f64, TRUCKS, shares);
    Ok(World::new(network, characters, demand, Setup { step: STEP_S, seed: 1, threads })?)
}

/// Puts vehicles on the road, some closer together than others.
fn fill(world: &mut World) {
    let random = Random::new(1);
    let places: Vec<(ChainIndex, f64)> = free_places(world.network(), &random);
    for ((chain, x), number) in places.into_iter().zip(0..) {
        let draw = |purpose| random.uniform(number, purpose, 0);
        let character = (draw(Purpose::Character) * 512.0) as u32;
        let is_aggressive = draw(Purpose::Style) < 1.0 / 8.4;
        world.place(NewVehicle {
            chain,
            x,
            speed: SPEED,
            class: if draw(Purpose::Class) < TRUCKS { Class::Truck } else { Class::Car },
            character: if is_aggressive { character } else { 512 + character },
            destination: Some(0),
        });
    }
}

fn free_places(network: &Network, random: &Random) -> Vec<(ChainIndex, f64)> {
    let mut places = Vec::new();
    for (chain, index) in network.chains.iter().zip(0..) {
        let mut x = 40.0;
        while x < chain.length {
            places.push((ChainIndex(index), x));
            let share = 0.7 + 0.6 * random.uniform(places.len() as u32, Purpose::Arrival, 0);
            x += 1000.0 / DENSITY * share;
        }
    }
    places
}

#[expect(clippy::print_stdout, reason = "this is what it is for")]
fn say(line: &str) {
    println!("{line}");
}
