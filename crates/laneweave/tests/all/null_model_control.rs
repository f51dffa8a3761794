//! Drivers against null-model controls: the signs that distinguish them on a two-lane motorway with 10 % trucks at
//! 800–1,400 veh/h/lane (catalogue V50) under the law of the USA, over 20 seeds with 95 % intervals. Drivers who
//! change lanes without a reason, the control, must fail them.

use std::collections::HashMap;

use laneweave::generate::{Motorway, motorway};
use laneweave::maps::Law;
use laneweave::models::change::{ConstantHazard, LaneChangeModel, Mobil};
use laneweave::study::{Estimate, Interval, mean};
use laneweave::style::Population;
use laneweave_sim::{Demand, Event, LaneChangeKind, Setup, VehicleId, World};

const SEEDS: u64 = 20;
const LANES: usize = 2;
const LENGTH_M: f64 = 5000.0;
const STEP_S: f64 = 0.1;
const WARM_UP_S: f64 = 240.0;
const MEASURED_S: f64 = 900.0;
const VEHICLES_PER_HOUR_AND_LANE: [f64; 3] = [800.0, 1100.0, 1400.0];
/// A discretionary change back within this time undoes the one before [s].
const BACK_WITHIN_S: f64 = 30.0;

/// The results of one replication.
#[derive(Default)]
struct Signs {
    changes: f64,
    vehicle_km: f64,
    gaining: f64,
    back: f64,
    hazard_held_up: f64,
    hazard_free: f64,
    /// Changes and vehicle-kilometres of aggressive and of conservative drivers.
    styles: [(f64, f64); 2],
}

impl Signs {
    fn rate(&self) -> f64 {
        self.changes / self.vehicle_km
    }

    fn hazard_ratio(&self) -> f64 {
        self.hazard_held_up / self.hazard_free
    }

    fn style_rate(&self, style: usize) -> f64 {
        self.styles[style].0 / self.styles[style].1
    }
}

/// The usual drivers, or the same ones with another lane-change model.
fn population(change: Option<LaneChangeModel>) -> Population {
    let mut population = Population::usual(1).expect("built-in styles");
    if let Some(change) = change {
        population.driver_parameters.iter_mut().for_each(|it| it.change = change.clone());
    }
    population
}

/// The control: the usual drivers, who change lanes without a reason.
fn control() -> Population {
    population(Some(LaneChangeModel::ConstantHazard(ConstantHazard::default())))
}

fn replicate(population: &Population, vehicles_per_hour: f64, seed: u64) -> Signs {
    let road = Motorway { lanes: LANES, length_m: LENGTH_M, ..Motorway::default() };
    let mut network = motorway(&road).expect("a road").build().expect("a network").network;
    network.law = Law::UnitedStates.rules();
    let Population { driver_parameters, shares } = population.clone();
    let conservative_from = shares[1].first;
    let demand = Demand::even(&network, vehicles_per_hour, 0.1, shares);
    let setup = Setup { step: STEP_S, seed, threads: 1 };
    let mut world = World::new(network, driver_parameters, demand, setup).expect("a world");
    for _ in 0..(WARM_UP_S / STEP_S) as u32 {
        world.step();
    }
    world.reset_counts();
    let mut signs = Signs::default();
    let mut last: HashMap<VehicleId, (f64, _)> = HashMap::new();
    let style_of = |parameters: u32| usize::from(parameters >= conservative_from);
    for step in 0..(MEASURED_S / STEP_S) as u32 {
        world.step();
        for event in world.events() {
            let Event::LaneChange(change) = event else { continue };
            if !change.is_completed || change.kind != LaneChangeKind::Discretionary {
                continue;
            }
            signs.changes += 1.0;
            signs.gaining += f64::from(u8::from(change.speed_gain > 0.0));
            signs.styles[style_of(change.parameters)].0 += 1.0;
            if let Some((time, side)) = last.insert(change.vehicle, (change.time, change.side)) {
                let is_back = side != change.side && change.time - time <= BACK_WITHIN_S;
                signs.back += f64::from(u8::from(is_back));
            }
        }
        if step % 10 == 0 {
            for vehicle in world.vehicles() {
                signs.styles[style_of(vehicle.driver.parameters)].1 += vehicle.speed() / 1000.0;
            }
        }
    }
    let counters = world.counters();
    assert_eq!((counters.collisions, world.counters().overlaps, counters.stuck), (0, 0, 0));
    signs.vehicle_km = counters.distance / 1000.0;
    signs.hazard_held_up = counters.held_up_desires as f64 / counters.held_up_considerations as f64;
    signs.hazard_free = counters.free_desires as f64 / counters.free_considerations as f64;
    signs
}

fn over_seeds(signs: &[Signs], of: impl Fn(&Signs) -> f64) -> Estimate {
    mean(&signs.iter().map(of).collect::<Vec<_>>()).expect("replications")
}

/// The replications at one flow, with their results printed on screen.
fn replications(name: &str, population: &Population, flow: f64) -> Vec<Signs> {
    let signs: Vec<Signs> =
        (1..=SEEDS).map(|seed| replicate(population, flow * LANES as f64, seed)).collect();
    let show = |of: fn(&Signs) -> f64| {
        let estimate = over_seeds(&signs, of);
        format!("{:.3} ±{:.3}", estimate.mean, estimate.half_width)
    };
    eprintln!(
        "{name} at {flow} veh/h/lane: {} changes/veh-km (aggressive {}, conservative {}), hazard ratio {}, gaining {}, back {}",
        show(Signs::rate),
        show(|it| it.style_rate(0)),
        show(|it| it.style_rate(1)),
        show(Signs::hazard_ratio),
        show(|it| it.gaining / it.changes),
        show(|it| it.back / it.changes),
    );
    signs
}

#[test]
fn v50_drivers_change_lanes_for_reasons() {
    let (usual, mobil) = (population(None), population(Some(LaneChangeModel::Mobil(Mobil::default()))));
    for flow in VEHICLES_PER_HOUR_AND_LANE {
        let signs = replications("drivers", &usual, flow);
        let Interval { lower: low, upper: high } = over_seeds(&signs, Signs::rate).interval();
        assert!(low >= 0.1 && high <= 0.6, "rate {low}…{high}");
        let low = over_seeds(&signs, Signs::hazard_ratio).interval().lower;
        assert!(low >= 3.0, "held up beside a free lane, {low} times as likely");
        let low = over_seeds(&signs, |it| it.gaining / it.changes).interval().lower;
        assert!(low >= 0.7, "gaining {low}");
        // Drivers of MOBIL on the same traffic set the measure.
        let back = |signs: &[Signs]| over_seeds(signs, |it| it.back / it.changes).mean;
        let (back, of_mobil) = (back(&signs), back(&replications("MOBIL", &mobil, flow)));
        assert!(back <= of_mobil + 0.03, "back {back}, MOBIL {of_mobil}");
        let aggressive = over_seeds(&signs, |it| it.style_rate(0)).interval().lower;
        let conservative = over_seeds(&signs, |it| it.style_rate(1)).interval().upper;
        assert!(aggressive > conservative, "aggressive {aggressive} conservative {conservative}");
    }
}

#[test]
fn v50_a_changer_without_a_reason_shows_none_of_it() {
    let population = control();
    for flow in VEHICLES_PER_HOUR_AND_LANE {
        let signs = replications("control", &population, flow);
        let high = over_seeds(&signs, Signs::hazard_ratio).interval().upper;
        assert!(high < 3.0, "the control is held up for a reason: {high}");
        let high = over_seeds(&signs, |it| it.gaining / it.changes).interval().upper;
        assert!(high < 0.7, "the control gains: {high}");
        let aggressive = over_seeds(&signs, |it| it.style_rate(0)).interval().lower;
        let conservative = over_seeds(&signs, |it| it.style_rate(1)).interval().upper;
        assert!(aggressive <= conservative, "the control's styles differ: {aggressive} {conservative}");
    }
}
