//! In a town, too, a recorded driver knows what the simulated one knew.

use laneweave_recordings::clean;
use laneweave_scenario::scenario::{Origin, Scenario, prepare};

use crate::simulated::drive::{STEP, Spans, drive_in};
use crate::simulated::outcomes;

const IN_TOWN: Spans =
    Spans { warm_up: 120.0, recorded: 1440.0, afterwards: 30.0, kept: [10.0, 1200.0], every: 5.0 };

#[test]
fn in_a_town_a_recorded_driver_knows_what_the_simulated_one_knew() {
    let map = laneweave_test_data::map("town.osm");
    let mut scenario = Scenario::of_map(map);
    scenario.run.step_s = STEP;
    scenario.demand.vehicles_per_hour = Some(3000.0);
    // Guided drivers change their routes: a recording shows only where they went.
    scenario.guidance.interval_s = 0.0;
    let world = prepare(&scenario, &Origin::default()).expect("it is sound").world;
    let driver_parameters = world.driver_parameters().to_vec();
    let (truth, recording) = drive_in(world, driver_parameters, &IN_TOWN, 1);
    let (recording, _) = clean(recording);
    let outcomes = outcomes(&truth, &recording);
    let samples: usize = outcomes.values().sum();
    let share = |outcome: &str| outcomes.get(outcome).copied().unwrap_or(0) as f64 / samples as f64;
    assert!(samples >= 300, "{outcomes:?}");
    // Lights and rights of way are in no recording.
    assert!(share("agree") > 0.75 && share("agree") + share("beyond junctions") > 0.9, "{outcomes:?}");
    assert!(
        share("slows for what lies ahead") + share("new limit") < 0.07 && share("edge") < 0.01,
        "{outcomes:?}"
    );
}
