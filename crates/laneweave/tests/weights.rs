//! Each weight of a style moves what it should while drivers drive: the rate of lane changes of one kind, between no
//! weight and ten times the weight, over ten simulated minutes with about 1,000 vehicles and five paired seeds.

use laneweave::{Event, Kind, Parameter, Simulation, in_parallel};

const SEEDS: u64 = 5;
const MEASURED_S: f64 = 600.0;
/// About 1,000 vehicles in ten minutes.
const VEHICLES_PER_HOUR: f64 = 6000.0;

/// Lane changes of a run by kind, and its vehicles.
#[derive(Clone, Copy, Debug, Default)]
struct Counted {
    discretionary: usize,
    route: usize,
    keeping: usize,
    missed: usize,
    vehicles: usize,
}

/// Ten minutes of a motorway with ramps, after the user has multiplied a weight of all styles.
fn run(parameter: Parameter, factor: f64, seed: u64) -> Counted {
    let map = concat!(env!("CARGO_MANIFEST_DIR"), "/../../maps/ramps.osm");
    let mut simulation = Simulation::builder(map)
        .vehicles_per_hour(VEHICLES_PER_HOUR)
        .duration_s(MEASURED_S)
        .seed(seed)
        .threads(1)
        .build()
        .expect("a simulation");
    let drivers = simulation.world().driver_parameters().to_vec();
    for style in ["aggressive", "conservative"] {
        let mut typical = drivers.iter().find(|it| it.name == style).expect("a driver").clone();
        let weight = *parameter.place(&mut typical).expect("a weight");
        simulation.set_parameter(style, parameter, factor * weight).expect("a weight");
    }
    let mut counted = Counted::default();
    while simulation.time_s() < MEASURED_S {
        for event in simulation.step() {
            match event {
                Event::LaneChange(it) if it.is_completed => match it.kind {
                    Kind::Discretionary => counted.discretionary += 1,
                    Kind::Route => counted.route += 1,
                    Kind::Keeping => counted.keeping += 1,
                },
                Event::MissedTurn(_) => counted.missed += 1,
                Event::Entered(_) => counted.vehicles += 1,
                _ => {}
            }
        }
    }
    counted
}

#[test]
fn probe() {
    for parameter in [
        Parameter::SpeedWeight,
        Parameter::RouteWeight,
        Parameter::ComfortWeight,
        Parameter::CourtesyWeight,
        Parameter::UrgencyWeight,
        Parameter::KeepingWeight,
    ] {
        for factor in [0.0, 10.0] {
            let tasks: Vec<u64> = (1..=SEEDS).collect();
            for seed in tasks {
                println!("{parameter:?} {factor} {:?}", run(parameter, factor, seed));
            }
        }
    }
}
