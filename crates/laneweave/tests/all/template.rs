//! Many simulations of one template.

use laneweave::{Class, Control, FaultKind, Lateral, Longitudinal, NewVehicle, Simulation, Template};
use laneweave_test_data::map;

fn template(name: &str, seed: u64) -> Template {
    let builder = Simulation::builder(map(name)).vehicles_per_hour(3000.0).seed(seed).threads(1);
    builder.template().expect("the map is sound")
}

fn hash(simulation: &mut Simulation) -> u64 {
    simulation.run(90.0).expect("a time to come");
    simulation.state_hash()
}

const fn is_shared_among_threads<T: Send + Sync>() {}
const _: () = is_shared_among_threads::<Template>();
const _: () = is_shared_among_threads::<Simulation>();

#[test]
fn a_spawned_simulation_drives_as_one_of_its_scenario_and_so_it_does_after_a_reset() {
    for name in ["ramps.osm", "grid.osm"] {
        let template = template(name, 4);
        let mut again = template.spawn(9).expect("one thread");
        hash(&mut again);
        for seed in [4, 2] {
            let mut spawned = template.spawn(seed).expect("one thread");
            let (scenario, origin) = (spawned.scenario().clone(), spawned.origin().clone());
            assert_eq!((scenario.run.seed, scenario.run.drivers_seed), (seed, Some(4)));
            let of_scenario = hash(&mut Simulation::from_scenario(&scenario, &origin).expect("it is sound"));
            assert_eq!(hash(&mut spawned), of_scenario, "{name}: spawned with seed {seed}");
            again.reset(seed).expect("a seed");
            assert_eq!(again.scenario(), &scenario);
            assert_eq!(hash(&mut again), of_scenario, "{name}: reset to seed {seed}");
        }
        // With the seed of the template it is the simulation of which the template was made.
        let alone = Simulation::builder(map(name)).vehicles_per_hour(3000.0).seed(4).threads(1);
        let alone = hash(&mut alone.build().expect("the map is sound"));
        assert_eq!(hash(&mut template.spawn(4).expect("one thread")), alone, "{name}");
    }
}

#[test]
fn a_simulation_that_was_saved_goes_on_in_another_one_of_its_template() {
    let template = template("ramps.osm", 1);
    let mut one = template.spawn(7).expect("one thread");
    let vehicle = NewVehicle {
        lanelet: one.lanelets()[0],
        position_m: 30.0,
        speed_mps: 20.0,
        class: Class::Car,
        style: "conservative".into(),
        destination: None,
    };
    let ego = one.insert(vehicle).expect("there is room");
    let control = Control::Drive { longitudinal: Longitudinal::Speed(12.0), lateral: Lateral::Driver };
    one.control(ego, control).expect("it is there");
    one.run(20.0).expect("a time to come");
    let saved = one.save().expect("there is memory");
    let mut other = template.spawn(7).expect("one thread");
    other.restore(&saved).expect("both are of one template");
    assert_eq!(hash(&mut other), hash(&mut one));
    other.reset(7).expect("a seed");
    assert_eq!(hash(&mut other), hash(&mut template.spawn(7).expect("one thread")));
}

#[test]
fn a_simulation_that_has_begun_is_no_template() {
    let simulation = || template("on_ramp.osm", 1).spawn(1).expect("one thread");
    assert!(simulation().into_template().is_ok());
    let mut driven = simulation();
    driven.step();
    let mut changed = simulation();
    let (origin, _) = changed.origins()[0];
    changed.set_demand(origin, 10.0).expect("an entrance");
    for it in [driven, changed] {
        let fault = it.into_template().err().expect("it has begun");
        assert!(fault.kind == FaultKind::State && fault.to_string().contains("has begun"), "{fault}");
    }
}
