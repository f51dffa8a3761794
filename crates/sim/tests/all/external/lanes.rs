//! External vehicles that drive in lanes do what their users say.

use laneweave_network::{ChainIndex, Position, Side};
use laneweave_sim::{
    Class, Command, Control, Event, IncidentKind, Lateral, Longitudinal, NewVehicle, Phase, VehicleId, World,
};

use crate::external::worlds::world;
use crate::roads::network;

/// A car on the middle lane of an empty motorway of three lanes.
pub(crate) fn alone() -> (World, VehicleId) {
    let mut world = world("motorway_3_lanes.osm", 0.0, 1, 1);
    let id = insert(&mut world, 1, 150.0, 25.0);
    (world, id)
}

/// Puts a car on a lane, counted from the right, of the beginning of the motorway.
pub(crate) fn insert(world: &mut World, lane: usize, position_m: f64, speed_mps: f64) -> VehicleId {
    let entrance = &world.network().entrances[0];
    let mut chains = entrance.chains.clone();
    chains.sort_by(|a, b| {
        let y = |it: &laneweave_network::ChainIndex| world.network().chain(*it).centre.at(0.0).y;
        y(a).total_cmp(&y(b))
    });
    let lanelet = world.network().chain(chains[lane]).lanelets[0];
    let lanelet = world.network().lanelets[lanelet.at()].id;
    let (style, destination) = ("conservative".into(), None);
    let vehicle = NewVehicle { lanelet, position_m, speed_mps, class: Class::Car, style, destination };
    world.command(Command::Insert(vehicle)).expect("the place is free").expect("it has an id")
}

pub(crate) fn drive(world: &mut World, id: VehicleId, longitudinal: Longitudinal, lateral: Lateral) {
    let control = Control::Drive { longitudinal, lateral };
    world.command(Command::Control(id, control)).expect("it is possible");
}

fn steps(world: &mut World, count: u32) -> Vec<Event> {
    let step = |_| {
        world.step();
        world.events().to_vec()
    };
    (0..count).flat_map(step).collect()
}

/// Lateral position of the vehicle's centre [m].
fn y(world: &World, id: VehicleId) -> f64 {
    world.vehicle(id).expect("it is on the road").pose().at.y
}

#[test]
fn it_accelerates_and_brakes_as_it_is_told_and_never_drives_backwards() {
    let (mut world, id) = alone();
    drive(&mut world, id, Longitudinal::Acceleration(-2.0), Lateral::Keep);
    steps(&mut world, 10);
    let vehicle = world.vehicle(id).expect("it is on the road");
    assert!((vehicle.speed() - 23.0).abs() < 1e-9 && (vehicle.x() - (150.0 + 24.0)).abs() < 1e-9);
    steps(&mut world, 200);
    assert_eq!(world.vehicle(id).expect("it is on the road").speed(), 0.0);
    drive(&mut world, id, Longitudinal::Speed(10.0), Lateral::Keep);
    steps(&mut world, 10);
    let speed = world.vehicle(id).expect("it is on the road").speed();
    assert!((speed - 3.0).abs() < 1e-9, "a car accelerates with 3 m/s² at most: {speed}");
    steps(&mut world, 40);
    assert!((world.vehicle(id).expect("it is on the road").speed() - 10.0).abs() < 1e-9);
    assert_eq!(world.counters().emergency_brakings, 0);
}

#[test]
fn told_to_drive_at_most_so_fast_it_brakes_gently_and_is_slower_where_its_driver_is() {
    let (mut world, ahead) = alone();
    let behind = insert(&mut world, 1, 50.0, 25.0);
    let speed = |world: &World| world.vehicle(behind).expect("it is on the road").speed();
    drive(&mut world, behind, Longitudinal::AtMost(20.0), Lateral::Keep);
    steps(&mut world, 10);
    assert!((speed(&world) - 23.0).abs() < 1e-9, "it brakes with 2 m/s²: {}", speed(&world));
    steps(&mut world, 50);
    assert!((speed(&world) - 20.0).abs() < 1e-9, "{}", speed(&world));
    // Behind a vehicle that stops its driver stops.
    drive(&mut world, ahead, Longitudinal::Speed(0.0), Lateral::Keep);
    steps(&mut world, 600);
    assert!(speed(&world) < 0.1 && world.counters().collisions == 0, "{}", speed(&world));
}

#[test]
fn it_changes_lanes_once_for_each_command() {
    let (mut world, id) = alone();
    let before = y(&world, id);
    drive(&mut world, id, Longitudinal::Driver, Lateral::Change(Side::Left));
    let events = steps(&mut world, 80);
    let changes = |events: &[Event]| events.iter().filter(|it| matches!(it, Event::LaneChange(_))).count();
    assert_eq!(changes(&events), 1);
    let there = y(&world, id);
    assert!((there - before - 3.75).abs() < 0.3, "one lane to the left: {}", there - before);
    // A lane further to the left does not exist. It waits for one.
    drive(&mut world, id, Longitudinal::Driver, Lateral::Change(Side::Left));
    assert_eq!(changes(&steps(&mut world, 50)), 0);
    // Right twice: two commands.
    for _ in 0..2 {
        drive(&mut world, id, Longitudinal::Driver, Lateral::Change(Side::Right));
        assert_eq!(changes(&steps(&mut world, 80)), 1);
    }
    assert!((y(&world, id) - before + 3.75).abs() < 0.3);
}

#[test]
fn who_wants_to_join_vehicles_that_follow_each_other_closely_does_not_fall_back_beside_them() {
    // Twenty cars crawl along, with 2 m between them: no gap is long enough. Its own lane is free.
    let mut world = world("motorway_3_lanes.osm", 0.0, 1, 1);
    for at in 0..20 {
        let crawls = insert(&mut world, 2, 10.0 + 6.5 * f64::from(at), 3.0);
        drive(&mut world, crawls, Longitudinal::Speed(3.0), Lateral::Keep);
    }
    let own = insert(&mut world, 1, 60.0, 8.0);
    drive(&mut world, own, Longitudinal::Driver, Lateral::Change(Side::Left));
    let mut slowest = f64::INFINITY;
    for _ in 0..150 {
        steps(&mut world, 1);
        slowest = slowest.min(world.vehicle(own).expect("it is on the road").speed());
    }
    assert!(slowest > 7.0, "{slowest}");
    // Ahead of them there is room.
    steps(&mut world, 200);
    assert!(y(&world, own) > y(&world, 1_000_000_000) - 0.5, "{}", y(&world, own));
}

#[test]
fn a_change_is_aborted_before_the_centre_crosses_the_line_and_completed_after() {
    for (wait, is_completed) in [(15, false), (30, true)] {
        let (mut world, id) = alone();
        drive(&mut world, id, Longitudinal::Driver, Lateral::Change(Side::Right));
        steps(&mut world, wait);
        assert_eq!(world.vehicle(id).expect("it is on the road").driver.phase, Phase::Changes);
        drive(&mut world, id, Longitudinal::Driver, Lateral::Keep);
        let events = steps(&mut world, 80);
        let outcome = events.iter().find_map(|it| match it {
            Event::LaneChange(change) => Some(change.is_completed),
            _ => None,
        });
        assert_eq!(outcome, Some(is_completed));
    }
}

#[test]
fn a_collision_that_it_causes_is_an_incident_with_both_parties() {
    let (mut world, ahead) = alone();
    let behind = insert(&mut world, 1, 100.0, 25.0);
    drive(&mut world, ahead, Longitudinal::Speed(5.0), Lateral::Keep);
    drive(&mut world, behind, Longitudinal::Speed(25.0), Lateral::Keep);
    let events = steps(&mut world, 100);
    let incidents: Vec<_> =
        events.iter().filter_map(|it| if let Event::Incident(it) = it { Some(it) } else { None }).collect();
    let [incident] = incidents[..] else { panic!("{} incidents", incidents.len()) };
    assert_eq!((incident.kind, incident.vehicles), (IncidentKind::Collision, [ahead, behind]));
    // It drove through. The world is still in order.
    assert!(world.vehicle(behind).expect("it is there").x() > world.vehicle(ahead).expect("it is there").x());
    assert_eq!(world.save().and_then(|it| world.restore(&it)), Ok(()));
}

#[test]
fn drivers_behind_it_stay_clear_of_whatever_it_does() {
    let mut world = world("motorway_3_lanes.osm", 4500.0, 3, 1);
    steps(&mut world, 1200);
    let id = {
        let middle = world.vehicles().filter(|it| (2000.0..2500.0).contains(&it.pose().at.x));
        middle.map(|it| it.id()).next().expect("there is traffic")
    };
    drive(&mut world, id, Longitudinal::Acceleration(-8.0), Lateral::Keep);
    steps(&mut world, 1200);
    assert_eq!(world.vehicle(id).map(|it| it.speed()), Some(0.0));
    assert_eq!((world.counters().collisions, world.counters().overlaps), (0, 0));
}

/// Puts a vehicle with its front at a place of a straight road.
fn place(world: &mut World, at: Position, class: Class, speed_mps: f64) -> VehicleId {
    let (lanelet, position_m) = world.network().lanelet_at(at);
    let (lanelet, style, destination) = (lanelet.id, "conservative".into(), None);
    let vehicle = NewVehicle { lanelet, position_m, speed_mps, class, style, destination };
    world.command(Command::Insert(vehicle)).expect("the place is free").expect("it has an id")
}

/// A bus drives into a standing car whose front is at a place, until its own front is a little beyond that one. Then a
/// driver comes from behind.
fn stops_for_the_rearmost_one(map: &str, at: Position) {
    let mut world = world(map, 0.0, 1, 1);
    let place = |world: &mut World, behind, class, speed| {
        place(world, Position::new(at.chain, at.x - behind), class, speed)
    };
    let short = place(&mut world, 0.0, Class::Car, 0.0);
    let long = place(&mut world, 10.0, Class::Bus, 0.0);
    drive(&mut world, short, Longitudinal::Speed(0.0), Lateral::Keep);
    drive(&mut world, long, Longitudinal::Speed(5.0), Lateral::Keep);
    let bumper = |it: usize| move |world: &World, id| world.vehicle(id).expect("it is there").bumpers()[it].x;
    let [front, rear] = [0, 1].map(bumper);
    while front(&world, long) < front(&world, short) + 0.5 {
        world.step();
    }
    drive(&mut world, long, Longitudinal::Acceleration(-8.0), Lateral::Keep);
    steps(&mut world, 20);
    let behind = place(&mut world, 100.0, Class::Car, 15.0);
    drive(&mut world, behind, Longitudinal::Driver, Lateral::Keep);
    let events = steps(&mut world, 400);
    let struck = events.iter().filter(|it| matches!(it, Event::Incident(_))).count();
    let (rear, front) = (rear(&world, long), front(&world, behind));
    // Far enough behind it to go round it, had it not to keep its lane.
    assert!(struck == 0 && front < rear && front > rear - 30.0, "{map}: {struck}: {front} m behind {rear} m");
}

#[test]
fn drivers_behind_vehicles_that_lie_within_each_other_stop_for_the_rearmost_one() {
    for (map, to_end) in [("motorway_3_lanes.osm", 500.0), ("ramps.osm", 1.0)] {
        let network = network(map);
        let has_end = |it: &ChainIndex| map != "ramps.osm" || !network.chain(*it).following.is_empty();
        let chain = network.entrances[0].chains.iter().copied().find(has_end).expect("a lane goes on");
        // On the second map the front of the bus is on the next chain in the end.
        stops_for_the_rearmost_one(map, Position::new(chain, network.chain(chain).length - to_end));
    }
}
