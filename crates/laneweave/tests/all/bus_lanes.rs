//! A street with bus lanes, which cars leave and come back to between its junctions.

use laneweave::generate::{Arterial, arterial};
use laneweave::network::{Class, Classes};
use laneweave_maps::drawing::Drawing;
use laneweave_scenario::scenario::{Line, Origin, Scenario, Stop, prepare_on};
use laneweave_sim::World;

/// The world of a scenario on a drawn map.
fn world(drawing: &Drawing, change: impl FnOnce(&mut Scenario)) -> World {
    let mut scenario = Scenario::of_map("street.osm".into());
    change(&mut scenario);
    let map = drawing.build().expect("it is a map");
    prepare_on(map, &scenario, &Origin::default()).expect("the scenario is sound").world
}

/// # Panics
/// If a vehicle is in a lane that its class may not use.
fn check_lanes(world: &World) {
    for vehicle in world.vehicles() {
        let (class, chain) = (vehicle.driver.class, world.network().chain(vehicle.spot.chain));
        assert!(chain.classes.has(class), "a {} in lanelet {:?}", class.body().name, chain.lanelets);
    }
}

#[test]
fn buses_of_a_line_arrive_and_cars_are_never_in_their_lane() {
    let street = Arterial { junctions: 4, bus_lanes: true, ..Arterial::default() };
    let drawing = arterial(&street).expect("it can be made");
    // Stops in the lanes to the east, one between two junctions each.
    let stop = |lanelet: i64| Stop { lanelet: lanelet.into(), position_m: 40.0, rest_s: 20.0 };
    let line = Line {
        name: None,
        class: Class::Bus,
        from: "1".into(),
        to: "117".into(),
        first_s: 0.0,
        every_s: 120.0,
        until_s: Some(600.0),
        stops: [10, 34, 58, 82, 106].map(stop).to_vec(),
    };
    let mut world = world(&drawing, |it| {
        it.demand.line = vec![line];
        it.demand.taxis = 0.05;
    });
    for _ in 0..12_000 {
        world.step();
        check_lanes(&world);
    }
    let count = world.lines()[0];
    assert_eq!((count.departed, count.served, count.missed), (6, 30, 0));
    let counters = world.counters();
    assert_eq!([counters.collisions, counters.overlaps, counters.stuck], [0; 3]);
}

/// Lanes to the west and to the east become bus lanes 30 m behind each junction: who leaves a junction in the slow lane
/// has to change at once.
#[test]
fn nobody_lets_others_in_where_it_keeps_a_junction_full() {
    let mut drawing = arterial(&Arterial { junctions: 4, ..Arterial::default() }).expect("it can be made");
    let start_and_end = |it: &laneweave_maps::drawing::Lane| {
        let points = &drawing.borders[it.right.border as usize].points;
        let ends = [points[0], points[points.len() - 1]].map(|it| drawing.points[it as usize]);
        if it.right.reversed { [ends[1], ends[0]] } else { ends }
    };
    let is_bus_lane = |it: &laneweave_maps::drawing::Lane| {
        let [start, end] = start_and_end(it);
        let along = |x: f64| if start.y < 0.0 { x } else { -x };
        let behind = along(start.x).rem_euclid(300.0);
        let is_main_street = start.y == end.y && start.y.abs() > 6.0;
        is_main_street && behind > 35.0 && along(end.x).rem_euclid(300.0) < 240.0
    };
    let bus_lanes: Vec<bool> = drawing.lanes.iter().map(is_bus_lane).collect();
    assert!(bus_lanes.iter().filter(|it| **it).count() > 30);
    for (lane, is_one) in drawing.lanes.iter_mut().zip(bus_lanes) {
        lane.classes = if is_one { Classes::BUS_LANE } else { Classes::ALL };
    }
    for seed in 1..4 {
        let mut world = world(&drawing, |it| {
            it.demand.vehicles_per_hour = Some(2300.0);
            it.demand.trucks = 0.05;
            it.run.seed = seed;
        });
        for _ in 0..18_000 {
            world.step();
        }
        check_lanes(&world);
        let counters = world.counters();
        assert_eq!([counters.collisions, counters.overlaps, counters.stuck], [0; 3], "seed {seed}");
        // They creep to the end of their lane and stop there gently.
        assert!(counters.emergency_brakings < 20, "{}", counters.emergency_brakings);
    }
}
