//! Recorded vehicles: put where they are, moved, taken off the road, and made drivers.

use std::f64::consts::PI;

use laneweave_sim::{Class, CommandError, RecordedPose, RecordedVehicle, VehicleId, World};

use crate::external::worlds::world;

/// A van on the middle lane of the motorway with three lanes, 200 m from its beginning.
fn van(speed: f64) -> RecordedVehicle {
    let pose = RecordedPose { x: 200.0, y: 5.0, heading: 0.0, speed };
    RecordedVehicle { class: Class::Car, length: 6.2, width: 2.1, pose }
}

fn put(world: &mut World, vehicle: &RecordedVehicle) -> VehicleId {
    world.put_recorded(vehicle).expect("its numbers are in their ranges")
}

fn motorway() -> World {
    world("motorway_3_lanes.osm", 0.0, 1, 1).with_trip_log()
}

/// A pose so much further along the road [m].
fn further(from: &RecordedVehicle, by: f64) -> RecordedPose {
    RecordedPose { x: from.pose.x + by, ..from.pose }
}

#[test]
fn it_is_at_once_where_it_was_recorded_with_its_own_size_and_speed() {
    let mut world = motorway();
    let id = put(&mut world, &van(20.0));
    let vehicle = world.vehicle(id).expect("it is there");
    assert!(vehicle.is_in_lane() && vehicle.driver.is_external && vehicle.is_on_its_own_path());
    assert_eq!((vehicle.pose().at.x, vehicle.pose().at.y, vehicle.pose().heading), (200.0, 5.0, 0.0));
    assert_eq!((vehicle.size(), vehicle.speed()), ([6.2, 2.1], 20.0));
    assert!((vehicle.x() - 203.1).abs() < 0.1, "its front is at {} m", vehicle.x());
    // Its place is known to a decimetre only: others see the speed that was recorded.
    world.move_recorded(id, further(&van(20.0), 1.9));
    world.step();
    let vehicle = world.vehicle(id).expect("it is there");
    assert_eq!((vehicle.pose().at.x, vehicle.speed(), vehicle.motion.speed), (201.9, 20.0, 20.0));
}

#[test]
fn off_the_road_it_is_there_and_in_no_lane() {
    let mut world = motorway();
    let pose = RecordedPose { x: 200.0, y: -80.0, heading: 1.0, speed: 0.0 };
    let id = put(&mut world, &RecordedVehicle { pose, ..van(0.0) });
    assert!(!world.vehicle(id).expect("it is there").is_in_lane());
    assert!(!world.release_recorded(id, None, 0), "no driver can drive there");
    world.step();
    world.move_recorded(id, van(20.0).pose);
    world.step();
    assert!(world.vehicle(id).expect("it is there").is_in_lane());
    world.remove_recorded(id);
    assert!(world.vehicle(id).is_none());
}

#[test]
fn a_vehicle_that_comes_the_wrong_way_or_with_impossible_numbers() {
    let mut world = motorway();
    let pose = RecordedPose { heading: PI, ..van(20.0).pose };
    let id = put(&mut world, &RecordedVehicle { pose, ..van(20.0) });
    assert!(!world.vehicle(id).expect("it is there").is_in_lane(), "it drives along no lane");
    let nowhere = RecordedPose { x: f64::NAN, ..pose };
    let refused = world.put_recorded(&RecordedVehicle { pose: nowhere, ..van(20.0) });
    assert!(matches!(refused, Err(CommandError::Number { what: "a place to the east", .. })), "{refused:?}");
    let refused = world.put_recorded(&RecordedVehicle { length: 0.0, ..van(20.0) });
    assert!(matches!(refused, Err(CommandError::Number { what: "a length", .. })), "{refused:?}");
    assert!(!world.move_recorded(id, nowhere));
    world.step();
    assert_eq!(world.vehicle(id).expect("it is there").pose().at.x, 200.0);
}

#[test]
fn a_driver_goes_on_in_its_lane_at_its_speed_and_reacts() {
    let mut world = motorway();
    let (behind, ahead) = (put(&mut world, &van(25.0)), {
        let pose = further(&van(0.0), 150.0);
        put(&mut world, &RecordedVehicle { pose, ..van(0.0) })
    });
    assert!(world.release_recorded(behind, None, 0));
    let driver = world.vehicle(behind).expect("it is there");
    assert!(!driver.driver.is_external && !driver.is_on_its_own_path());
    assert_eq!((driver.speed(), driver.size()[0] as f32), (25.0, 6.2));
    assert!(!world.move_recorded(behind, van(25.0).pose), "it drives itself now");
    for _ in 0..300 {
        world.step();
    }
    let [behind, ahead] = [behind, ahead].map(|it| world.vehicle(it).expect("it is there"));
    let is_past = behind.x() > ahead.x();
    let stands = behind.speed() < 0.1 && behind.x() < ahead.motion.rear();
    assert!(is_past && behind.spot.chain != ahead.spot.chain || stands, "it has passed it, or stopped");
    let id = behind.id();
    world.remove_recorded(id);
    assert!(world.vehicle(id).is_none(), "a recording takes its drivers off the road, too");
}

#[test]
fn a_driver_who_is_found_far_behind_its_leader_closes_in_slowly() {
    let mut world = motorway();
    // Two and a half seconds behind: twice its usual headway.
    let [ahead, behind] = [66.0, 0.0].map(|it| {
        let pose = further(&van(24.0), it);
        put(&mut world, &RecordedVehicle { pose, ..van(24.0) })
    });
    assert!(world.release_recorded(behind, None, 1));
    let mut speeds = Vec::new();
    for step in 1..=600 {
        world.move_recorded(ahead, further(&van(24.0), 66.0 + 2.4 * f64::from(step)));
        world.step();
        speeds.push(world.vehicle(behind).map(|it| it.speed()).expect("it is there"));
    }
    assert!((speeds[49] - 24.0).abs() < 0.7, "after 5 s: {} m/s", speeds[49]);
    let [ahead, behind] = [ahead, behind].map(|it| world.vehicle(it).expect("it is there"));
    let gap = ahead.motion.rear() - behind.x();
    assert!(gap < 45.0, "after a minute the gap is {gap} m");
}

#[test]
fn there_is_room_where_a_vehicle_is_or_behind_who_is_in_the_way() {
    let mut world = motorway();
    let standing = put(&mut world, &van(0.0));
    assert_eq!(world.room_for(&van(0.0), 0.0), Err(standing));
    let behind = world.room_for(&van(0.0), 30.0).expect("there is room behind");
    assert!((190.0..194.0).contains(&behind.pose.x) && (behind.pose.y - 5.0).abs() < 0.5, "{behind:?}");
    // At 25 m/s a vehicle does not come to a stop in 30 m.
    assert_eq!(world.room_for(&van(25.0), 30.0), Err(standing));
    let pose = RecordedPose { y: -80.0, ..van(0.0).pose };
    let off_the_road = RecordedVehicle { pose, ..van(0.0) };
    assert_eq!(world.room_for(&off_the_road, 0.0), Ok(off_the_road));
}

#[test]
fn a_driver_who_follows_closely_accepts_that_gap_and_does_not_brake_hard() {
    let mut world = motorway();
    let [ahead, behind] = [24.0, 0.0].map(|it| {
        let pose = further(&van(28.0), it);
        put(&mut world, &RecordedVehicle { pose, ..van(28.0) })
    });
    assert!(world.release_recorded(behind, None, 1));
    let hardest = (1..=30)
        .map(|step| {
            world.move_recorded(ahead, further(&van(28.0), 24.0 + 2.8 * f64::from(step)));
            world.step();
            world.vehicle(behind).expect("it is there").motion.acceleration
        })
        .fold(0.0, f32::min);
    assert!(hardest > -4.0, "it brakes with {hardest} m/s²");
}

#[test]
fn a_saved_world_goes_on_with_its_recorded_vehicles() {
    let mut world = motorway();
    let [recorded, driver] = [0.0, 60.0].map(|it| {
        let pose = further(&van(25.0), it);
        put(&mut world, &RecordedVehicle { pose, ..van(25.0) })
    });
    world.release_recorded(driver, None, 0);
    let mut other = motorway();
    other.restore(&world.save().expect("it can be saved")).expect("it is the same world");
    for world in [&mut world, &mut other] {
        for step in 1..=50 {
            world.move_recorded(recorded, further(&van(25.0), 2.5 * f64::from(step)));
            world.step();
        }
    }
    assert_eq!(world.state_hash(), other.state_hash());
    assert_eq!(other.vehicle(recorded).expect("it is there").size(), [6.2, 2.1]);
}
