//! Users close lanelets, and open them again.

use std::collections::BTreeSet;

use laneweave_network::{Id, Position};
use laneweave_sim::{
    Class, Command, CommandError, Control, Lateral, Longitudinal, NewVehicle, Vehicle, VehicleId, World,
};

use crate::external::lanes::{drive, insert};
use crate::external::worlds::world;

fn close(world: &mut World, lanelet: Id, is_closed: bool) {
    world.command(Command::CloseLanelet { lanelet, is_closed }).expect("it is possible");
}

fn steps(world: &mut World, count: u32) {
    (0..count).for_each(|_| world.step());
}

/// The lanelets of a straight motorway `x` [m] from its beginning, from the right to the left.
pub(crate) fn across(world: &World, x: f64) -> Vec<Id> {
    let mut found = Vec::new();
    for lanelet in &world.network().lanelets {
        let line = &lanelet.centre;
        let [from, to] = [0.0, line.length()].map(|it| line.at(it));
        if from.x <= x && x < to.x {
            found.push((from.y, lanelet.id));
        }
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    found.into_iter().map(|it| it.1).collect()
}

/// The vehicles whose front bumpers are on a lanelet.
fn on(world: &World, lanelet: Id) -> BTreeSet<VehicleId> {
    let is_on = |it: &Vehicle| {
        let at = Position::new(it.spot.chain, it.x());
        world.network().lanelet_at(at).0.id == lanelet
    };
    world.vehicles().filter(is_on).map(|it| it.id()).collect()
}

/// The vehicles that no braking stops before a lanelet that begins at `x` [m].
fn too_near(world: &World, x: f64) -> BTreeSet<VehicleId> {
    let is_near = |it: &Vehicle| {
        let pose = it.pose();
        let left = x - (pose.at.x + 0.5 * it.driver.class.body().length);
        left > -1.0 && left < it.speed() * it.speed() / (2.0 * Control::HARDEST) + 1.0
    };
    world.vehicles().filter(is_near).map(|it| it.id()).collect()
}

/// Closes a lane of the motorway for five minutes, and checks that nobody enters it.
fn close_a_lane(lanes: &[usize], demand: f64, seed: u64) {
    let mut world = world("motorway_3_lanes.osm", demand, seed, 1);
    steps(&mut world, 1800);
    let all = across(&world, 3000.0);
    let closed: Vec<Id> = lanes.iter().map(|it| all[*it]).collect();
    let start =
        world.network().lanelets.iter().find(|it| it.id == closed[0]).expect("it is there").centre.at(0.0);
    let mut may: BTreeSet<VehicleId> = closed.iter().flat_map(|it| on(&world, *it)).collect();
    may.extend(too_near(&world, start.x));
    closed.iter().for_each(|it| close(&mut world, *it, true));
    let left = world.counts().left;
    for step in 0..3000 {
        world.step();
        for lanelet in &closed {
            let entered: Vec<_> = on(&world, *lanelet).difference(&may).copied().collect();
            assert!(entered.is_empty(), "step {step}: {entered:?} on {lanelet}");
        }
    }
    assert!(closed.iter().all(|it| on(&world, *it).is_empty()), "those on it drive off it");
    let share = (world.counts().left - left) as f64 / (demand * 300.0 / 3600.0);
    assert!(share > 0.8, "{share} of the demand drives past {lanes:?}, seed {seed}");
    closed.iter().for_each(|it| close(&mut world, *it, false));
    let mut seen = BTreeSet::new();
    for _ in 0..3000 {
        world.step();
        seen.extend(closed.iter().flat_map(|it| on(&world, *it)));
    }
    assert!(seen.len() > 50, "{} vehicles use it again", seen.len());
    let slowest = world.vehicles().map(|it| it.speed()).fold(f64::INFINITY, f64::min);
    assert!(slowest > 5.0, "nobody stands any longer: {slowest}");
    let counters = world.counters();
    assert_eq!((counters.collisions, counters.overlaps, counters.stuck, counters.lost), (0, 0, 0, 0));
}

#[test]
fn nobody_enters_a_closed_lane_and_all_drive_past_it() {
    for seed in 1..=3 {
        close_a_lane(&[0], 3000.0, seed);
        close_a_lane(&[1], 2500.0, seed);
        close_a_lane(&[0, 1], 1500.0, seed);
    }
}

#[test]
fn a_vehicle_that_keeps_its_lane_stops_before_a_closed_lanelet_and_drives_on_when_it_is_open() {
    let mut world = world("motorway_3_lanes.osm", 0.0, 1, 1);
    let id = insert(&mut world, 1, 150.0, 30.0);
    drive(&mut world, id, Longitudinal::Driver, Lateral::Keep);
    let lanelet = across(&world, 1500.0)[1];
    let start =
        world.network().lanelets.iter().find(|it| it.id == lanelet).expect("it is there").centre.at(0.0).x;
    close(&mut world, lanelet, true);
    steps(&mut world, 1500);
    let front = |world: &World| world.vehicle(id).map(|it| it.pose().at.x + 0.5 * Class::Car.body().length);
    let stands = front(&world).expect("it is on the road");
    assert_eq!(world.vehicle(id).map(|it| it.speed()), Some(0.0));
    assert!((start - 20.0..start).contains(&stands), "it stands at {stands} m, and {start} m are closed");
    assert_eq!(world.counters().emergency_brakings, 0);
    close(&mut world, lanelet, false);
    steps(&mut world, 300);
    assert!(front(&world).is_some_and(|it| it > start + 200.0), "{:?}", front(&world));
}

#[test]
fn in_dense_traffic_drivers_stay_clear_of_each_other_before_a_closed_lane_and_nobody_is_stuck() {
    for seed in 1..=3 {
        let mut world = world("motorway_3_lanes.osm", 5000.0, seed, 1);
        steps(&mut world, 1800);
        let lanelet = across(&world, 3000.0)[0];
        close(&mut world, lanelet, true);
        steps(&mut world, 6000);
        close(&mut world, lanelet, false);
        steps(&mut world, 6000);
        // A queue would be a tenth of the vehicles and more; a short wave of dense traffic is none.
        let slow = world.vehicles().filter(|it| it.speed() < 5.0).count();
        assert!(slow * 20 < world.on_road(), "the queue is gone: {slow} of {}", world.on_road());
        let counters = world.counters();
        assert_eq!((counters.collisions, counters.overlaps, counters.stuck, counters.lost), (0, 0, 0, 0));
    }
}

#[test]
fn drivers_come_back_into_the_lane_of_their_exit_behind_a_closed_lanelet() {
    let run = |is_closed: bool| {
        let mut world = world("off_ramp.osm", 3000.0, 1, 1);
        steps(&mut world, 1800);
        if is_closed {
            let lanelet = across(&world, 1500.0)[0];
            close(&mut world, lanelet, true);
        }
        steps(&mut world, 6000);
        let counters = world.counters();
        assert_eq!((counters.collisions, counters.overlaps, counters.stuck, counters.lost), (0, 0, 0, 0));
        counters.missed_turns
    };
    let [open, closed] = [false, true].map(run);
    assert!(closed <= open + 5, "{closed} missed turns, {open} without the closed lanelet");
}

#[test]
fn a_lane_that_is_open_again_before_anybody_comes_changes_nothing() {
    let run = |is_closed: bool| {
        let mut world = world("motorway_3_lanes.osm", 3000.0, 1, 1);
        let lanelet = across(&world, 4800.0)[1];
        if is_closed {
            close(&mut world, lanelet, true);
        }
        steps(&mut world, 300);
        if is_closed {
            close(&mut world, lanelet, false);
        }
        steps(&mut world, 3000);
        world.state_hash()
    };
    assert_eq!(run(false), run(true));
}

#[test]
fn a_checkpoint_keeps_what_is_closed_and_threads_do_not_matter() {
    let mut hashes = Vec::new();
    for threads in [1, 2, 4] {
        let mut first = world("motorway_3_lanes.osm", 3000.0, 1, threads);
        steps(&mut first, 1200);
        let lanelet = across(&first, 2500.0)[0];
        close(&mut first, lanelet, true);
        steps(&mut first, 300);
        let saved = first.save().expect("it can be saved");
        let mut second = world("motorway_3_lanes.osm", 3000.0, 1, threads);
        second.restore(&saved).expect("it fits");
        [&mut first, &mut second].into_iter().for_each(|it| steps(it, 900));
        assert!(on(&second, lanelet).is_empty());
        hashes.extend([first.state_hash(), second.state_hash()]);
    }
    assert!(hashes.iter().all(|it| *it == hashes[0]), "{hashes:?}");
}

#[test]
fn a_lane_that_drivers_could_not_leave_is_not_closed() {
    let mut motorway = world("motorway_3_lanes.osm", 0.0, 1, 1);
    let refused = |world: &mut World, lanelet: Id, part: &str| {
        let command = Command::CloseLanelet { lanelet, is_closed: true };
        let text = world.command(command).expect_err(part).to_string();
        assert!(text.contains(part), "{text}");
    };
    refused(&mut motorway, Id::from(-7), "there is no lanelet -7; choose one that vehicles may use");
    let first = across(&motorway, 10.0)[0];
    refused(&mut motorway, first, "choose a lanelet farther on");
    let all = across(&motorway, 3000.0);
    close(&mut motorway, all[0], true);
    close(&mut motorway, all[1], true);
    refused(&mut motorway, all[2], "leave a lane beside it open");
    assert!(matches!(
        motorway.command(Command::CloseLanelet { lanelet: all[0], is_closed: false }),
        Err(CommandError::Twice(_))
    ));
    motorway.step();
    let vehicle = NewVehicle {
        lanelet: all[0],
        position_m: 50.0,
        speed_mps: 20.0,
        class: Class::Car,
        style: "conservative".into(),
        destination: None,
    };
    let text = motorway.command(Command::Insert(vehicle)).expect_err("it is closed").to_string();
    assert!(text.contains("the lanelet is closed; choose another one, or open it"), "{text}");
    let mut town = world("grid.osm", 0.0, 1, 1);
    let chain = town.network().chains.iter().find(|it| it.previous.len() == 1).expect("there is one");
    let lanelet = town.network().lanelets[chain.lanelets[0].at()].id;
    refused(&mut town, lanelet, "choose a lanelet farther from junctions");
}

/// Closes `count` lanelets chosen by `number` where that is possible.
fn close_some(world: &mut World, number: u64, count: u64) -> Vec<Id> {
    let ids: Vec<Id> = world.network().lanelets.iter().map(|it| it.id).collect();
    let chosen = (1..=count).map(|it| ids[(number + it * 7919) as usize % ids.len()]);
    let mut is_possible =
        |lanelet: &Id| world.command(Command::CloseLanelet { lanelet: *lanelet, is_closed: true }).is_ok();
    chosen.filter(|it| is_possible(it)).collect()
}

#[test]
fn wherever_lanes_are_closed_nobody_enters_them_later_and_nobody_is_hurt_stuck_or_lost() {
    for (map, demand) in
        [("ramps.osm", 3500.0), ("weaving.osm", 3000.0), ("off_ramp.osm", 3500.0), ("town.osm", 900.0)]
    {
        let mut world = world(map, demand, 1, 1);
        let (mut closed, mut count) = (Vec::new(), 0);
        for half_minute in 0..20 {
            closed.drain(..).for_each(|it| close(&mut world, it, false));
            world.step();
            closed = close_some(&mut world, half_minute * 104_729, 8);
            count += closed.len();
            // After five seconds all have stopped who have to.
            steps(&mut world, 50);
            for _ in 0..249 {
                let before: BTreeSet<VehicleId> = closed.iter().flat_map(|it| on(&world, *it)).collect();
                world.step();
                let now: BTreeSet<VehicleId> = closed.iter().flat_map(|it| on(&world, *it)).collect();
                assert!(now.is_subset(&before), "{map}, half minute {half_minute}");
            }
        }
        assert!(count > 20, "{map}: {count} closings");
        let counters = world.counters();
        assert_eq!(
            (counters.collisions, counters.overlaps, counters.stuck, counters.lost),
            (0, 0, 0, 0),
            "{map}"
        );
    }
}
