//! How fast the step is, and how its cost grows.
//!
//! `cargo run --release -p laneweave-bench` measures a motorway of 40 km and four lanes with some 2,000 vehicles at
//! steps of 0.1 s, every driver not in a change considering lanes once a second, on one core and on two; what two cores
//! of the machine can give at most; then the same density on longer roads, up to a million vehicles; then the memory
//! that a vehicle needs. What is compared runs in turns, a round each, and the best rounds count; the median tells how
//! much they were disturbed. `… -- short` runs 300 steps of the first on one core only, to count instructions under
//! callgrind.

use std::alloc::{GlobalAlloc, Layout};
use std::error::Error;
use std::sync::atomic::{AtomicU32, AtomicUsize, Ordering};
use std::time::Instant;

use laneweave::generate::{Motorway, motorway};
use laneweave::network::Network;
use laneweave::sim::{Purpose, Random};
use laneweave::{Class, Id, NewVehicle, Simulation};
use laneweave_bench::machine::{round_trip, spin_until};
use laneweave_bench::{Rates, say};

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
/// Mean speed at that density [m/s]; with it, as many vehicles enter at the start as leave at the end.
const SPEED: f64 = 26.0;
const TRUCKS: f64 = 0.1;
const STEP_S: f64 = 0.1;
/// Steps before measuring, until the lane changes are steady.
const WARM_UP: u32 = 100;

fn main() -> Result<(), Box<dyn Error>> {
    if std::env::args().nth(1).as_deref() == Some("short") {
        return Measured::motorway(40.0, 1, 300).and_then(|it| measure([it], 1).map(|_| ()));
    }
    let [one, two] = measure([Measured::motorway(40.0, 1, 500)?, Measured::motorway(40.0, 2, 500)?], 12)?;
    say(&format!("two threads are {:.2} times one", two.rates.best() / one.rates.best()));
    say(&format!(
        "two motorways of 20 km on a thread each, in step, are {:.2} times one",
        limit_of_two_threads(6)?
    ));
    let [nearest, farthest] = two.round_trips;
    say(&format!("a message from core to core and back takes {nearest:.0} to {farthest:.0} ns"));
    let [small, .., large, _] = measure(
        [
            Measured::motorway(20.0, 1, 500)?,
            Measured::motorway(200.0, 1, 50)?,
            Measured::motorway(2_000.0, 1, 5)?,
            Measured::motorway(20_000.0, 1, 3)?,
            Measured::motorway(20_000.0, 2, 3)?,
        ],
        10,
    )?;
    let growth = small.rates.best() / large.rates.best();
    say(&format!("from a thousand to a million, an update costs {growth:.2} times"));
    Ok(())
}

/// Runs all cases in turn, `rounds` times, and prints the results: a disturbance of the machine affects all of them
/// alike.
fn measure<const N: usize>(mut all: [Measured; N], rounds: usize) -> Result<[Measured; N], Box<dyn Error>> {
    for _ in 0..rounds {
        all.iter_mut().for_each(Measured::go_on);
    }
    all.iter().for_each(Measured::print);
    Ok(all)
}

/// A motorway under measurement.
struct Measured {
    simulation: Simulation,
    length_km: f64,
    threads: usize,
    /// Steps in a round.
    steps: u32,
    rates: Rates,
    /// Bytes in use for its vehicles.
    bytes: f64,
    /// The shortest and the longest round trip between two cores before one of its rounds [ns].
    round_trips: [f64; 2],
}

impl Measured {
    /// A motorway of `length_km`, measured by rounds of `steps` steps, after the lane changes are steady.
    fn motorway(length_km: f64, threads: usize, steps: u32) -> Result<Measured, Box<dyn Error>> {
        let mut simulation = empty_motorway(1000.0 * length_km, threads)?;
        let empty = in_use();
        fill(&mut simulation)?;
        (0..WARM_UP).for_each(|_| simulation.advance());
        let bytes = in_use() - empty;
        let round_trips = [f64::INFINITY, 0.0];
        Ok(Measured { simulation, length_km, threads, steps, rates: Rates::default(), bytes, round_trips })
    }

    /// One more round.
    fn go_on(&mut self) {
        if self.threads > 1 {
            let (now, [shortest, longest]) = (round_trip(), self.round_trips);
            self.round_trips = [shortest.min(now), longest.max(now)];
        }
        let (before, updates, start) = (in_use(), self.simulation.counters().updates, Instant::now());
        (0..self.steps).for_each(|_| self.simulation.advance());
        self.rates.push(self.simulation.counters().updates - updates, start.elapsed().as_secs_f64());
        self.bytes += in_use() - before;
    }

    fn print(&self) {
        let (counters, vehicles) = (self.simulation.counters(), self.simulation.on_road());
        let considered_every = counters.updates as f64 * STEP_S / counters.considerations as f64;
        let (best, median) = (self.rates.best(), self.rates.median());
        say(&format!(
            "{:6.0} km: {vehicles:7} vehicles, {} thread(s): {:5.1} million updates/s at best, {:5.1} in the median; {:5.1} ns each, {:5.1} times real time at best; considered every {considered_every:.2} s, {:4.0} B/vehicle, hash {:016x}",
            self.length_km,
            self.threads,
            best / 1e6,
            median / 1e6,
            1e9 / best,
            best * STEP_S / vehicles as f64,
            self.bytes / vehicles as f64,
            self.simulation.state_hash(),
        ));
    }
}

/// How many times faster two motorways of half the length are on two threads than on one, if the threads share
/// nothing but wait for each other after every step: the gain that the machine allows for two cores.
fn limit_of_two_threads(rounds: usize) -> Result<f64, Box<dyn Error>> {
    let half = || Measured::motorway(20.0, 1, 500);
    let (mut one, mut other, mut alone, mut together) = (half()?, half()?, 0.0_f64, 0.0_f64);
    for _ in 0..rounds {
        alone = alone.max(in_step(&mut one, &AtomicU32::new(0), 1));
        let arrived = AtomicU32::new(0);
        let both = std::thread::scope(|scope| {
            let other = scope.spawn(|| in_step(&mut other, &arrived, 2));
            in_step(&mut one, &arrived, 2) + other.join().unwrap_or_default()
        });
        together = together.max(both);
    }
    Ok(together / alone)
}

/// Updates per second in a round of one motorway; after every step it waits until as many as `threads` have
/// `arrived`.
fn in_step(it: &mut Measured, arrived: &AtomicU32, threads: u32) -> f64 {
    let (before, start) = (it.simulation.counters().updates, Instant::now());
    for step in 1..=it.steps {
        it.simulation.advance();
        arrived.fetch_add(1, Ordering::AcqRel);
        spin_until(|| arrived.load(Ordering::Acquire) >= threads * step);
    }
    (it.simulation.counters().updates - before) as f64 / start.elapsed().as_secs_f64()
}

/// A motorway on which nobody is yet. Its warm-up is that of the benchmark, so that counts begin when measuring does.
fn empty_motorway(length_m: f64, threads: usize) -> Result<Simulation, Box<dyn Error>> {
    let road = Motorway { lanes: LANES, length_m, lanelet_length_m: 500.0, ..Motorway::default() };
    let simulation = Simulation::builder(motorway(&road)?.build()?)
        .vehicles_per_hour(DENSITY * SPEED * 3.6 * LANES as f64)
        .scenario(|it| (it.demand.trucks, it.guidance.interval_s) = (TRUCKS, 0.0))
        .step_s(STEP_S)
        .warmup_s(f64::from(WARM_UP) * STEP_S)
        .threads(threads);
    Ok(simulation.build()?)
}

/// Puts vehicles on the road, some closer together than others.
fn fill(simulation: &mut Simulation) -> Result<(), Box<dyn Error>> {
    let random = Random::new(1);
    for ((lanelet, position_m), number) in free_places(simulation.network(), &random).into_iter().zip(0..) {
        let draw = |purpose| random.uniform(number, purpose, 0);
        let is_aggressive = draw(Purpose::Style) < 1.0 / 8.4;
        simulation.insert(NewVehicle {
            lanelet,
            position_m,
            speed_mps: SPEED,
            class: if draw(Purpose::Class) < TRUCKS { Class::Truck } else { Class::Car },
            style: if is_aggressive { "aggressive" } else { "conservative" }.into(),
            destination: None,
        })?;
    }
    Ok(())
}

/// Places by lanelet and position along it [m].
fn free_places(network: &Network, random: &Random) -> Vec<(Id, f64)> {
    let mut places = Vec::new();
    for chain in &network.chains {
        let mut x = 40.0;
        while x < chain.length {
            let (lanelet, along) = chain.lanelet(x);
            places.push((network.lanelets[lanelet.at()].id, along));
            let share = 0.7 + 0.6 * random.uniform(places.len() as u32, Purpose::Arrival, 0);
            x += 1000.0 / DENSITY * share;
        }
    }
    places
}
