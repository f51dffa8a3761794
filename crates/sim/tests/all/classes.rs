//! Lanes for some classes of vehicles: who may use a lane does, and nobody else is ever in it.

use laneweave_network::{Class, Classes, Network, Position};
use laneweave_sim::{
    Command, CommandError, Control, Demand, Departures, Fleet, Headways, InnerPlace, Line, LineCount,
    LineStop, NewVehicle, Place, Places, Setup, Share, World, WorldError,
};

use crate::roads::{Road, drivers};

const FLEET: Fleet = Fleet { trucks: 0.1, buses: 0.1, motorcycles: 0.1, taxis: 0.05, emergency: 0.05 };

/// A street of two lanes, of rows of 500 m; the slow lane is for buses in some of them.
fn street(length: f64, classes: fn(usize, usize) -> Classes) -> Network {
    Road { lanes: 2, length, limit: 50.0 / 3.6, is_in_town: true, classes, ..Road::default() }.network()
}

/// `flow` [veh/h] of all classes on `network`.
fn traffic(network: Network, flow: f64, seed: u64) -> World {
    let population = vec![Share { weight: 1.0, first: 0, count: 1 }];
    let demand = Demand::over(&network, Places::at_gates(&network), flow, FLEET, population);
    let setup = Setup { step: 0.1, seed, threads: 1 };
    World::new(network, vec![drivers::conservative()], demand, setup)
        .expect("the set-up makes sense")
        .audited()
}

/// What was seen on a road in a quarter of an hour.
#[derive(Default)]
struct Seen {
    /// For each class the vehicles that were seen in lanes for some classes only, and in all others, once a second.
    in_lanes: [[usize; 2]; Class::ALL.len()],
    completed: u64,
}

/// Drives for a quarter of an hour.
///
/// # Panics
/// If a vehicle is in a lane that its class may not use, or if vehicles collide.
fn drive(mut world: World) -> Seen {
    let mut seen = Seen::default();
    for step in 0..9000 {
        world.step();
        if step % 10 != 0 {
            continue;
        }
        for vehicle in world.vehicles() {
            let (class, chain) = (vehicle.driver.class, world.network().chain(vehicle.spot.chain));
            assert!(chain.classes.has(class), "a {} in lanelet {:?}", class.body().name, chain.lanelets);
            let is_for_all = usize::from(chain.classes == Classes::ALL);
            seen.in_lanes[class as usize][is_for_all] += 1;
        }
    }
    let counters = world.counters();
    assert_eq!([counters.collisions, counters.overlaps, counters.stuck], [0; 3]);
    seen.completed = completed(&world);
    seen
}

/// Vehicles that have left the road.
fn completed(world: &World) -> u64 {
    world.arrived() - (world.waiting() + world.on_road()) as u64
}

fn share_in_special_lanes(seen: &Seen, class: Class) -> f64 {
    let [special, other] = seen.in_lanes[class as usize];
    special as f64 / (special + other) as f64
}

#[test]
fn a_lane_for_buses_is_used_by_buses_and_never_by_others() {
    let bus_lane = |_, lane| if lane == 0 { Classes::BUS_LANE } else { Classes::ALL };
    for seed in 1..4 {
        let seen = drive(traffic(street(2000.0, bus_lane), 600.0, seed));
        assert!(seen.completed > 100, "{}", seen.completed);
        assert!(share_in_special_lanes(&seen, Class::Bus) > 0.9, "{:?}", seen.in_lanes);
        assert_eq!(
            [Class::Car, Class::Truck, Class::Motorcycle].map(|it| share_in_special_lanes(&seen, it)),
            [0.0; 3]
        );
    }
}

#[test]
fn a_lane_closed_to_trucks_is_used_by_all_others() {
    let no_trucks = |_, lane| {
        if lane == 0 { Classes::ALL.without(Classes::from_iter([Class::Truck])) } else { Classes::ALL }
    };
    let seen = drive(traffic(street(2000.0, no_trucks), 600.0, 1));
    assert!(seen.completed > 100, "{}", seen.completed);
    assert_eq!(share_in_special_lanes(&seen, Class::Truck), 0.0);
    assert!(share_in_special_lanes(&seen, Class::Bus) > 0.9, "{:?}", seen.in_lanes);
    assert!((0.2..0.8).contains(&share_in_special_lanes(&seen, Class::Car)), "{:?}", seen.in_lanes);
}

#[test]
fn drivers_leave_a_lane_before_it_becomes_one_for_buses_and_come_back_behind_it() {
    let bus_lane =
        |row, lane| if lane == 0 && (2..4).contains(&row) { Classes::BUS_LANE } else { Classes::ALL };
    for (seed, flow) in [(1, 300.0), (2, 900.0), (3, 1300.0)] {
        let mut world = traffic(street(3000.0, bus_lane), flow, seed);
        let slow_lanes: Vec<_> =
            (0..6).map(|row| world.network().lanelet_with(2 * row + 1).unwrap()).collect();
        let chain_of = |world: &World, row: usize| world.network().start_of(slow_lanes[row]).chain;
        let (before, behind) = (chain_of(&world, 0), chain_of(&world, 5));
        let (mut cars_before, mut cars_behind) = (0, 0);
        for _ in 0..9000 {
            world.step();
            for vehicle in world.vehicles() {
                let chain = world.network().chain(vehicle.spot.chain);
                assert!(chain.classes.has(vehicle.driver.class));
                let is_car = vehicle.driver.class == Class::Car;
                cars_before += usize::from(is_car && vehicle.spot.chain == before);
                cars_behind += usize::from(is_car && vehicle.spot.chain == behind);
            }
        }
        let counters = world.counters();
        assert_eq!([counters.collisions, counters.overlaps, counters.stuck], [0; 3]);
        // In light traffic nothing draws them back.
        assert!(cars_before > 1000, "{cars_before}");
        assert!(flow < 500.0 || cars_behind > 1000, "{cars_behind} at {flow} veh/h");
        // Who came in the first two thirds of the time has passed.
        let expected = (flow / 4.0 * 0.6) as u64;
        assert!(completed(&world) > expected, "{} at {flow} veh/h", completed(&world));
    }
}

#[test]
fn nobody_starts_on_a_road_that_its_class_may_not_use() {
    let only_buses = |_, _| Classes::BUS_LANE;
    let network = street(1000.0, only_buses);
    let population = vec![Share { weight: 1.0, first: 0, count: 1 }];
    let mut demand = Demand::over(&network, Places::at_gates(&network), 600.0, FLEET, population);
    assert_eq!(demand.origins[0].rate.at(0.0), 0.0, "no lane is for cars");
    demand.origins[0].rate = laneweave_sim::Rate::constant(600.0);
    let setup = Setup { step: 0.1, seed: 1, threads: 1 };
    let world =
        World::new(network, vec![drivers::conservative()], demand, setup).expect("the set-up makes sense");
    let seen = drive(world);
    let [cars, trucks, buses, motorcycles, taxis, emergency] =
        Class::ALL.map(|it| seen.in_lanes[it as usize].iter().sum::<usize>());
    assert_eq!([cars, trucks, motorcycles], [0; 3]);
    // A tenth, a twentieth and a twentieth of the demand: half of who comes is a bus.
    assert!(buses > taxis && taxis > 0 && emergency > 0, "{buses}, {taxis}, {emergency}");
}

const WITH_BUS_LANE: fn(usize, usize) -> Classes =
    |_, lane| if lane == 0 { Classes::BUS_LANE } else { Classes::ALL };

/// A street of two lanes with these `classes`, with a line of five stops in the slow one that departs `every_s` [s].
fn with_line(classes: fn(usize, usize) -> Classes, every_s: f64, flow: f64, seed: u64) -> World {
    let setup = Setup { step: 0.1, seed, threads: 1 };
    with_stops_at(300.0, classes, every_s, flow, setup).expect("the set-up makes sense")
}

/// The same, with stops at this `place` of each 500 m.
fn with_stops_at(
    place: f64,
    classes: fn(usize, usize) -> Classes,
    every_s: f64,
    flow: f64,
    setup: Setup,
) -> Result<World, WorldError> {
    let network = street(3000.0, classes);
    let population = vec![Share { weight: 1.0, first: 0, count: 1 }];
    let mut demand =
        Demand::over(&network, Places::at_gates(&network), flow, Fleet::with_trucks(0.1), population);
    let first = demand.destinations.len();
    let lanelets = [1, 3, 5, 7, 9].map(|id| (id, network.lanelet_with(id).expect("it is there")));
    let places = lanelets.map(|(id, it)| {
        let Position { chain, x } = network.start_of(it);
        Place::Inside(InnerPlace { id: id.into(), chain, station: x + place + LineStop::MARGIN })
    });
    demand.destinations.extend(places);
    demand.origins.iter_mut().for_each(|it| it.weights.extend([0.0; 5]));
    demand.stops = 5;
    demand.lines.push(Line {
        name: "7".into(),
        class: Class::Bus,
        origin: 0,
        stops: (first..first + 5)
            .map(|destination| LineStop { destination, rest_s: 20.0, until_s: None })
            .collect(),
        destination: 0,
        departures: Departures { first_s: 10.0, every_s, until_s: 600.0 },
    });
    World::new(network, vec![drivers::conservative()], demand, setup).map(World::audited)
}

#[test]
fn buses_of_a_line_rest_at_each_stop_for_their_time_and_leave_the_map() {
    for seed in 1..4 {
        let mut world = with_line(WITH_BUS_LANE, 60.0, 800.0, seed);
        assert_eq!(world.line_without_a_route(), None);
        let mut standing = std::collections::BTreeMap::new();
        for step in 0..12_000 {
            world.step();
            if step == 6_000 {
                assert!(world.externals().next().is_none(), "nobody is driven by a user");
            }
            for vehicle in world.vehicles().filter(|it| it.speed() == 0.0) {
                assert_eq!(vehicle.driver.class, Class::Bus);
                let place = (vehicle.spot.chain, (vehicle.motion.x / 10.0).round() as i64);
                *standing.entry(place).or_insert(0.0) += 0.1;
            }
        }
        let LineCount { departed, served, missed } = world.lines()[0];
        assert_eq!((departed, served, missed), (10, 50, 0));
        let counters = world.counters();
        assert_eq!([counters.collisions, counters.overlaps, counters.stuck, counters.hard_brakings], [0; 4]);
        assert_eq!(standing.len(), 5, "{standing:?}");
        for (place, time) in standing {
            assert!((time - 200.0_f64).abs() < 20.0, "{time} s at {place:?}");
        }
        assert!(world.vehicles().all(|it| it.driver.class != Class::Bus), "all have left");
    }
}

#[test]
fn the_next_bus_waits_behind_one_that_rests_at_its_stop_and_others_pass() {
    for classes in [WITH_BUS_LANE, |_, _| Classes::ALL] {
        let mut world = with_line(classes, 25.0, 600.0, 1);
        (0..12_000).for_each(|_| world.step());
        let LineCount { departed, served, missed } = world.lines()[0];
        assert_eq!(departed, 24);
        assert!(served >= 115 && missed <= 3, "{served} served, {missed} missed");
        let counters = world.counters();
        assert_eq!([counters.collisions, counters.overlaps, counters.stuck], [0; 3]);
        // The others lose little time: a bus rests for 20 s at each of five stops.
        let mean = world.counters().distance / (world.counters().updates as f64 * 0.1);
        assert!(mean > 8.0, "{mean} m/s");
    }
}

#[test]
fn a_saved_world_goes_on_with_its_line() {
    let [mut one, mut other] = [0, 0].map(|_| with_line(WITH_BUS_LANE, 60.0, 800.0, 1));
    (0..1500).for_each(|_| one.step());
    other.restore(&one.save().expect("it is saved")).expect("it is restored");
    for _ in 0..3000 {
        one.step();
        other.step();
    }
    assert_eq!((one.state_hash(), one.lines()), (other.state_hash(), other.lines()));
    assert!(one.lines()[0].served > 5);
}

#[test]
fn a_stop_just_behind_the_entrance_is_served_at_any_step() {
    for step in [0.1, 0.5, 1.0] {
        let setup = Setup { step, seed: 1, threads: 1 };
        let mut world = with_stops_at(20.0, WITH_BUS_LANE, 60.0, 400.0, setup).expect("it makes sense");
        (0..(1200.0 / step) as usize).for_each(|_| world.step());
        let LineCount { departed, served, missed } = world.lines()[0];
        assert_eq!((departed, served, missed), (10, 50, 0), "in steps of {step} s");
    }
}

#[test]
fn a_bus_goes_round_an_obstacle_before_its_stop() {
    for before_stop in [0.0, 40.0, 90.0] {
        let mut world = with_line(|_, _| Classes::ALL, 60.0, 400.0, 1);
        let ground =
            world.obstacle_in_lane(3.into(), 300.0 - before_stop, [4.5, 1.8]).expect("it is possible");
        world.put_obstacle(0, &ground).expect("its place is free");
        (0..12_000).for_each(|_| world.step());
        let LineCount { departed, served, missed } = world.lines()[0];
        assert_eq!((departed, served + missed), (10, 50));
        assert!(served >= 40, "{served} served with an obstacle {before_stop} m before the second");
        let counters = world.counters();
        assert_eq!([counters.collisions, counters.overlaps, counters.stuck], [0; 3]);
        assert!(world.vehicles().all(|it| it.driver.class != Class::Bus), "all have left");
    }
}

#[test]
fn a_line_needs_an_interval() {
    for every_s in [0.0, -1.0, 0.5, f64::NAN] {
        let setup = Setup { step: 0.1, seed: 1, threads: 1 };
        let refused = with_stops_at(300.0, WITH_BUS_LANE, every_s, 400.0, setup).err();
        assert!(matches!(refused, Some(WorldError::Line(_))), "{every_s} s: {refused:?}");
    }
}

#[test]
fn a_bus_of_which_a_user_disposes_leaves_its_line() {
    let mut world = with_line(WITH_BUS_LANE, 900.0, 0.0, 1);
    let is_resting = |world: &World| world.vehicles().any(|it| it.speed() == 0.0);
    while !is_resting(&world) {
        world.step();
    }
    let (bus, at) = world.vehicles().map(|it| (it.id(), it.x())).next().expect("it rests");
    assert_eq!(world.control_of(bus), Control::DRIVER, "no user drives it");
    let exit = world.demand().exits()[0].id();
    world.command(Command::SetDestination(bus, Some(exit))).expect("it is possible");
    (0..50).for_each(|_| world.step());
    let now = world.vehicles().next().expect("it drives");
    assert!(now.x() > at + 5.0 && now.speed() > 1.0, "it does not go on resting");
    (0..6000).for_each(|_| world.step());
    assert_eq!((completed(&world), world.on_road()), (1, 0), "it has left at its destination");
    assert_eq!(world.lines()[0].served, 0);
}

#[test]
fn who_has_no_destination_goes_where_its_class_may_go() {
    let bus_lane =
        |row, lane| if lane == 0 && (2..4).contains(&row) { Classes::BUS_LANE } else { Classes::ALL };
    for class in [Class::Bus, Class::Car, Class::Truck] {
        let mut world = traffic(street(3000.0, bus_lane), 0.0, 1);
        let style = "conservative".into();
        let new = NewVehicle {
            lanelet: 1.into(),
            position_m: 50.0,
            speed_mps: 10.0,
            class,
            style,
            destination: None,
        };
        world.command(Command::Insert(new)).expect("its place is free");
        let special = world.network().start_of(world.network().lanelet_with(5).expect("it is there")).chain;
        let mut was_there = false;
        for _ in 0..6000 {
            world.step();
            was_there |= world.vehicles().any(|it| it.spot.chain == special);
        }
        assert_eq!(world.on_road(), 0, "the {class:?} has left at the end");
        assert!((world.counters().distance - 2950.0).abs() < 3.0, "{} m", world.counters().distance);
        assert_eq!(was_there, class == Class::Bus);
    }
}

#[test]
fn a_road_that_goes_on_for_buses_only_ends_for_cars() {
    let street_of_buses = |row, _| if row >= 3 { Classes::BUS_LANE } else { Classes::ALL };
    let world = traffic(street(3000.0, street_of_buses), 600.0, 1);
    for chain in &world.network().chains {
        assert_eq!(chain.ends_for, Classes::NONE, "there is no lane beside it on which others go on");
    }
}

#[test]
fn a_demand_that_a_user_sets_is_divided_by_the_lanes_for_cars() {
    let network = street(1000.0, WITH_BUS_LANE);
    let population = vec![Share { weight: 1.0, first: 0, count: 1 }];
    let mut demand = Demand::over(&network, Places::at_gates(&network), 600.0, FLEET, population);
    demand.headways = Headways::Shifted { minimum: 2.0 };
    let setup = Setup { step: 0.1, seed: 1, threads: 1 };
    let mut world =
        World::new(network, vec![drivers::conservative()], demand, setup).expect("it makes sense");
    let origin = world.demand().origins[0].place.id();
    let mut set = |vehicles_per_hour| world.command(Command::SetDemand { origin, vehicles_per_hour });
    assert!(
        matches!(set(3000.0), Err(CommandError::Headways(_))),
        "one lane does not bear a vehicle each 1.2 s"
    );
    set(1500.0).expect("it does each 2.4 s");
}
