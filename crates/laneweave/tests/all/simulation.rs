//! The simulation in the words of the road tells what the world behind it holds.

use std::collections::BTreeMap;

use laneweave::generate::{Motorway, motorway};
use laneweave::{
    Class, Columns, Control, Event, Fault, Id, Light, LightState, NewVehicle, Phase, Side, Simulation,
    VehicleState,
};
use laneweave_scenario::scenario::{Demand, Origin, Scenario, prepare};

fn builder(map: &str, vehicles_per_hour: f64) -> laneweave::Builder {
    let map = laneweave_test_data::map(map);
    Simulation::builder(map).vehicles_per_hour(vehicles_per_hour).threads(1)
}

/// Traffic with lane changes under way.
fn traffic(map: &str, vehicles_per_hour: f64) -> Simulation {
    let mut simulation = builder(map, vehicles_per_hour).build().expect("the map is sound");
    simulation.run(120.0).expect("it can");
    simulation
}

#[test]
fn a_simulation_drives_like_the_world_of_its_scenario_and_counts_from_the_end_of_the_warm_up() {
    let mut simulation = builder("ramps.osm", 3000.0).seed(5).warmup_s(60.0).build().expect("it is sound");
    let mut scenario: Scenario = simulation.scenario().clone();
    scenario.run.threads = None;
    let mut world = prepare(&scenario, &Origin::default()).expect("it is sound").world;
    (0..600).for_each(|_| world.step());
    assert_eq!(world.counts().entered, world.on_road() as u64, "counts begin anew");
    (0..600).for_each(|_| world.step());
    simulation.run(120.0).expect("it can");
    assert_eq!(simulation.state_hash(), world.state_hash());
    assert_eq!(simulation.counts(), world.counts());
    assert_eq!(simulation.end_s(), 660.0);
}

#[test]
fn a_vehicle_is_found_by_its_id_however_many_were_asked_for_since_the_last_step() {
    let mut simulation = traffic("ramps.osm", 4000.0);
    for _ in 0..2 {
        let all: Vec<_> = simulation.views().map(|it| (it.id(), it.spot)).collect();
        assert!(all.len() > 50);
        for (id, spot) in all {
            assert_eq!(simulation.view(id).map(|it| it.spot), Some(spot));
            assert!(simulation.view(laneweave::VehicleId::MAX).is_none());
        }
        simulation.advance();
    }
}

#[test]
fn vehicles_are_the_same_one_by_one_by_lanelet_and_in_columns() {
    let mut between_lanes = 0;
    for (map, demand) in [("ramps.osm", 4000.0), ("town.osm", 4000.0), ("grid.osm", 2000.0)] {
        let mut simulation = traffic(map, demand);
        let ids = simulation.lanelets();
        let (mut columns, mut basic) = (Columns::with_poses(), Columns::default());
        for _ in 0..50 {
            simulation.step();
            let vehicles = simulation.vehicles();
            assert!(vehicles.len() > 50 && vehicles.is_sorted_by_key(|it| it.id));
            simulation.columns(&mut columns);
            simulation.columns(&mut basic);
            assert_eq!((columns.len(), basic.len(), basic.x_m.len()), (vehicles.len(), vehicles.len(), 0));
            assert_eq!((&columns.id, &columns.position_m), (&basic.id, &basic.position_m));
            let by_id: BTreeMap<u32, &VehicleState> = vehicles.iter().map(|it| (it.id, it)).collect();
            for row in 0..columns.len() {
                let it = by_id[&columns.id[row]];
                let lanelet = ids[columns.lanelet[row] as usize];
                assert_eq!((lanelet, columns.position_m[row]), (it.lanelet, it.position_m));
                assert_eq!(columns.speed_mps[row], it.speed_mps);
                assert_eq!(f64::from(columns.acceleration_mps2[row]), it.acceleration_mps2);
                let pose = [columns.x_m[row], columns.y_m[row], columns.heading_rad[row]];
                // Columns find the middle of a vehicle by one walk along its lane, and so in another order of sums.
                let same = [it.x_m, it.y_m, it.heading_rad].into_iter().zip(pose);
                assert!(same.into_iter().all(|(a, b)| (a - b).abs() < 1e-9), "{pose:?} {it:?}");
            }
            between_lanes += vehicles.iter().filter(|it| it.state == Phase::Changes).count();
        }
        let vehicles = simulation.vehicles();
        let on_lanelets = simulation.network().lanelets.iter().map(|it| simulation.vehicles_on(it.id));
        let mut found: Vec<VehicleState> = on_lanelets.flat_map(|it| it.expect("it is there")).collect();
        found.sort_by_key(|it| it.id);
        assert!(found == vehicles, "{map}");
        assert!(vehicles.iter().all(|it| simulation.vehicle(it.id).as_ref() == Some(it)));
    }
    assert!(between_lanes > 100, "{between_lanes}");
}

#[test]
fn columns_keep_their_memory_from_call_to_call() {
    let (crowded, mut quiet) = (traffic("ramps.osm", 4000.0), traffic("ramps.osm", 1500.0));
    let mut columns = Columns::with_poses();
    crowded.columns(&mut columns);
    let places = |it: &Columns| (it.id.as_ptr(), it.speed_mps.as_ptr(), it.x_m.as_ptr());
    let (before, count) = (places(&columns), columns.len());
    for _ in 0..50 {
        quiet.step();
        quiet.columns(&mut columns);
        assert_eq!((places(&columns), columns.len()), (before, quiet.vehicles().len()));
    }
    assert!(columns.len() < count);
}

#[test]
fn events_and_states_are_plain_data_with_the_names_of_the_tables() {
    let mut simulation = traffic("grid.osm", 3000.0);
    let mut events = Vec::new();
    while simulation.time_s() < 300.0 {
        events.extend(simulation.step());
    }
    let json = serde_json::to_value(&events).expect("it is plain");
    let read: Vec<Event> = serde_json::from_value(json.clone()).expect("it is the same");
    assert!(read == events);
    let names: std::collections::BTreeSet<&str> =
        json.as_array().expect("a list").iter().filter_map(|it| it["event"].as_str()).collect();
    for name in ["entered", "completed", "lane_change", "halt", "set_off"] {
        assert!(names.contains(name), "{names:?}");
    }
    let change = json.as_array().and_then(|it| it.iter().find(|it| it["event"] == "lane_change"));
    let change = change.expect("there is one");
    assert!(change["side"] == "left" || change["side"] == "right");
    assert!(change["kind"] == "discretionary" || change["kind"] == "route");
    let vehicles = simulation.vehicles();
    let json = serde_json::to_value(&vehicles).expect("it is plain");
    let read: Vec<VehicleState> = serde_json::from_value(json).expect("it is the same");
    assert!(read == vehicles);
    let first = serde_json::to_value(&vehicles[0]).expect("it is plain");
    assert!(["car", "truck"].contains(&first["class"].as_str().expect("a name")), "{first}");
    let lights = simulation.lights();
    assert!(lights.len() == 72 && lights.iter().any(|it| it.state == LightState::Green));
    let text = serde_json::to_string(&lights[0]).expect("it is plain");
    assert_eq!(serde_json::from_str::<Light>(&text).expect("it is the same"), lights[0]);
    assert!(serde_json::from_str::<Light>(r#"{"id":1,"state":"blue"}"#).is_err());
}

#[test]
fn lane_changes_lead_from_lanelet_to_the_lanelet_beside() {
    let mut simulation = traffic("motorway_3_lanes.osm", 4500.0);
    let mut changes = 0;
    while simulation.time_s() < 300.0 {
        for event in simulation.step() {
            let Event::LaneChange(it) = event else { continue };
            let network = simulation.network();
            let y = |id: Id| {
                let index = network.lanelet_with(id).expect("it is on the map");
                network.lanelets[index.at()].centre.at(0.0).y
            };
            // The motorway leads to the east.
            assert_eq!(y(it.to_lanelet) > y(it.from_lanelet), it.side == Side::Left);
            assert!(it.started_s <= it.time_s && it.speed_mps > 0.0);
            changes += 1;
        }
    }
    assert!(changes > 50, "{changes}");
}

/// The error of an observer.
#[derive(Debug, PartialEq)]
enum Enough {
    Here,
    Of(String),
}

impl From<Fault> for Enough {
    fn from(fault: Fault) -> Enough {
        Enough::Of(fault.what)
    }
}

#[test]
fn an_observer_sees_every_step_and_ends_the_run_when_it_fails() {
    let mut simulation = traffic("on_ramp.osm", 1500.0);
    let (mut steps, mut seen) = (0, 0);
    let mut count = |_: &Simulation, events: &[Event]| {
        steps += 1;
        seen += events.len();
        Ok(())
    };
    let mut stop = |it: &Simulation, _: &[Event]| {
        if it.time_s() < 130.0 { Ok(()) } else { Err(Enough::Here) }
    };
    let ended = simulation.observe(200.0, &mut [&mut count, &mut stop]);
    assert!(ended == Err(Enough::Here), "an observer may have an error of its own");
    assert!(steps == 100 && seen > 0, "{steps} {seen}");
}

#[test]
fn a_generated_map_is_driven_without_a_file() {
    let map = motorway(&Motorway::default()).expect("it fits").build().expect("it has lanes");
    let demand = Demand { vehicles_per_hour: Some(2000.0), ..Demand::default() };
    let mut simulation = Simulation::from_map(map, demand).expect("it is sound");
    simulation.run(60.0).expect("it can");
    assert!(simulation.vehicles().len() > 10);
    let id = simulation.vehicles()[0].id;
    assert!(simulation.explain(id).expect("it is on the road").contains(&format!("vehicle {id} (")));
    let refused = simulation.run_to_results("nowhere").expect_err("it has no file");
    assert!(refused.to_string().contains("the map is no file"), "{refused}");
}

#[test]
fn a_vehicle_driven_by_poses_is_told_in_the_words_of_the_road_and_in_columns() {
    let mut simulation = builder("motorway_2_lanes.osm", 0.0).build().expect("it is a map");
    let new = NewVehicle {
        lanelet: 5.into(),
        position_m: 50.0,
        speed_mps: 25.0,
        class: Class::Car,
        style: "conservative".into(),
        destination: None,
    };
    let id = simulation.insert(new).expect("the place is free");
    let at = simulation.vehicle(id).expect("it is on the road");
    let put = |simulation: &mut Simulation, y: f64| {
        let (x, heading) = (at.x_m + 1.0, at.heading_rad);
        simulation.control(id, Control::Pose { x, y, heading, speed: 5.0 }).expect("it is a pose");
        simulation.step();
    };
    put(&mut simulation, at.y_m + 0.5);
    let now = simulation.vehicle(id).expect("it is on the road");
    assert_eq!((now.x_m, now.y_m, now.speed_mps), (at.x_m + 1.0, at.y_m + 0.5, 5.0));
    assert!((now.offset_m - 0.5).abs() < 1e-9 && (now.position_m - 51.0).abs() < 1e-9, "{now:?}");
    put(&mut simulation, at.y_m - 60.0);
    let mut columns = Columns::with_poses();
    simulation.columns(&mut columns);
    assert_eq!((columns.len(), columns.y_m[0], simulation.vehicles().len()), (1, at.y_m - 60.0, 1));
    assert_eq!((simulation.explain(id), simulation.intention(id)), (None, None));
    let error = simulation.control(id, Control::DRIVER).expect_err("it is off the road");
    assert!(error.to_string().contains("pose in a lane"), "{error}");
    let bad = Control::Pose { x: f64::NAN, y: 0.0, heading: 0.0, speed: 0.0 };
    assert!(simulation.control(id, bad).is_err());
}
