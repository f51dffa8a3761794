//! A jam on the straight road: which drivers leave their route for the left road. A first test of the paper's third
//! claim, that changes grow sharply with the weight of the route.

use std::collections::{HashMap, HashSet};

use laneweave::models::Style;
use laneweave::models::change::{LaneChangeModel, Mcdm, Route, Rule};
use laneweave::network::{ChainIndex, Position};
use laneweave::study::{Estimate, mean};
use laneweave::style::Population;
use laneweave_sim::{
    Class, Demand, Event, Fleet, InnerPlace, LaneChangeKind, Place, Placement, Places, Setup, Share,
    VehicleId, World,
};

use crate::approach::roads::{Approach, Road};

const STEP_S: f64 = 0.1;
const SEEDS: u64 = 10;
/// Interval of guidance [s].
const INTERVAL_S: f64 = 30.0;
/// Begin of the drivers' arrivals, after the jam has built up, and their duration [s].
const BEGIN: u32 = 120;
const COME_FOR: u32 = 180;
/// Time in which the last drivers pass the junction [s].
const AFTER: u32 = 60;
/// Seconds between two of them.
const HEADWAY: u32 = 4;
/// Weights of the route.
const WEIGHTS: [f64; 3] = [0.0, 0.005, 0.05];
/// A weight with which all leave a jam, and a far larger one.
const ALL_LEAVE: [f64; 2] = [0.05, 3.2];
/// Desired speed of the drivers who cause the jam, as a share of the limit, and their flow on each lane [veh/h].
const CRAWL: f64 = 0.15;
const CRAWLERS: f64 = 240.0;

/// Mean actions of drivers.
struct Found {
    lane_changes: f64,
    route_changes: f64,
    /// Share that drove to the left.
    left: f64,
}

/// The usual drivers, with another table of incentives.
fn drivers(seed: u64, table: impl Fn(Mcdm) -> Mcdm) -> Vec<Style> {
    let mut driver_parameters = Population::usual(seed).expect("built-in styles").driver_parameters;
    for it in &mut driver_parameters {
        let LaneChangeModel::Mcdm(usual) = &it.change else { panic!("the usual drivers weigh") };
        it.change = LaneChangeModel::Mcdm(table(usual.clone()));
    }
    driver_parameters
}

/// The usual weights, except that of the route.
fn with_route_weight(weight: f64) -> impl Fn(Mcdm) -> Mcdm {
    move |usual| Mcdm { route: Route { weight, ..usual.route }, ..usual }
}

/// No weights, with the threshold rule.
fn without_weights(usual: Mcdm) -> Mcdm {
    Mcdm { rule: Rule::Threshold, theta: usual.theta, ..Mcdm::default() }
}

/// Drivers to the common exit enter in lanes B and C; their route is straight on, where `crawlers` enter on each lane
/// [veh/h].
fn drive(seed: u64, table: impl Fn(Mcdm) -> Mcdm, crawlers: f64) -> Found {
    let approach = Approach::drawn();
    let [_, b, c] = approach.lanes;
    let [_, _, common] = approach.exits;
    let mut driver_parameters = drivers(seed, table);
    let count = driver_parameters.len() as u32;
    let crawler = Style { speed_factor: CRAWL, ..drivers(seed, without_weights).swap_remove(0) };
    driver_parameters.push(crawler);
    let network = approach.network.clone();
    let places =
        Places { origins: inner_places(&approach), destinations: Places::at_gates(&network).destinations };
    let population = vec![Share { weight: 1.0, first: count, count: 1 }];
    let total = crawlers * places.origins.len() as f64;
    let mut demand = Demand::over(&network, places, total, Fleet::default(), population);
    for origin in &mut demand.origins {
        origin.weights.fill(0.0);
        origin.weights[usize::from(common)] = 1.0;
    }
    let setup = Setup { step: STEP_S, seed, threads: 1 };
    let mut world = World::new(network, driver_parameters, demand, setup).expect("a world");
    world = world.guided(INTERVAL_S).expect("few destinations");
    let mut come: HashSet<VehicleId> = HashSet::new();
    let mut roads: HashMap<VehicleId, Road> = HashMap::new();
    let mut lane_changes = 0;
    for step in 0..(BEGIN + COME_FOR + AFTER) * 10 {
        let is_time = (BEGIN * 10..(BEGIN + COME_FOR) * 10).contains(&step) && step % (10 * HEADWAY) == 0;
        if is_time {
            let number = step / (10 * HEADWAY);
            let chain = if number.is_multiple_of(2) { b } else { c };
            if world.scene().motions(chain).first().is_none_or(|it| it.rear() > 40.0) {
                let parameters = (number * 7919 + seed as u32) % count;
                let (class, destination) = (Class::Car, Some(common));
                let speed = 10.0;
                come.insert(
                    world
                        .place(Placement { chain, x: 5.0, speed, class, parameters, destination })
                        .expect("it fits on the road"),
                );
            }
        }
        world.step();
        for it in world.vehicles().filter(|it| come.contains(&it.id())) {
            if let Some(road) = approach.road(it.spot.chain, it.x()) {
                roads.entry(it.id()).or_insert(road);
            }
        }
        for event in world.events() {
            let Event::LaneChange(it) = event else { continue };
            let is_before = approach.road(it.from.chain, it.from.x).is_none();
            let counts = it.kind != LaneChangeKind::Keeping && it.is_completed && is_before;
            lane_changes += u32::from(counts && come.contains(&it.vehicle));
        }
    }
    let counters = world.counters();
    assert_eq!((counters.collisions, world.counters().overlaps), (0, 0));
    let all = come.len() as f64;
    Found {
        lane_changes: f64::from(lane_changes) / all,
        route_changes: counters.route_changes as f64 / all,
        left: roads.values().filter(|it| **it == Road::Left).count() as f64 / all,
    }
}

/// Trip ends at the beginning of the straight road, one in each lane.
fn inner_places(approach: &Approach) -> Vec<Place> {
    let across = approach.lanes.iter().flat_map(|it| approach.across(*it));
    let inner = |chain: ChainIndex| {
        let station = approach.begin_of(Road::Straight, chain)?;
        let (lanelet, _) = approach.network.lanelet_at(Position::new(chain, station));
        Some(Place::Inside(InnerPlace { id: lanelet.id, chain, station }))
    };
    across.filter_map(inner).collect()
}

/// Over seeds: lane changes, route changes, and the share that drove to the left.
fn replicate(what: &str, seeds: u64, table: impl Fn(Mcdm) -> Mcdm, crawlers: f64) -> [Estimate; 3] {
    let found: Vec<Found> = (1..=seeds).map(|seed| drive(seed, &table, crawlers)).collect();
    let over = |of: fn(&Found) -> f64| mean(&found.iter().map(of).collect::<Vec<_>>()).expect("replications");
    let all = [over(|it| it.lane_changes), over(|it| it.route_changes), over(|it| it.left)];
    let show = |it: &Estimate| format!("{:.3} ± {:.3}", it.mean, it.half_width);
    let [lanes, routes, left] = all.each_ref().map(show);
    eprintln!("{what}: per driver {lanes} lane changes, {routes} route changes; {left} to the left");
    all
}

#[test]
fn with_a_jam_on_the_own_route_more_leave_it_the_more_the_route_weighs() {
    let found =
        WEIGHTS.map(|it| replicate(&format!("route weight {it}"), SEEDS, with_route_weight(it), CRAWLERS));
    assert_eq!(found[0][1].mean, 0.0, "nobody leaves a route that it does not weigh");
    for pair in found.windows(2) {
        for (less, more) in pair[0].iter().zip(&pair[1]).skip(1) {
            assert!(less.interval().upper < more.interval().lower, "{less:?} {more:?}");
        }
    }
}

#[test]
fn where_all_leave_the_jam_lane_changes_grow_with_the_weight_of_the_route() {
    const SEEDS: u64 = 30;
    let of = |it| replicate(&format!("route weight {it}"), SEEDS, with_route_weight(it), CRAWLERS);
    let [[less, ..], [more, ..]] = ALL_LEAVE.map(of);
    assert!(less.interval().upper < more.interval().lower, "{less:?} {more:?}");
}

#[test]
fn without_weights_nobody_leaves_its_lane_or_its_route() {
    assert_eq!(replicate("no weights", SEEDS, without_weights, CRAWLERS).map(|it| it.mean), [0.0; 3]);
}

#[test]
fn without_a_jam_nobody_leaves_its_route() {
    let [_, routes, left] = replicate("no jam", SEEDS, with_route_weight(0.8), 0.0);
    assert_eq!((routes.mean, left.mean), (0.0, 0.0));
}
