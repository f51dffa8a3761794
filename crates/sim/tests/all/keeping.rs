//! Keeping to the slow side, on the road: what drivers do where the law has it, and that nothing changes elsewhere.

use std::collections::HashMap;

use crate::roads::{Road, drivers};
use laneweave_models::Style;
use laneweave_models::change::{Keeping, LaneChangeModel, Mcdm};
use laneweave_models::follow::{FollowingModel, Fvdm};
use laneweave_network::{ChainIndex, LaneUse, Network, RoadLaw, Side};
use laneweave_sim::{Class, Event, LaneChangeKind, Placement, Setup, Vehicle, World};

/// A driver of the shipped kind: the weights of `style`, with the thresholds and the weight of keeping of the styles.
fn shipped(style: Style, keeping: f64) -> Style {
    let LaneChangeModel::Mcdm(table) = style.change else { unreachable!("the paper's model") };
    let keeping = Keeping { weight: keeping, ..Keeping::default() };
    Style { change: LaneChangeModel::Mcdm(Mcdm { theta: 0.012, sigma: 0.0015, keeping, ..table }), ..style }
}

fn styles(keeping: f64) -> Vec<Style> {
    let conservative = drivers::conservative();
    let slower = Style { speed_factor: 0.9, ..conservative.clone() };
    let quicker = Style { speed_factor: 1.1, ..conservative.clone() };
    [conservative, slower, quicker, drivers::aggressive()].map(|it| shipped(it, keeping)).to_vec()
}

fn motorway(lane_use: LaneUse, is_mirrored: bool) -> Network {
    let mut network = Road { lanes: 3, length: 5000.0, is_mirrored, ..Road::default() }.network();
    network.law.lane_use = lane_use;
    network
}

/// `flow` [veh/h] of three lanes, a tenth of it trucks.
fn traffic(network: Network, keeping: f64, flow: f64) -> World {
    let demand = drivers::demand(&network, flow, 0.1, &[3.0, 2.0, 2.0, 1.0]);
    let setup = Setup { step: 0.2, seed: 3, threads: 1 };
    World::new(network, styles(keeping), demand, setup).expect("the set-up makes sense")
}

/// The shares of the distance that is driven on each lane, the slow one first, from the tenth to the thirtieth minute.
fn shares(mut world: World) -> [f64; 3] {
    let mut driven = [0.0; 3];
    for step in 0..9000 {
        world.step();
        if step >= 3000 && step % 5 == 0 {
            for it in world.vehicles() {
                driven[it.spot.chain.at()] += it.speed();
            }
        }
    }
    let all: f64 = driven.iter().sum();
    driven.map(|it| it / all)
}

#[test]
fn in_light_traffic_drivers_keep_to_the_slow_side_where_the_law_has_it() {
    // 300 veh/h/lane.
    let [slow, _, fast] = shares(traffic(motorway(LaneUse::SlowSide, false), 0.08, 900.0));
    assert!(slow > 0.35 && fast < 0.15, "{slow} and {fast}");
    let [mirrored, _, _] = shares(traffic(motorway(LaneUse::SlowSide, true), 0.08, 900.0));
    assert!((mirrored - slow).abs() < 1e-9, "the same where traffic drives on the left: {mirrored}");
    let [free, _, _] = shares(traffic(motorway(LaneUse::Free, false), 0.08, 900.0));
    assert!(slow > free + 0.1, "{slow} and {free}");
}

#[test]
fn near_capacity_the_lanes_level_out() {
    // 1,700 veh/h/lane.
    let shares = shares(traffic(motorway(LaneUse::SlowSide, false), 0.08, 5100.0));
    assert!(shares.iter().all(|it| (0.28..0.38).contains(it)), "{shares:?}");
}

#[test]
fn without_the_law_the_wish_for_the_slow_side_changes_no_bit_and_without_the_wish_the_law_does_not() {
    let hash = |lane_use, keeping| {
        let mut world = traffic(motorway(lane_use, false), keeping, 2700.0);
        (0..1500).for_each(|_| world.step());
        // The weight stands in the styles, not in the state.
        (world.state_hash(), world.counts().keeping_changes)
    };
    let without = hash(LaneUse::Free, 0.0);
    assert_eq!(hash(LaneUse::Free, 0.08), without);
    assert_eq!(hash(LaneUse::SlowSide, 0.0), without);
    let with = hash(LaneUse::SlowSide, 0.08);
    assert!(with.0 != without.0 && with.1 > 0 && without.1 == 0, "{with:?} and {without:?}");
}

/// Of the changes to the slow side, of all between equal lanes: how many are made, and which share of them the driver
/// undoes within 30 s.
fn undone(mut world: World) -> (usize, f64) {
    let (mut last, mut all, mut back) = (HashMap::<u32, f64>::new(), 0, 0);
    for _ in 0..9000 {
        world.step();
        for event in world.events() {
            let Event::LaneChange(change) = event else { continue };
            if !change.is_completed || change.kind == LaneChangeKind::Route {
                continue;
            }
            let before = last.remove(&change.vehicle);
            if change.side == Side::Right {
                all += 1;
                last.insert(change.vehicle, change.time);
            } else {
                back += usize::from(before.is_some_and(|time| change.time - time < 30.0));
            }
        }
    }
    (all, back as f64 / all as f64)
}

#[test]
fn drivers_do_not_go_back_and_forth_between_keeping_and_overtaking() {
    for flow in [900.0, 2100.0, 3300.0] {
        let [(all, share), (_, without_the_law)] = [LaneUse::SlowSide, LaneUse::Free]
            .map(|lane_use| undone(traffic(motorway(lane_use, false), 0.08, flow)));
        assert!(all > 500, "{all}");
        // Who changes to the slow side overtakes again about as rarely as without the law.
        assert!(share < 0.25 && share < without_the_law + 0.03, "{share}, {without_the_law} at {flow} veh/h");
    }
}

#[test]
fn in_towns_long_vehicles_keep_to_the_slow_side_and_cars_choose_freely() {
    let street = |is_in_town| {
        let road = Road { lanes: 3, length: 5000.0, limit: 50.0 / 3.6, is_in_town, ..Road::default() };
        let mut network = road.network();
        network.law = RoadLaw { lane_use: LaneUse::SlowSide, ..RoadLaw::FREE };
        traffic(network, 0.08, 900.0)
    };
    let [[cars, trucks], [cars_outside, _]] = [true, false].map(|it| on_the_slow_lane(street(it), is_long));
    assert!(trucks > 0.7 && cars < 0.5 && cars_outside > cars + 0.2, "{trucks}, {cars} and {cars_outside}");
}

#[test]
fn where_only_slower_traffic_keeps_to_the_slow_side_faster_drivers_choose_freely() {
    let with = |lane_use| on_the_slow_lane(traffic(motorway(lane_use, false), 0.08, 900.0), is_slower);
    let [faster, slower] = with(LaneUse::SlowSideIfSlower);
    let [faster_free, slower_free] = with(LaneUse::Free);
    assert!(slower > slower_free + 0.2, "{slower} and {slower_free}");
    // They keep away from the lane of the slower ones.
    assert!(faster < faster_free + 0.1, "{faster} and {faster_free}");
    // Both may pass on either side.
    assert!(passes(LaneUse::SlowSideIfSlower, 0.08, 22.0));
}

fn is_long(vehicle: &Vehicle, _: &World) -> bool {
    vehicle.driver.class.is_long()
}

fn is_slower(vehicle: &Vehicle, world: &World) -> bool {
    let (driver, network) = (vehicle.driver, world.network());
    let limit = network.chain(vehicle.spot.chain).limit(vehicle.x());
    laneweave_sim::desired_speed(driver.class, vehicle.style(), limit, &network.law) < limit
}

/// The shares of the distance that is driven on the slow lane by vehicles of two groups: the others, and these.
fn on_the_slow_lane(mut world: World, is_one: impl Fn(&Vehicle, &World) -> bool) -> [f64; 2] {
    let mut driven = [[0.0; 2]; 2];
    for step in 0..9000 {
        world.step();
        if step >= 3000 && step % 5 == 0 {
            for it in world.vehicles() {
                let group = &mut driven[usize::from(is_one(&it, &world))];
                group[usize::from(it.spot.chain.at() != 0)] += it.speed();
            }
        }
    }
    driven.map(|[slow, other]| slow / (slow + other))
}

/// A driver who keeps its lane and its speed behind any leader.
fn unyielding() -> Style {
    let follow = Fvdm { sensitivity: 0.0, relative_sensitivity: 0.0, ..Fvdm::default() };
    let stays = LaneChangeModel::Mcdm(Mcdm { theta: f64::INFINITY, sigma: 1.0, ..Mcdm::default() });
    Style { follow: FollowingModel::Fvdm(follow), change: stays, ..drivers::conservative() }
}

/// Whether a driver with the weight `keeping` in the slow lane is ahead, after a minute, of a driver at `speed` [m/s]
/// in the fast lane.
fn passes(lane_use: LaneUse, keeping: f64, speed: f64) -> bool {
    let mut network = Road { lanes: 2, length: 4000.0, ..Road::default() }.network();
    network.law.lane_use = lane_use;
    let nobody = drivers::demand(&network, 0.0, 0.0, &[1.0]);
    let styles = vec![shipped(drivers::conservative(), keeping), unyielding()];
    let mut world =
        World::new(network, styles, nobody, Setup { step: 0.1, seed: 1, threads: 1 }).expect("makes sense");
    for (lane, x) in [(0, 300.0), (1, 360.0)] {
        let chain = ChainIndex(lane);
        let placement =
            Placement { chain, x, speed, class: Class::Car, parameters: lane, destination: Some(0) };
        world.place(placement).expect("it fits on the road");
    }
    (0..600).for_each(|_| world.step());
    let [me, other] = [0, 1].map(|id| world.vehicles().find(|it| it.id() == id).expect("on the road").x());
    me > other
}

#[test]
fn who_keeps_to_the_slow_side_does_not_pass_there_in_free_traffic() {
    assert!(!passes(LaneUse::SlowSide, 0.08, 22.0));
    assert!(passes(LaneUse::SlowSide, 0.08, 14.0), "in congested traffic one does");
    assert!(passes(LaneUse::Free, 0.08, 22.0), "without the law one does");
    assert!(passes(LaneUse::SlowSide, 0.0, 22.0), "without the wish one does");
}
