//! Bad calls of the library are errors that say what to do. No call panics.

use std::collections::BTreeMap;

use laneweave::{
    Class, Columns, Control, Fault, Id, Lateral, LightState, Longitudinal, NewVehicle, Parameter, Side,
    Simulation, VehicleId,
};
use laneweave_scenario::scenario::Demand;
use laneweave_test_data::map;

fn simulation(name: &str, vehicles_per_hour: f64) -> Simulation {
    let builder = Simulation::builder(map(name)).vehicles_per_hour(vehicles_per_hour).threads(1);
    builder.build().expect("the map is sound")
}

/// Pseudo-random numbers, the same ones every time.
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, end: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % end
    }

    fn one<T: Clone>(&mut self, all: &[T]) -> T {
        all[self.below(all.len())].clone()
    }

    /// Often a number that makes sense, and often one that does not.
    fn real(&mut self) -> f64 {
        const ODD: [f64; 9] = [
            f64::NAN,
            f64::INFINITY,
            f64::NEG_INFINITY,
            f64::MAX,
            f64::MIN_POSITIVE,
            -0.0,
            -1.0,
            1e9,
            8.000_001,
        ];
        if self.below(2) == 0 { self.one(&ODD) } else { self.below(4000) as f64 * 0.05 }
    }

    fn control(&mut self) -> Control {
        let number = self.real();
        let longitudinal = self.one(&[
            Longitudinal::Driver,
            Longitudinal::Acceleration(number),
            Longitudinal::Acceleration(number % 8.0),
            Longitudinal::Speed(number),
        ]);
        let lateral = self.one(&[
            Lateral::Driver,
            Lateral::Keep,
            Lateral::Change(Side::Left),
            Lateral::Change(Side::Right),
        ]);
        Control::Drive { longitudinal, lateral }
    }
}

/// What a call may name: some exist, some do not.
struct Names {
    lanelets: Vec<Id>,
    lights: Vec<Id>,
    vehicles: Vec<VehicleId>,
}

impl Names {
    fn of(simulation: &Simulation) -> Names {
        let lanelets = simulation.network().lanelets.iter().map(|it| it.id);
        let lights = simulation.lights().into_iter().map(|it| it.id);
        Names {
            lanelets: lanelets
                .chain([0, -1, i64::MIN, i64::MAX].map(Id::from))
                .chain(["", "edge_0"].map(Id::from))
                .collect(),
            lights: lights.chain([0, -1, i64::MAX].map(Id::from)).collect(),
            vehicles: vec![0, VehicleId::MAX],
        }
    }
}

/// A random command, and whether it was refused.
fn command(
    simulation: &mut Simulation,
    numbers: &mut Numbers,
    names: &Names,
) -> (&'static str, Result<(), Fault>) {
    let id = numbers.one(&names.vehicles);
    let lanelet = numbers.one(&names.lanelets);
    let style = numbers.one(&["conservative", "aggressive", "nobody", ""]);
    match numbers.below(12) {
        0 => {
            let vehicle = NewVehicle {
                lanelet,
                position_m: numbers.real(),
                speed_mps: numbers.real(),
                class: numbers.one(&Class::ALL),
                style: style.into(),
                destination: numbers.one(&[None, None, Some(lanelet)]),
            };
            ("insert", simulation.insert(vehicle).map(|_| ()))
        }
        1 => ("remove", simulation.remove(id)),
        2 => ("set_style", simulation.set_style(id, style)),
        3 => ("set_destination", simulation.set_destination(id, numbers.one(&[None, Some(lanelet)]))),
        4 => ("set_demand", simulation.set_demand(lanelet, numbers.real())),
        5 => {
            let shows = numbers.one(&[None, Some(LightState::Red), Some(LightState::Green)]);
            ("set_light", simulation.set_light(numbers.one(&names.lights), shows))
        }
        6 => {
            let (parameter, value) = (numbers.one(Parameter::ALL), numbers.real());
            ("set_parameter", simulation.set_parameter(style, parameter, value))
        }
        7 => ("close_lanelet", simulation.close_lanelet(lanelet, numbers.below(2) == 0)),
        8 => ("set_share", simulation.set_share(style, numbers.real())),
        9 => {
            let anything = numbers.real();
            let offset_s = numbers.one(&[0.0, 40.0, anything]);
            ("set_offset", simulation.set_offset(numbers.one(&names.lights), offset_s))
        }
        10 => ("vehicles_on", simulation.vehicles_on(lanelet).map(|_| ())),
        _ => ("control", simulation.control(id, numbers.control())),
    }
}

/// Whether a remedy says what to do.
fn says_what_to_do(remedy: &str) -> bool {
    const BEGINNINGS: [&str; 8] =
        ["choose ", "known are ", "ask ", "simulate ", "give ", "leave ", "make ", "did you mean "];
    BEGINNINGS.iter().any(|it| remedy.starts_with(it))
}

#[test]
fn a_hundred_thousand_random_calls_break_nothing_and_each_refusal_says_what_to_do() {
    let mut numbers = Numbers(1);
    let (mut accepted, mut refused): (BTreeMap<&str, usize>, BTreeMap<&str, usize>) = Default::default();
    for (name, demand) in [("ramps.osm", 2500.0), ("grid.osm", 2000.0)] {
        let mut simulation = simulation(name, demand);
        let mut names = Names::of(&simulation);
        let mut columns = Columns::with_poses();
        // Commands may empty the road for a while.
        let mut steps_with_vehicles = 0;
        for call in 0..50_000 {
            let (kind, result) = command(&mut simulation, &mut numbers, &names);
            match result {
                Ok(()) => *accepted.entry(kind).or_default() += 1,
                Err(fault) => {
                    *refused.entry(kind).or_default() += 1;
                    assert!(says_what_to_do(&fault.remedy) && !fault.what.is_empty(), "{fault}");
                }
            }
            if call % 25 == 0 {
                simulation.step();
                let id = numbers.one(&names.vehicles);
                let is_there = simulation.vehicle(id).is_some();
                assert_eq!(simulation.intention(id).is_some(), is_there);
                assert_eq!(simulation.explain(id).is_some(), is_there);
                simulation.columns(&mut columns);
                steps_with_vehicles += u32::from(!columns.is_empty());
                // Dead vehicles stay among the names for a while.
                if call % 1000 == 0 {
                    names.vehicles =
                        [0, VehicleId::MAX].into_iter().chain(columns.id.iter().copied()).collect();
                }
            }
        }
        assert!(steps_with_vehicles > 1000, "{name}: {steps_with_vehicles} of 2000 steps");
    }
    let kinds = [
        "close_lanelet",
        "control",
        "insert",
        "remove",
        "set_demand",
        "set_destination",
        "set_light",
        "set_offset",
        "set_parameter",
        "set_share",
        "set_style",
        "vehicles_on",
    ];
    let few = |counts: &BTreeMap<&str, usize>| {
        kinds.into_iter().find(|it| counts.get(it).copied().unwrap_or(0) < 20)
    };
    assert_eq!((few(&accepted), few(&refused)), (None, None), "{accepted:?} {refused:?}");
}

#[test]
fn a_wrong_set_up_is_refused_with_a_remedy() {
    let builder = || Simulation::builder(map("on_ramp.osm"));
    let demand = |trucks: f64| Demand { trucks, ..Demand::default() };
    let refused = [
        (Simulation::from_file(map("nowhere.osm")), "nowhere.osm"),
        (Simulation::from_file(map("on_ramp.toml")), "on_ramp.toml: cannot be read"),
        (Simulation::from_map(map("on_ramp.osm"), demand(f64::NAN)), "demand.trucks"),
        (builder().threads(0).build(), "run.threads: 0 threads; choose 1 or more"),
        (builder().threads(1000).build(), "run.threads: 1000 threads"),
        (builder().step_s(f64::NAN).build(), "run.step_s"),
        (builder().duration_s(f64::INFINITY).build(), "run.duration_s"),
        (builder().warmup_s(-1.0).build(), "run.warmup_s"),
        (builder().vehicles_per_hour(f64::NAN).build(), "demand.vehicles_per_hour"),
        (builder().style("conservativ", 1.0).build(), "did you mean \"conservative\"?"),
        (builder().style("conservative", f64::NAN).build(), "give it a finite weight"),
        (builder().style("conservative", 0.0).build(), "give at least one of them a weight above 0"),
    ];
    for (result, part) in refused {
        let fault = result.err().expect(part);
        assert!(fault.to_string().contains(part) && !fault.remedy.is_empty(), "{fault}");
    }
}

#[test]
fn a_simulation_does_not_run_backwards_or_for_ever() {
    let mut simulation = simulation("on_ramp.osm", 1000.0);
    simulation.run(30.0).expect("it can");
    simulation.run(30.0).expect("nothing is left to do");
    for until_s in [29.0, -1.0, f64::NAN, f64::INFINITY, 1e300] {
        let fault = simulation.run(until_s).expect_err("that is no time to come");
        assert_eq!(fault.remedy, "choose a time from 30 to 10000000 s");
    }
    assert!((simulation.time_s() - 30.0).abs() < 1e-9);
}

#[test]
fn only_a_simulation_as_it_began_leaves_results() {
    let out = std::env::temp_dir().join(format!("laneweave-bad-calls-{}", std::process::id()));
    let mut stepped = simulation("on_ramp.osm", 1000.0);
    stepped.step();
    let mut changed = simulation("on_ramp.osm", 1000.0);
    let state = changed.save().expect("it can be saved");
    changed.restore(&state).expect("it is its own");
    for simulation in [stepped, changed] {
        let fault = simulation.run_to_results(&out).expect_err("it is refused");
        assert_eq!(fault.remedy, "make a new one, and run that");
    }
    assert!(!out.exists());
}

#[test]
fn a_state_of_something_else_is_refused_and_changes_nothing() {
    let mut town = simulation("grid.osm", 1000.0);
    town.run(60.0).expect("it can");
    let mut ramp = simulation("on_ramp.osm", 1000.0);
    ramp.run(60.0).expect("it can");
    let before = ramp.state_hash();
    let saved = town.save().expect("it can be saved");
    for bytes in [&saved[..], &saved[..100], &[]] {
        let fault = ramp.restore(bytes).expect_err("it is no state of this simulation");
        assert_eq!(fault.remedy, "give the bytes that a simulation of the same scenario saved");
    }
    assert_eq!(ramp.state_hash(), before);
}
