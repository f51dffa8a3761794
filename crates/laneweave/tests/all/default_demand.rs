//! The default demand: each entrance gets a share of what it bears.

use laneweave::generate::random;
use laneweave_scenario::scenario::{Origin, Prepared, Scenario, prepare_on};

/// A random map with its default demand, or with a `demand` over all its entrances [veh/h].
fn prepared(seed: u64, demand: Option<f64>) -> Prepared {
    let mut scenario = Scenario::of_map("random.osm".into());
    scenario.demand.vehicles_per_hour = demand;
    let map = random(seed).drawing.build().expect("the drawing is sound");
    prepare_on(map, &scenario, &Origin::default()).expect("the scenario is sound")
}

#[test]
fn the_default_demand_fills_no_part_and_lets_other_entrances_grow_on() {
    let mut grown = 0;
    for seed in 501..513 {
        let usual = prepared(seed, None);
        let total = usual.demand_veh_h;
        // A demand of one vehicle an hour at least comes to each entrance.
        let spare = usual.origins.len() as f64;
        assert!(total <= 0.71 * usual.capacity.veh_h + spare, "{seed}: {total}, {}", *usual.capacity);
        assert!(usual.origins.iter().all(|it| it.1.fract() == 0.0 && it.1 >= 1.0), "{seed}");
        // The same demand for each lane fills the first part sooner.
        let even = prepared(seed, Some(1000.0)).capacity.veh_h;
        assert!(usual.capacity.veh_h > 0.9 * even, "{seed}: {} of {even}", *usual.capacity);
        grown += usize::from(usual.capacity.veh_h > 1.1 * even);
    }
    assert!(grown >= 3, "{grown} of 12");
}
