//! The default demand: each entrance gets a share of what it bears.

use laneweave::Capacity;
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
        let Capacity { veh_h, queues_from_veh_h, .. } = *usual.conditions.capacity;
        let total = usual.conditions.demand_veh_h;
        // At each entrance it is rounded to a whole number.
        let rounded = usual.conditions.origins.len() as f64;
        assert!(usual.conditions.origins.iter().all(|it| it.1.fract() == 0.0 && it.1 >= 1.0), "{seed}");
        assert!(total <= 0.8 * queues_from_veh_h + rounded, "{seed}: {total} of {queues_from_veh_h}");
        assert!(total <= 0.63 * veh_h + rounded, "{seed}: {total} of {veh_h}");
        assert!(total >= (0.8 * queues_from_veh_h).min(0.63 * veh_h) - rounded, "{seed}: {total} of {veh_h}");
        // The same demand for each lane fills the first part sooner.
        let even = prepared(seed, Some(1000.0)).conditions.capacity.queues_from_veh_h;
        assert!(queues_from_veh_h > 0.9 * even, "{seed}: {queues_from_veh_h} of {even}");
        grown += usize::from(queues_from_veh_h > 1.1 * even);
    }
    assert!(grown >= 3, "{grown} of 12");
}

#[test]
fn what_entrances_bear_does_not_depend_on_how_numbers_are_rounded() {
    // On 195 and 201 two parts are equally full, and different entrances pass them.
    for seed in [195, 201, 501] {
        let of = |factor: f64| {
            let mut scenario = Scenario::of_map("random.osm".into());
            scenario.demand.profile = vec![[0.0, factor]];
            let map = random(seed).drawing.build().expect("the drawing is sound");
            prepare_on(map, &scenario, &Origin::default())
                .expect("the scenario is sound")
                .conditions
                .demand_veh_h
        };
        for factor in [1.3, 1.7, 0.9] {
            assert!((of(factor) - factor * of(1.0)).abs() < 1e-6, "{seed}: {} at {factor}", of(factor));
        }
    }
}

#[test]
fn more_get_through_than_where_queues_begin_but_where_all_pass_one_part() {
    let mut more = 0;
    for seed in 501..513 {
        let Capacity { veh_h, queues_from_veh_h, .. } = *prepared(seed, Some(1000.0)).conditions.capacity;
        assert!(veh_h >= queues_from_veh_h, "{seed}: {veh_h} {queues_from_veh_h}");
        more += usize::from(veh_h > 1.1 * queues_from_veh_h);
    }
    assert!(more >= 6, "{more} of 12");
}

#[test]
fn all_vehicles_leave_a_narrow_lane_that_ends_or_never_come_there() {
    // On these random maps a lane that ends is narrower than long vehicles all along.
    for seed in [3, 10_008] {
        let mut world = prepared(seed, Some(1500.0)).world;
        (0..12_000).for_each(|_| world.step());
        let (left, stuck) = (world.counts().left, world.counters().stuck);
        assert!(left > 300 && stuck == 0, "{seed}: {left} {stuck}");
    }
}
