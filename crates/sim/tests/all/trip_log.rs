//! Trip records agree with what happened.

use laneweave_generate::{Grid, Motorway, grid, motorway};
use laneweave_maps::{Map, regulations};
use laneweave_sim::{DrivingEvent, DrivingEventKind, Event, Setup, TripRecord, World};

use crate::roads::{Road, drivers, motorway_with_ramps};

/// Traffic whose trips are recorded.
pub(crate) fn world(map: &Map, total: f64) -> World {
    let network = map.network.clone().regulated(&regulations(map));
    let demand = drivers::demand(&network, total, 0.1, &[0.3, 0.7]);
    let driver_parameters = vec![drivers::aggressive(), drivers::conservative()];
    let setup = Setup { step: 0.1, seed: 5, threads: 1 };
    World::new(network, driver_parameters, demand, setup).expect("the set-up makes sense").with_trip_log()
}

/// The records of all trips, with the distances driven [m]. Each completed trip is checked.
fn records(world: &mut World, steps: u32) -> Vec<(TripRecord, f64)> {
    let mut records = Vec::new();
    for _ in 0..steps {
        world.step();
        let time = world.clock().time();
        for event in world.events() {
            let Event::Left { vehicle, duration, motion, trip, .. } = event else { continue };
            let trip = trip.expect("trips are recorded");
            assert_eq!(trip.vehicle, *vehicle);
            assert!((trip.entered + duration - time).abs() < 1e-9);
            assert!(trip.arrived <= trip.entered && trip.entered - trip.arrived < 500.0);
            assert!(trip.stood <= *duration && trip.origin.is_some() && trip.destination.is_some());
            assert!(trip.free_time.is_some_and(|free| free > 0.0 && free < duration + 10.0));
            assert!(world.trip(*vehicle).is_none());
            records.push((trip, trip.way(motion.x)));
        }
    }
    let on_road = world.vehicles().map(|it| world.trip(it.id()).map(|trip| (*trip, trip.way(it.x()))));
    records.extend(on_road.map(|it| it.expect("everybody on the road has a record")));
    records
}

/// Checks that the sums over all records equal the counts of the world.
fn add_up(mut world: World, steps: u32) {
    let records = records(&mut world, steps);
    let (counts, counters) = (*world.counts(), world.counters());
    let sum = |of: fn(&TripRecord) -> u32| records.iter().map(|(it, _)| u64::from(of(it))).sum::<u64>();
    assert_eq!(records.len() as u64, counts.entered);
    assert_eq!(sum(|it| it.lane_changes), counts.discretionary_changes + counts.route_changes);
    assert_eq!(sum(|it| it.route_changes), counters.route_changes);
    assert_eq!(sum(|it| it.missed_turns), counters.missed_turns);
    assert!(sum(|it| it.stops) >= counts.stops && counts.left > 100, "{counts:?}");
    assert!(sum(|it| it.lane_changes) > 50);
    // In a bend, lanes beside each other differ in length. A vehicle that stops within a step is off by a few
    // centimetres.
    let way: f64 = records.iter().map(|(_, way)| way).sum();
    assert!((way / counters.distance - 1.0).abs() < 1e-3, "{way} of {} m", counters.distance);
}

#[test]
fn on_a_motorway_the_records_add_up_to_what_the_world_counts() {
    add_up(world(&motorway_with_ramps(2), 4000.0), 6000);
}

#[test]
fn the_free_time_over_a_lane_that_ends_goes_on_where_one_changes_to() {
    // The acceleration lane ends 1,750 m before the end of the road.
    let plan = Motorway { lanes: 2, length_m: 3000.0, on_ramp_at: vec![1000.0], ..Motorway::default() };
    let mut world = world(&motorway(&plan).unwrap().build().unwrap(), 2000.0);
    let records = records(&mut world, 3000);
    let ramp = records.iter().filter(|(it, way)| it.origin == Some(1) && *way > 1900.0);
    let pace: Vec<f64> = ramp.map(|(it, way)| way / it.free_time.unwrap()).collect();
    assert!(pace.len() > 5 && pace.iter().all(|it| (15.0..45.0).contains(it)), "{pace:?}");
}

#[test]
fn in_a_town_the_records_add_up_to_what_the_world_counts() {
    let plan = Grid { rows: 3, columns: 3, ..Grid::default() };
    let mut town = world(&grid(&plan).unwrap().build().unwrap(), 4000.0);
    let stood: f64 = records(&mut town, 3000).iter().map(|(it, _)| it.stood).sum();
    assert!(stood > 1000.0, "lights hold people up: {stood} s");
    add_up(world(&grid(&plan).unwrap().build().unwrap(), 4000.0), 3000);
}

#[test]
fn without_a_trip_log_nothing_is_recorded_and_traffic_is_the_same() {
    let plain = || {
        let network = Road { lanes: 2, length: 2000.0, ..Road::default() }.network();
        let demand = drivers::demand(&network, 3000.0, 0.1, &[0.3, 0.7]);
        let driver_parameters = vec![drivers::aggressive(), drivers::conservative()];
        let setup = Setup { step: 0.1, seed: 5, threads: 1 };
        World::new(network, driver_parameters, demand, setup).expect("the set-up makes sense")
    };
    let (mut plain, mut recorded) = (plain(), plain().with_trip_log());
    for _ in 0..2000 {
        plain.step();
        recorded.step();
    }
    assert_eq!(plain.state_hash(), recorded.state_hash());
    assert!(plain.vehicles().all(|it| plain.trip(it.id()).is_none()) && plain.on_road() > 0);
    assert!(recorded.vehicles().all(|it| recorded.trip(it.id()).is_some()));
}

#[test]
fn what_happens_on_the_way_is_told_with_who_where_and_when_as_often_as_it_is_counted() {
    let town =
        grid(&Grid { rows: 3, columns: 3, ..Grid::default() }).expect("a town").build().expect("a network");
    let mut world = world(&town, 6000.0);
    let mut told: Vec<DrivingEvent> = Vec::new();
    let mut stands = std::collections::BTreeSet::new();
    for _ in 0..6000 {
        let before = world.clock().time();
        world.step();
        for event in world.events() {
            let Event::Driving(event) = event else { continue };
            assert_eq!(event.time, before);
            assert!((0.0..=world.network().chain(event.at.chain).length).contains(&event.at.x), "{event:?}");
            match event.kind {
                DrivingEventKind::Halt => assert!(stands.insert(event.vehicle), "{event:?}"),
                DrivingEventKind::SetOff { stood } => assert!(stands.remove(&event.vehicle) && stood > 0.0),
                _ => {}
            }
            told.push(*event);
        }
    }
    let count = |kind| told.iter().filter(|it| it.kind == kind).count() as u64;
    let counters = world.counters();
    assert_eq!(count(DrivingEventKind::EmergencyBraking), counters.emergency_brakings);
    assert_eq!(count(DrivingEventKind::MissedTurn), counters.missed_turns);
    assert_eq!(count(DrivingEventKind::RouteChange), counters.route_changes);
    assert!(count(DrivingEventKind::Halt) >= world.counts().stops && world.counts().stops > 500);
}
