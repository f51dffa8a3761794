//! External vehicles that are driven by poses: in lanes, between lanes, against the traffic and off the road.

use std::f64::consts::PI;

use laneweave_network::{ChainIndex, Pose};
use laneweave_sim::{Command, CommandError, Control, Lateral, Longitudinal, VehicleId, World};

use crate::external::lanes::{alone, drive, insert};
use crate::external::worlds::world;

/// Gives a pose [m, rad, m/s].
pub(crate) fn put(world: &mut World, id: VehicleId, [x, y, heading, speed]: [f64; 4]) {
    let control = Control::Pose { x, y, heading, speed };
    world.command(Command::Control(id, control)).expect("it is possible");
}

fn pose(world: &World, id: VehicleId) -> Pose {
    world.vehicle(id).expect("it is on the road").pose()
}

fn chain(world: &World, id: VehicleId) -> Option<ChainIndex> {
    world.vehicle(id).filter(|it| it.is_in_lane()).map(|it| it.spot.chain)
}

#[test]
fn it_is_at_its_pose_at_the_end_of_the_next_step_and_stays_there() {
    let (mut world, id) = alone();
    let before = pose(&world, id);
    let lane = chain(&world, id);
    put(&mut world, id, [before.at.x + 2.0, before.at.y + 0.5, before.heading + 0.05, 20.0]);
    world.step();
    let vehicle = world.vehicle(id).expect("it is on the road");
    let now = vehicle.pose();
    assert_eq!(
        (now.at.x, now.at.y, now.heading),
        (before.at.x + 2.0, before.at.y + 0.5, before.heading + 0.05)
    );
    assert_eq!(chain(&world, id), lane);
    assert!((vehicle.speed() - 20.0).abs() < 1e-12, "it has moved faster: {}", vehicle.speed());
    assert!((vehicle.x() - 152.0).abs() < 0.1, "its front is {} m along its lane", vehicle.x());
    assert!((vehicle.lateral_offset() - 0.6).abs() < 0.02, "{}", vehicle.lateral_offset());
    world.step();
    assert_eq!((pose(&world, id), world.vehicle(id).expect("it is there").speed()), (now, 0.0));
}

#[test]
fn a_vehicle_that_drives_through_the_map_by_poses_has_a_trip_like_any_other() {
    let mut world = world("motorway_3_lanes.osm", 0.0, 1, 1).with_trip_log();
    let id = insert(&mut world, 1, 150.0, 25.0);
    let mut at = pose(&world, id);
    for _ in 0..300 {
        at.at.x += 2.5;
        put(&mut world, id, [at.at.x, at.at.y, at.heading, 25.0]);
        world.step();
    }
    let vehicle = world.vehicle(id).expect("it is on the road");
    let way = world.trip(id).expect("it is recorded").way(vehicle.x());
    assert!((way - 750.0).abs() < 1e-6, "{way}");
    assert!((world.counters().distance - 750.0).abs() < 1e-6);
    let driven: f64 = world.lanelet_aggregates().iter().map(|it| it.way).sum();
    assert!((driven - 750.0).abs() < 1e-6, "{driven}");
    // Its driver drives on from there.
    world.command(Command::Control(id, Control::DRIVER)).expect("it is in a lane");
    world.step();
    let vehicle = world.vehicle(id).expect("it is on the road");
    assert!((vehicle.x() - 902.5).abs() < 0.1 && (vehicle.speed() - 25.0).abs() < 1.0);
}

#[test]
fn off_the_road_it_is_on_no_lane_but_counts_and_comes_back() {
    let (mut world, id) = alone();
    let before = pose(&world, id);
    let [x, y] = [before.at.x, before.at.y];
    put(&mut world, id, [x, y - 40.0, 1.0, 5.0]);
    world.step();
    assert_eq!((chain(&world, id), world.on_road(), world.vehicles().count()), (None, 1, 1));
    assert_eq!(pose(&world, id).at.y, y - 40.0);
    assert_eq!(world.intention(id), None);
    let refused = world.command(Command::Control(id, Control::DRIVER));
    assert_eq!(refused, Err(CommandError::Astray(id)));
    world.command(Command::SetStyle(id, "aggressive".into())).expect("it has a driver");
    let bytes = world.save().expect("it can be saved");
    let (mut other, _) = alone();
    other.restore(&bytes).expect("it fits");
    for world in [&mut world, &mut other] {
        put(world, id, [x, y, 0.0, 5.0]);
        world.step();
        world.command(Command::Control(id, Control::DRIVER)).expect("it is in a lane");
        (0..100).for_each(|_| world.step());
        let vehicle = world.vehicle(id).expect("it is on the road");
        assert!(vehicle.x() > 200.0 && vehicle.speed() > 20.0 && vehicle.style().name == "aggressive");
    }
    assert_eq!(world.state_hash(), other.state_hash());
}

#[test]
fn a_vehicle_off_the_road_can_be_removed() {
    let (mut world, id) = alone();
    put(&mut world, id, [-500.0, 700.0, 0.0, 0.0]);
    world.step();
    world.command(Command::Remove(id)).expect("it exists");
    world.step();
    assert_eq!((world.on_road(), world.counts().removed, world.externals().count()), (0, 1, 0));
}

#[test]
fn in_a_lane_change_it_takes_its_pose_and_the_change_is_over() {
    let (mut world, id) = alone();
    drive(&mut world, id, Longitudinal::Driver, Lateral::Change(laneweave_network::Side::Left));
    while !world.vehicle(id).expect("it is there").driver.phase.is_between_lanes() {
        world.step();
    }
    (0..10).for_each(|_| world.step());
    let at = pose(&world, id);
    put(&mut world, id, [at.at.x + 2.0, at.at.y, at.heading, 20.0]);
    world.step();
    let entries = |world: &World| {
        let chains = (0..world.network().chains.len() as u32).map(ChainIndex);
        chains.map(|it| world.scene().motions(it).len()).sum::<usize>()
    };
    assert!(!world.vehicle(id).expect("it is there").driver.phase.is_between_lanes());
    assert!((1..=2).contains(&entries(&world)));
    world.command(Command::Remove(id)).expect("it exists");
    world.step();
    assert_eq!(entries(&world), 0);
}

/// Simulates a motorway of three lanes in which a car stands at this lateral distance from the middle lane, 600 m down
/// the road, turned by an angle. Returns the mean number of vehicles per lane that pass it in five minutes.
fn pass(aside: f64, turned: f64) -> Vec<usize> {
    let mut world = world("motorway_3_lanes.osm", 1500.0, 3, 1).audited();
    let id = insert(&mut world, 1, 150.0, 0.0);
    let mut at = pose(&world, id);
    at.at.x += 450.0;
    let mut passed: Vec<(f64, VehicleId)> = Vec::new();
    for _ in 0..3000 {
        put(&mut world, id, [at.at.x, at.at.y + aside, at.heading + turned, 0.0]);
        world.step();
        for vehicle in world.vehicles().filter(|it| it.id() != id && it.motion.rear() > 605.0) {
            if !passed.iter().any(|it| it.1 == vehicle.id()) {
                passed.push((vehicle.pose().at.y - at.at.y, vehicle.id()));
            }
        }
    }
    let counts = world.counters();
    assert_eq!((counts.collisions, counts.overlaps, counts.stuck), (0, 0, 0), "{aside} m, {turned} rad");
    let lane = |y: f64| (y / 3.75).round() as i64;
    (-1..=1).map(|number| passed.iter().filter(|it| lane(it.0) == number).count()).collect()
}

#[test]
fn drivers_pass_a_car_that_stands_in_their_way_and_nobody_strikes_it() {
    for (aside, turned, closed) in [(0.0, 0.0, vec![1]), (1.875, 0.0, vec![1, 2]), (0.0, 0.3, vec![1])] {
        let passed = pass(aside, turned);
        for (lane, count) in passed.iter().enumerate() {
            // Whoever has passed it changes back behind it.
            assert!(closed.contains(&lane) || *count > 20, "{aside} m, {turned} rad: {passed:?}");
        }
        assert!(passed.iter().sum::<usize>() > 40, "{aside} m, {turned} rad: {passed:?}");
    }
}

#[test]
fn drivers_stop_for_a_car_that_comes_towards_them() {
    let mut world = world("motorway_3_lanes.osm", 1200.0, 2, 1).audited();
    let id = insert(&mut world, 1, 150.0, 0.0);
    let mut at = pose(&world, id);
    at.at.x += 1350.0;
    // It drives for 100 s with 10 m/s, and then stands.
    for step in 0..2000 {
        let x = at.at.x - f64::from(step.min(1000));
        put(&mut world, id, [x, at.at.y, at.heading + PI, 10.0]);
        world.step();
        for event in world.events() {
            if let laneweave_sim::Event::Incident(it) = event {
                let other = usize::from(it.vehicles[0] == id);
                assert!(it.vehicles.contains(&id) && it.speeds[other] < 0.1, "{it:?}");
            }
        }
    }
}

#[test]
fn a_run_with_poses_has_the_same_bits_on_any_number_of_threads_and_after_a_checkpoint() {
    let run = |threads: usize, saves: bool| {
        let mut world = world("town.osm", 900.0, 4, threads);
        for step in 0..1500_u32 {
            if step == 300 {
                let ids: Vec<VehicleId> = world.vehicles().map(|it| it.id()).take(5).collect();
                for id in ids {
                    let at = pose(&world, id);
                    put(&mut world, id, [at.at.x, at.at.y, at.heading + 0.4, 0.0]);
                }
            }
            if saves && step == 700 {
                let bytes = world.save().expect("it can be saved");
                world = crate::external::worlds::world("town.osm", 900.0, 4, threads);
                world.restore(&bytes).expect("it fits");
            }
            world.step();
        }
        (world.state_hash(), world.externals().count())
    };
    let one = run(1, false);
    assert_eq!(one.1, 5);
    assert_eq!([run(2, false), run(4, false), run(1, true)], [one; 3]);
}
