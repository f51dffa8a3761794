//! How much it costs to take 10,000 vehicles as columns, compared with their step.
//!
//! `cargo run --release -p laneweave-bench --bin columns` prints times. `… -- STEPS CALLS KIND` simulates so many
//! steps, and takes the columns so many times after each, of one kind: 0 basic, 1 with poses, 2 complete. The
//! difference of two runs under callgrind counts instructions.

use std::error::Error;
use std::time::Instant;

use laneweave::generate::{Motorway, motorway};
use laneweave::{Class, Columns, Id, NewVehicle, Simulation};
use laneweave_bench::say;

const LANES: usize = 4;
const VEHICLES: usize = 10_000;
/// Distance between two vehicles of a lane [m].
const SPACING: usize = 100;
const SPEED: f64 = 26.0;
/// Steps and calls after each of them, if none are given.
const USUAL: [usize; 2] = [300, 1];
/// The name of a kind of columns, and how empty ones are made.
type Kind = (&'static str, fn() -> Columns);

const KINDS: [Kind; 3] =
    [("basic", Columns::default), ("with poses", Columns::with_poses), ("complete", Columns::complete)];

fn main() -> Result<(), Box<dyn Error>> {
    let numbers: Result<Vec<usize>, _> = std::env::args().skip(1).map(|it| it.parse()).collect();
    let mut simulation = filled()?;
    match numbers?[..] {
        [steps, calls, kind] => {
            let (_, columns) = KINDS.get(kind).ok_or("KIND is 0, 1 or 2")?;
            measure(&mut simulation, [steps, calls], columns());
        }
        _ => {
            for (name, columns) in KINDS {
                let [step, taken] = measure(&mut simulation, USUAL, columns());
                say(&format!(
                    "{name:10}: {} vehicles; a step takes {step:.1} ns for each, columns {taken:.2} ns: {:.2} %",
                    simulation.on_road(),
                    100.0 * taken / step
                ));
            }
        }
    }
    Ok(())
}

/// The times of a step, and of taking the columns once, for each vehicle [ns].
fn measure(simulation: &mut Simulation, [steps, calls]: [usize; 2], mut columns: Columns) -> [f64; 2] {
    let mut times = [0.0; 2];
    for _ in 0..steps {
        let start = Instant::now();
        simulation.advance();
        times[0] += start.elapsed().as_secs_f64();
        let start = Instant::now();
        (0..calls).for_each(|_| simulation.columns(&mut columns));
        times[1] += start.elapsed().as_secs_f64();
    }
    let updates = (steps * simulation.on_road()) as f64;
    [times[0], times[1] / calls.max(1) as f64].map(|it| 1e9 * it / updates)
}

/// A motorway with all vehicles at equal distances on each lane, and nobody who arrives.
fn filled() -> Result<Simulation, Box<dyn Error>> {
    let length_m = (VEHICLES / LANES * SPACING) as f64 + 2000.0;
    let lanelet_length_m = 2.0 * SPACING as f64;
    let map =
        motorway(&Motorway { lanes: LANES, length_m, lanelet_length_m, ..Motorway::default() })?.build()?;
    let mut simulation = Simulation::builder(map).vehicles_per_hour(0.0).threads(1).build()?;
    let lanelets: Vec<Id> = simulation.network().lanelets.iter().map(|it| it.id).collect();
    let places = lanelets.iter().flat_map(|it| [(*it, 0.3), (*it, 0.8)]);
    for (number, (lanelet, share)) in places.take(VEHICLES).enumerate() {
        let vehicle = NewVehicle {
            lanelet,
            position_m: share * lanelet_length_m,
            speed_mps: SPEED,
            class: if number % 10 == 0 { Class::Truck } else { Class::Car },
            style: if number % 8 == 0 { "aggressive" } else { "conservative" }.into(),
            destination: None,
        };
        simulation.insert(vehicle)?;
    }
    // The first events of all vehicles, and the first lane changes.
    simulation.run(10.0)?;
    Ok(simulation)
}
