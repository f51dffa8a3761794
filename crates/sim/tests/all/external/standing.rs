//! Something stands in a lane: drivers see it from afar, leave its lane, and pass.

use laneweave_network::{Id, Position, Rectangle};
use laneweave_sim::{Class, Command, Control, Lateral, Longitudinal, NewVehicle, VehicleId, World};

use crate::external::closed_lanes::across;
use crate::external::worlds::world;

/// A vehicle that has broken down.
#[derive(Clone, Copy)]
struct Broken {
    /// Its lane, from the right.
    lane: usize,
    /// Where its front bumper is [m].
    x: f64,
    class: Class,
}

const CAR: Broken = Broken { lane: 0, x: 2050.0, class: Class::Car };

/// Puts a vehicle that does not move on a straight motorway.
fn put(world: &mut World, broken: Broken) -> VehicleId {
    let lanelet = across(world, broken.x)[broken.lane];
    let lanelets = &world.network().lanelets;
    let start = lanelets.iter().find(|it| it.id == lanelet).expect("it is there").centre.at(0.0).x;
    let vehicle = NewVehicle {
        lanelet,
        position_m: broken.x - start,
        speed_mps: 0.0,
        class: broken.class,
        style: "conservative".into(),
        destination: None,
    };
    let id = world.command(Command::Insert(vehicle)).expect("its place is free").expect("it has an id");
    let control = Control::Drive { longitudinal: Longitudinal::Speed(0.0), lateral: Lateral::Keep };
    world.command(Command::Control(id, control)).expect("it is possible");
    id
}

/// What comes of a drive of a quarter of an hour.
struct Driven {
    world: World,
    /// Time that all vehicles of the demand spent on the road [s].
    spent: f64,
}

fn drive(map: &str, demand: f64, seed: u64, broken: &[Broken]) -> Driven {
    let mut world = world(map, demand, seed, 1);
    for it in broken {
        put(&mut world, *it);
    }
    let mut spent = 0.0;
    for _ in 0..9000 {
        world.step();
        spent += 0.1 * (world.vehicles().count() - broken.len()) as f64;
    }
    Driven { world, spent }
}

/// The time that each driver loses because of what stands there, beside a free road with the same arrivals [s].
fn lost(map: &str, demand: f64, seed: u64, broken: &[Broken]) -> f64 {
    let [free, blocked] = [&[][..], broken].map(|it| drive(map, demand, seed, it));
    let counters = blocked.world.counters();
    assert_eq!((counters.collisions, counters.overlaps, counters.stuck, counters.lost), (0, 0, 0, 0));
    (blocked.spent - free.spent) / free.world.counts().left as f64
}

#[test]
fn whoever_passes_a_vehicle_that_has_broken_down_loses_a_few_seconds() {
    for (map, lanes, demand) in [("motorway_2_lanes.osm", 2, 500.0), ("motorway_3_lanes.osm", 3, 1200.0)] {
        for lane in 0..lanes {
            for class in [Class::Car, Class::Truck] {
                let seconds = lost(map, demand, 3 + lane as u64, &[Broken { lane, class, ..CAR }]);
                assert!(seconds < 5.0, "{map}, lane {lane}, {class:?}: {seconds} s");
            }
        }
    }
}

#[test]
fn a_pile_up_is_passed_as_one_vehicle_is() {
    let pile: Vec<Broken> = (0..5).map(|it| Broken { x: CAR.x - 7.0 * f64::from(it), ..CAR }).collect();
    for (broken, seed) in [(pile, 7), (vec![CAR, Broken { x: CAR.x - 20.0, ..CAR }], 8)] {
        let seconds = lost("motorway_2_lanes.osm", 400.0, seed, &broken);
        assert!(seconds < 5.0, "{} vehicles: {seconds} s", broken.len());
    }
}

#[test]
fn drivers_change_two_lanes_before_two_that_are_blocked_side_by_side() {
    let far = Broken { lane: 1, x: 2070.0, class: Class::Truck };
    for (broken, seed) in [([CAR, far], 1), ([Broken { lane: 2, ..CAR }, far], 2)] {
        let seconds = lost("motorway_3_lanes.osm", 600.0, seed, &broken);
        assert!(seconds < 8.0, "{seconds} s");
    }
}

#[test]
fn drivers_wind_their_way_between_vehicles_that_stand_one_after_the_other() {
    let second = Broken { lane: 1, x: 2150.0, ..CAR };
    let seconds = lost("motorway_2_lanes.osm", 500.0, 4, &[CAR, second]);
    assert!(seconds < 15.0, "{seconds} s");
}

#[test]
fn nobody_waits_for_ever_where_something_stands_before_in_the_lane_between() {
    for (number, apart) in (0..8).map(|it| (it, 15.0 + 9.0 * it as f64)) {
        for lane in [0, 2] {
            let broken = [Broken { lane, ..CAR }, Broken { lane: 1, x: CAR.x - apart, ..CAR }];
            let seconds = lost("motorway_3_lanes.osm", 900.0, 20 + number, &broken);
            assert!(seconds < 12.0, "lane {lane}, {apart} m: {seconds} s");
        }
    }
}

#[test]
fn where_no_lane_is_free_the_queue_waits_and_goes_on_when_one_is_free_again() {
    let mut world = world("motorway_2_lanes.osm", 500.0, 5, 1);
    let [first, _] = [0, 1].map(|lane| put(&mut world, Broken { lane, ..CAR }));
    (0..6000).for_each(|_| world.step());
    let passed = |world: &World| {
        world.vehicles().filter(|it| !it.driver.is_external && it.pose().at.x > CAR.x).count() as u64
            + world.counts().left
    };
    assert_eq!((passed(&world), world.counters().stuck), (0, 0), "nobody could go round");
    world.command(Command::Remove(first)).expect("it is there");
    (0..3000).for_each(|_| world.step());
    assert!(passed(&world) > 60, "{}", passed(&world));
    let counters = world.counters();
    assert_eq!((counters.collisions, counters.overlaps, counters.stuck), (0, 0, 0));
}

#[test]
fn what_stands_in_lanes_is_part_of_a_saved_world() {
    let mut one = world("motorway_2_lanes.osm", 900.0, 6, 1);
    put(&mut one, CAR);
    let far = obstacle(&one, 2600.0, [2.0, 2.0]);
    one.put_obstacle(1, &far).expect("its place is free");
    put_tractor(&mut one, 0, 400.0);
    (0..900).for_each(|_| one.step());
    let mut other = world("motorway_2_lanes.osm", 900.0, 6, 1);
    other.restore(&one.save().expect("there is memory")).expect("it is the same world");
    for _ in 0..600 {
        one.step();
        other.step();
    }
    assert_eq!(one.state_hash(), other.state_hash());
}

#[test]
fn a_lanelet_that_is_closed_beside_it_leaves_no_way_round() {
    let mut world = world("motorway_2_lanes.osm", 500.0, 9, 1);
    put(&mut world, CAR);
    let beside = across(&world, CAR.x)[1];
    world.command(Command::CloseLanelet { lanelet: beside, is_closed: true }).expect("it is possible");
    (0..6000).for_each(|_| world.step());
    // The first one before the closed lanelet waits for a gap in the queue that stands beside it.
    assert!(world.counters().stuck <= 1, "nobody could go round: {}", world.counters().stuck);
}

/// An obstacle of this size with its far end at `x` on the right lane of a straight motorway.
fn obstacle(world: &World, x: f64, size: [f64; 2]) -> Rectangle {
    let lanelet = across(world, x)[0];
    let start =
        world.network().lanelets.iter().find(|it| it.id == lanelet).expect("it is there").centre.at(0.0).x;
    world.obstacle_in_lane(lanelet, x - start, size).expect("its place is there")
}

#[test]
fn an_obstacle_is_passed_as_a_vehicle_that_has_broken_down_and_the_lane_is_used_again_when_it_is_gone() {
    let free = drive("motorway_2_lanes.osm", 500.0, 12, &[]);
    let mut world = world("motorway_2_lanes.osm", 500.0, 12, 1);
    let it = obstacle(&world, CAR.x, [1.0, 1.5]);
    let id = world.put_obstacle(0, &it).expect("its place is free");
    assert_eq!((world.vehicles().count(), world.counts().entered), (0, 0), "it is no vehicle");
    assert_eq!(world.obstacles().collect::<Vec<_>>(), [(id, it)]);
    let mut spent = 0.0;
    for _ in 0..9000 {
        world.step();
        spent += 0.1 * world.vehicles().count() as f64;
    }
    let lost = (spent - free.spent) / free.world.counts().left as f64;
    assert!((0.1..5.0).contains(&lost), "{lost} s");
    world.remove_obstacle(id);
    (0..1200).for_each(|_| world.step());
    let lane = across(&world, CAR.x)[0];
    let mut back = 0;
    for _ in 0..1200 {
        world.step();
        back += world
            .vehicles()
            .filter(|it| world.network().lanelet_at(Position::new(it.spot.chain, it.x())).0.id == lane)
            .count();
    }
    assert!(back > 0, "nobody uses the lane again");
    let counters = world.counters();
    assert_eq!((counters.collisions, counters.overlaps, counters.stuck, counters.lost), (0, 0, 0, 0));
}

#[test]
fn an_obstacle_over_two_lanes_of_three_closes_both() {
    let mut world = world("motorway_3_lanes.osm", 600.0, 13, 1);
    let mut wide = obstacle(&world, CAR.x, [6.0, 4.0]);
    wide.pose.at.y += 1.75;
    world.put_obstacle(3, &wide).expect("its place is free");
    let mut seen = [0; 3];
    for _ in 0..6000 {
        world.step();
        let passes = |y: f64, lane: usize| ((y - 1.75) / 3.5 - lane as f64).abs() < 0.3;
        for it in world.vehicles().filter(|it| (it.pose().at.x - CAR.x).abs() < 3.0) {
            (0..3).for_each(|lane| seen[lane] += usize::from(passes(it.pose().at.y, lane)));
        }
    }
    assert!(seen[..2] == [0, 0] && seen[2] > 50, "{seen:?}");
    let counters = world.counters();
    assert_eq!((counters.collisions, counters.overlaps, counters.stuck, counters.lost), (0, 0, 0, 0));
}

#[test]
fn an_obstacle_comes_only_where_whoever_drives_there_can_stay_clear_of_it() {
    let mut world = world("motorway_2_lanes.osm", 3600.0, 14, 1);
    (0..3000).for_each(|_| world.step());
    let (mut put, mut refused) = (0, 0);
    for number in 0..40 {
        let it = obstacle(&world, 500.0 + 50.0 * f64::from(number), [4.0, 2.0]);
        match world.put_obstacle(number, &it) {
            Ok(id) => {
                (0..100).for_each(|_| world.step());
                world.remove_obstacle(id);
                put += 1;
            }
            Err(near) => {
                assert!(near.is_some_and(|it| world.vehicle(it).is_some()));
                refused += 1;
            }
        }
    }
    assert!(put > 5 && refused > 0, "{put} {refused}");
    assert_eq!((world.counters().collisions, world.counters().overlaps), (0, 0));
    assert!(world.obstacle_in_lane(Id::from(-1), 3.0, [4.0, 2.0]).is_err(), "there is no such lanelet");
    let lanelet = across(&world, 500.0)[0];
    for (x, size) in [(-1.0, [4.0, 2.0]), (50.0, [0.0, 2.0]), (1e4, [4.0, 2.0]), (50.0, [4.0, f64::NAN])] {
        assert!(world.obstacle_in_lane(lanelet, x, size).is_err(), "{x} {size:?}");
    }
}

/// Puts a tractor on this lane of a motorway, and holds it at 25 km/h.
fn put_tractor(world: &mut World, lane: usize, x: f64) -> VehicleId {
    let lanelet = across(world, x)[lane];
    let start =
        world.network().lanelets.iter().find(|it| it.id == lanelet).expect("it is there").centre.at(0.0).x;
    let (class, style) = (Class::Truck, "conservative".into());
    let (position_m, speed_mps, destination) = (x - start, 7.0, None);
    let vehicle = NewVehicle { lanelet, position_m, speed_mps, class, style, destination };
    let id = world.command(Command::Insert(vehicle)).expect("its place is free").expect("it has an id");
    let control = Control::Drive { longitudinal: Longitudinal::Speed(7.0), lateral: Lateral::Keep };
    world.command(Command::Control(id, control)).expect("it is possible");
    id
}

#[test]
fn whoever_passes_a_tractor_leaves_its_lane_early_and_loses_a_few_seconds() {
    for (map, demand) in [("motorway_2_lanes.osm", 1200.0), ("motorway_3_lanes.osm", 2400.0)] {
        let free = drive(map, demand, 21, &[]);
        let mut world = world(map, demand, 21, 1);
        let tractor = put_tractor(&mut world, 0, 300.0);
        let mut spent = 0.0;
        for _ in 0..9000 {
            world.step();
            spent += 0.1 * world.vehicles().filter(|it| it.id() != tractor).count() as f64;
        }
        let lost = (spent - free.spent) / free.world.counts().left as f64;
        assert!(lost < 10.0, "{map}: {lost} s");
        let counters = world.counters();
        assert_eq!((counters.collisions, counters.overlaps, counters.stuck), (0, 0, 0), "{map}");
    }
}

#[test]
fn behind_tractors_side_by_side_a_queue_crawls_and_does_not_stop() {
    let mut world = world("motorway_2_lanes.osm", 300.0, 22, 1);
    for lane in 0..2 {
        put_tractor(&mut world, lane, 300.0);
    }
    for _ in 0..2500 {
        world.step();
        let slowest = world.vehicles().map(|it| it.speed()).fold(f64::INFINITY, f64::min);
        assert!(slowest > 1.0, "{slowest} m/s");
    }
    assert_eq!((world.counters().collisions, world.counters().overlaps), (0, 0));
}
