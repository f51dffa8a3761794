//! Vehicles of SUMO: no bytes make the reader panic or take long, and what it reads drives on a net.

#![no_main]

use laneweave::Simulation;
use laneweave::scenario::{Origin, Scenario};
use libfuzzer_sys::fuzz_target;

mod file;

/// The net on which they drive.
const NET: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/seeds/sumo_net/light.net.xml");

fuzz_target!(|bytes: &[u8]| {
    let mut scenario = Scenario::of_map(NET.into());
    scenario.demand.vehicles_per_hour = Some(0.0);
    scenario.styles.clear();
    scenario.run.duration_s = 60.0;
    scenario.sumo.routes = vec![file::holding(bytes)];
    match Simulation::from_scenario(&scenario, &Origin::default()) {
        Ok(mut simulation) => {
            simulation.steps(50);
        }
        Err(fault) => assert!(!fault.place.is_empty() && !fault.what.is_empty()),
    }
});
