//! How many drivers of the built-in styles enter a roundabout.

use laneweave::generate::{Roundabout, roundabout};
use laneweave_scenario::scenario::{OdRow, Origin, Scenario, prepare, prepare_on};
use laneweave_sim::{Event, World};
use laneweave_test_data::{map, size};

/// Vehicles per hour that leave at the exits with these ids, after ten minutes.
fn leaving(scenario: &Scenario, exits: [i64; 2]) -> [f64; 2] {
    let minutes = size().pick(40, 120);
    let mut world = prepare(scenario, &Origin::default()).expect("the map is sound").world;
    (0..6000).for_each(|_| world.step());
    let mut left = [0.0; 2];
    for _ in 0..600 * minutes {
        world.step();
        for event in world.events() {
            let Event::Left { chain, .. } = event else { continue };
            let network = world.network();
            let gate = network.exits.iter().find(|it| it.chains.contains(chain));
            let exit = gate.and_then(|gate| exits.iter().position(|it| gate.id == *it));
            exit.into_iter().for_each(|it| left[it] += 60.0 / f64::from(minutes));
        }
    }
    let counters = world.counters();
    assert_eq!((counters.collisions, counters.overlaps, counters.stuck), (0, 0, 0));
    left
}

#[test]
fn as_many_enter_a_roundabout_as_two_editions_of_the_highway_capacity_manual_say() {
    // HCM 2010 and HCM 6, both from memory [pc/h].
    let least = |circulating: f64| 0.9 * 1130.0 * (-0.001 * circulating).exp();
    let most = |circulating: f64| 1.1 * 1380.0 * (-0.00102 * circulating).exp();
    for circulating in [200.0, 600.0, 1000.0] {
        // Vehicles from the north and the west drive past the southern arm, and leave in the east.
        let pair = |from: &str, to: &str, flow| OdRow {
            from: from.to_owned(),
            to: to.to_owned(),
            vehicles_per_hour: flow,
        };
        let mut scenario = Scenario::of_map(map("roundabout.osm"));
        scenario.demand.trucks = 0.0;
        scenario.demand.od = vec![
            pair("16", "7", circulating / 2.0),
            pair("24", "7", circulating / 2.0),
            pair("32", "15", 1900.0),
        ];
        let [passed, entered] = leaving(&scenario, [7, 15]);
        assert!((least(passed)..=most(passed)).contains(&entered), "{entered} beside {passed}");
    }
}

/// A roundabout of two lanes with this demand [veh/h].
fn two_lanes(arms: usize, radius_m: Option<f64>, [demand, trucks]: [f64; 2], seed: u64) -> World {
    let wanted = Roundabout { arms, lanes: 2, radius_m, ..Roundabout::default() };
    let map = roundabout(&wanted).expect("arms fit around it").build().expect("the drawing is sound");
    let mut scenario = Scenario::of_map("roundabout.osm".into());
    scenario.demand.vehicles_per_hour = Some(demand);
    (scenario.demand.trucks, scenario.run.seed) = (trucks, seed);
    prepare_on(map, &scenario, &Origin::default()).expect("the scenario is sound").world
}

#[test]
fn a_roundabout_with_too_much_traffic_is_never_locked() {
    // Trucks who wait to turn back at the next arms had the right of way over all who were on the way out.
    for seed in 1..=size().pick(2, 8) {
        let mut world = two_lanes(5, None, [3200.0, 0.2], seed);
        (0..12_000).for_each(|_| world.step());
        let before = world.counts().left;
        (0..6000).for_each(|_| world.step());
        let left = world.counts().left - before;
        assert!(left > 150, "{seed}: {left} in ten minutes");
        assert_eq!((world.counters().collisions, world.counters().overlaps), (0, 0));
    }
}

#[test]
fn a_lane_change_ends_although_the_vehicle_stands() {
    // In the first of these runs a vehicle was across but for some micrometres, and waited to be across.
    for (arms, radius_m, seed) in [(3, 31.0, 16), (3, 31.6, 1), (4, 30.0, 1), (5, 28.0, 1)] {
        let mut world = two_lanes(arms, Some(radius_m), [1942.0, 0.09], seed);
        (0..9000).for_each(|_| world.step());
        let left = world.counts().left;
        assert!(left > 350, "{arms} arms, {seed}: {left} in a quarter of an hour");
        assert_eq!(world.counters().stuck, 0);
    }
}
