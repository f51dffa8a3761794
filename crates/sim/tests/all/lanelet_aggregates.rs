//! Lanelet aggregates agree with what happened there, observed step by step.

use std::collections::HashMap;

use laneweave_generate::{Grid, grid};
use laneweave_sim::{Event, LaneletAggregate, VehicleId, World};

use crate::roads::motorway_with_ramps;
use crate::trip_log::world;

/// Step of that world [s].
const STEP: f64 = 0.1;

/// The lanelet of each vehicle, and its speed.
fn places(world: &World) -> HashMap<VehicleId, (usize, f64)> {
    let network = world.network();
    let place = |it: laneweave_sim::Vehicle| {
        let (lanelet, _) = network.chain(it.spot.chain).lanelet(it.x());
        (it.id(), (lanelet.at(), it.speed()))
    };
    world.vehicles().map(place).collect()
}

/// Drives for some steps, and compares the aggregates with the observations.
fn compare(mut world: World, [before, steps]: [u32; 2]) {
    (0..before).for_each(|_| world.step());
    world.reset_counts();
    let nothing = vec![LaneletAggregate::default(); world.network().lanelets.len()];
    assert_eq!(world.lanelet_aggregates(), nothing);
    let mut seen = nothing;
    // Vehicles that enter or leave a lanelet within a step are on it for a part of the step.
    let mut passing = vec![0; seen.len()];
    let mut last = places(&world);
    for _ in 0..steps {
        world.step();
        let now = places(&world);
        for (id, (lanelet, speed)) in &now {
            seen[*lanelet].time += STEP;
            seen[*lanelet].way += speed * STEP;
            if let Some((was, _)) = last.get(id)
                && was != lanelet
            {
                passing[*was] += 1;
                passing[*lanelet] += 1;
            }
        }
        for event in world.events() {
            if let Event::Left { vehicle, .. } = event
                && let Some((was, _)) = last.get(vehicle)
            {
                passing[*was] += 1;
            }
        }
        last = now;
    }
    let stays = world.lanelet_aggregates();
    assert_eq!(stays, world.lanelet_aggregates(), "asking changes nothing");
    let total = |of: fn(&LaneletAggregate) -> f64, all: &[LaneletAggregate]| all.iter().map(of).sum::<f64>();
    assert!(total(|it| f64::from(it.passed), &stays) > 500.0);
    for (of, tolerance) in [((|it| it.time) as fn(&LaneletAggregate) -> f64, 2e-3), (|it| it.way, 2e-3)] {
        let [noted, expected] = [total(of, &stays), total(of, &seen)];
        assert!((noted / expected - 1.0).abs() < tolerance, "{noted} of {expected}");
    }
    for (lanelet, (noted, seen)) in stays.iter().zip(&seen).enumerate() {
        // Speed is taken as constant within a second: for a vehicle that brakes hard the error is some tenths of a
        // second.
        let room = 0.2 * f64::from(passing[lanelet]) + 1e-6;
        assert!(
            (noted.time - seen.time).abs() <= room,
            "{lanelet}: {noted:?}, {seen:?}, {}",
            passing[lanelet]
        );
        assert!(noted.standing <= noted.time + 1e-9);
        assert!(noted.passed <= passing[lanelet]);
    }
}

#[test]
fn on_a_motorway_with_ramps_times_and_ways_are_those_seen_step_by_step() {
    compare(world(&motorway_with_ramps(3), 4000.0), [600, 1505]);
}

#[test]
fn in_a_town_times_and_ways_are_those_seen_step_by_step() {
    compare(world(&grid(&Grid::default()).unwrap().build().unwrap(), 2000.0), [1000, 3003]);
}
