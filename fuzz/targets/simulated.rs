//! A small simulation.

use std::sync::LazyLock;

use laneweave::Simulation;
use laneweave::scenario::{Origin, Scenario};

/// Traffic on a map with lights, after a minute.
static SAVED: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let mut simulation = at_its_start();
    simulation.steps(600);
    simulation.save().expect("there is memory")
});

/// Traffic of a minute.
///
/// # Panics
/// If the map of the repository is not sound.
pub fn traffic() -> Simulation {
    let mut simulation = at_its_start();
    simulation.restore(&SAVED).expect("it is of the same scenario");
    simulation
}

fn at_its_start() -> Simulation {
    let mut scenario = Scenario::of_map(concat!(env!("CARGO_MANIFEST_DIR"), "/../maps/grid.osm").into());
    scenario.demand.vehicles_per_hour = Some(1200.0);
    scenario.run.step_s = 0.1;
    Simulation::from_scenario(&scenario, &Origin::default()).expect("the map is sound")
}
