//! Many simulations of one template.

use laneweave::{Class, Control, Lateral, Longitudinal, NewVehicle, Simulation, Template};
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
fn what_a_simulation_that_has_begun_spawns_goes_on_from_there_with_random_numbers_of_its_own() {
    for name in ["ramps.osm", "town.osm"] {
        let mut begun = template(name, 1).spawn(5).expect("one thread");
        let (origin, _) = begun.origins()[0];
        begun.run(40.0).expect("a time to come");
        begun.set_demand(origin, 900.0).expect("an entrance");
        let saved = begun.save().expect("there is memory");
        let template = begun.into_template();
        let mut gone_on = template.spawn(5).expect("one thread");
        assert_eq!(gone_on.save().expect("there is memory"), saved, "{name}: it is where the other was");
        let mut same = template.spawn(5).expect("one thread");
        assert_eq!(hash(&mut gone_on), hash(&mut same), "{name}");
        let mut restored = self::template(name, 1).spawn(5).expect("one thread");
        restored.restore(&saved).expect("both are of one template");
        assert_eq!(hash(&mut restored), hash(&mut gone_on), "{name}: the other would have gone on so");
        let mut other = template.spawn(6).expect("one thread");
        assert_ne!(hash(&mut other), hash(&mut same), "{name}: other random numbers");
        gone_on.reset(6).expect("a seed");
        assert_eq!((gone_on.time_s(), gone_on.is_as_it_began()), (40.0, false));
        assert_eq!(hash(&mut gone_on), hash(&mut other), "{name}: reset");
    }
}
