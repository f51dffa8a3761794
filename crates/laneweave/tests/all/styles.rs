//! Effects of driver parameters: tired drivers change lanes less and notice later, and nobody leaves the lane of its
//! route; near altruists others lose less speed than near egoists. Over ten seeds or more, the 95 % intervals do not
//! overlap.

use std::collections::HashMap;
use std::path::Path;

use laneweave::maps::{ReadOptions, load};
use laneweave::network::{ChainIndex, Network, RoadLaw};
use laneweave::study::{Interval, mean};
use laneweave::style::{Population, StyleTemplate, find};
use laneweave_sim::{
    Class, Demand, Event, LaneChangeKind, Phase, Placement, Rate, Setup, Share, Vehicle, VehicleId, World,
};

const STEP_S: f64 = 0.1;
const STEPS_PER_SECOND: u32 = 10;

fn own_map(name: &str) -> Network {
    let path = laneweave_test_data::map(name);
    load(&path, &ReadOptions::default()).expect("the map is sound").network
}

/// The drivers of built-in styles, with equal shares.
fn population(styles: &[&str]) -> Population {
    let template = |name: &&str| {
        let source = find(name, Path::new(""), String::new).expect("it is built in");
        (StyleTemplate::parse(&source).expect("it is sound"), 1.0)
    };
    Population::draw(&styles.iter().map(template).collect::<Vec<_>>(), 1).expect("it can be drawn")
}

/// A world with `per_hour` vehicles at its first entrance, 10 % of them trucks, of the styles in `driven`.
fn world(network: Network, population: &Population, driven: &[Share], per_hour: f64, seed: u64) -> World {
    let mut demand = Demand::even(&network, 0.0, 0.1, driven.to_vec());
    demand.origins[0].rate = Rate::constant(per_hour);
    let setup = Setup { step: STEP_S, seed, threads: 1 };
    World::new(network, population.driver_parameters.clone(), demand, setup).expect("a world")
}

fn drive(world: &mut World, seconds: u32, mut watch: impl FnMut(&World, u32)) {
    for step in 0..seconds * STEPS_PER_SECOND {
        world.step();
        watch(world, step);
    }
}

/// A running mean.
#[derive(Clone, Copy, Default)]
struct Sum {
    all: f64,
    count: f64,
}

impl Sum {
    fn add(&mut self, value: f64) {
        self.all += value;
        self.count += 1.0;
    }

    fn mean(self) -> f64 {
        self.all / self.count
    }
}

/// The interval over the seeds, printed on screen.
fn interval(what: &str, found: &[f64]) -> Interval {
    let estimate = mean(found).expect("replications");
    eprintln!("{what}: {:.4} ± {:.4} over {} seeds", estimate.mean, estimate.half_width, found.len());
    estimate.interval()
}

/// Asserts that the first is below the second, with intervals that do not overlap.
#[track_caller]
fn assert_below(what: [&str; 2], found: [Vec<f64>; 2]) {
    let [lower, upper] = [0, 1].map(|it| interval(what[it], &found[it]));
    assert!(lower.upper < upper.lower, "{what:?}: {lower:?} and {upper:?}");
}

#[test]
fn tired_drivers_change_lanes_less_than_others_in_the_same_traffic() {
    const SEEDS: u64 = 20;
    let both = population(&["inattentive", "conservative"]);
    let is_other = |parameters: u32| usize::from(parameters >= both.shares[1].first);
    let mut rates = [Vec::new(), Vec::new()];
    for seed in 1..=SEEDS {
        let mut world = world(own_map("motorway_2_lanes.osm"), &both, &both.shares, 2200.0, seed);
        drive(&mut world, 180, |_, _| ());
        let (mut changes, mut kilometres) = ([0.0; 2], [0.0; 2]);
        drive(&mut world, 600, |world, step| {
            for event in world.events() {
                if let Event::LaneChange(it) = event
                    && it.is_completed
                    && it.kind == LaneChangeKind::Discretionary
                {
                    changes[is_other(it.parameters)] += 1.0;
                }
            }
            if step % STEPS_PER_SECOND == 0 {
                world
                    .vehicles()
                    .for_each(|it| kilometres[is_other(it.driver.parameters)] += it.speed() / 1000.0);
            }
        });
        (0..2).for_each(|it| rates[it].push(changes[it] / kilometres[it]));
    }
    assert_below(["changes/veh-km of the tired", "of the others"], rates);
}

/// Gap to a truck at which drivers of `style` who approach it on the empty slow lane want to overtake: mean of four
/// [m].
fn gap_when_noticed(style: &str, seed: u64) -> f64 {
    const PAIRS: u32 = 4;
    const APART: f64 = 800.0;
    let drivers = population(&[style, "egoistic"]);
    let [those, truckers] = [0, 1].map(|it| drivers.shares[it]);
    let mut world = world(own_map("motorway_2_lanes.osm"), &drivers, &drivers.shares, 0.0, seed);
    let mut put = |x, speed, class, parameters| {
        let (chain, destination) = (ChainIndex(0), Some(0));
        world
            .place(Placement { chain, x, speed, class, parameters, destination })
            .expect("it fits on the road")
    };
    let mut coming = Vec::new();
    for pair in 0..PAIRS {
        let (x, number) = (20.0 + APART * f64::from(pair), (seed as u32 * PAIRS + pair) % those.count);
        coming.push(put(x, 33.0, Class::Car, those.first + number));
        put(x + 300.0, 22.0, Class::Truck, truckers.first + number);
    }
    let mut gaps = Sum::default();
    drive(&mut world, 100, |world, _| {
        let scene = world.scene();
        for it in world.vehicles().filter(|it| it.driver.phase == Phase::Wants) {
            let Some(place) = coming.iter().position(|id| *id == it.id()) else { continue };
            coming.swap_remove(place);
            scene.ahead(scene.viewpoint(it.spot)).into_iter().for_each(|it| gaps.add(it.gap));
        }
    });
    gaps.mean()
}

#[test]
fn tired_drivers_notice_a_slow_truck_later() {
    const SEEDS: u64 = 20;
    let gaps = ["inattentive", "conservative"]
        .map(|style| (1..=SEEDS).map(|seed| gap_when_noticed(style, seed)).collect());
    assert_below(["gap [m] at which the tired want to overtake", "at which others do"], gaps);
}

/// Changes per vehicle, in dense traffic before an off-ramp, to lanes from which more changes remain than before.
fn changes_off_the_route(style: &str, seed: u64) -> f64 {
    let drivers = population(&[style]);
    // Where drivers keep to the slow side, they hardly leave the lanes of the ramp.
    let mut network = own_map("off_ramp.osm");
    network.law = RoadLaw::FREE;
    let mut world = world(network, &drivers, &drivers.shares, 4500.0, seed);
    let mut off = 0;
    drive(&mut world, 600, |world, _| {
        let navigator = world.scene().navigator;
        for event in world.events() {
            let Event::LaneChange(change) = event else { continue };
            let driver = world.vehicles().find(|it| it.id() == change.vehicle && change.is_completed);
            let Some(destination) = driver.map(|it| it.driver.goal.destination()) else { continue };
            let [from, to] =
                [change.from, change.to].map(|it| navigator.waypoint(destination, it.chain).changes);
            off += u32::from(to > from);
        }
    });
    f64::from(off) / world.counts().left as f64
}

#[test]
fn hardly_anyone_leaves_the_lane_of_its_route_before_an_off_ramp_tired_or_not() {
    const SEEDS: u64 = 20;
    for style in ["inattentive", "conservative"] {
        let changes: Vec<f64> = (1..=SEEDS).map(|seed| changes_off_the_route(style, seed)).collect();
        let changes = mean(&changes).expect("replications");
        eprintln!(
            "{style}: {:.4} ± {:.4} changes off the route per vehicle",
            changes.mean, changes.half_width
        );
        assert!(changes.interval().upper <= 0.05, "{changes:?}");
    }
}

#[test]
fn those_before_whom_altruists_change_lose_less_speed_than_those_before_whom_egoists_do() {
    const SEEDS: u64 = 10;
    /// Time after which the loss is measured [s], and maximum distance of a follower [m].
    const AFTER: u32 = 5;
    const NEAR: f64 = 100.0;
    let both = population(&["altruistic", "egoistic"]);
    let mut losses = [Vec::new(), Vec::new()];
    for seed in 1..=SEEDS {
        let mut world = world(own_map("motorway_2_lanes.osm"), &both, &both.shares, 2200.0, seed);
        drive(&mut world, 180, |_, _| ());
        let mut lost = [Sum::default(); 2];
        let mut phases: HashMap<VehicleId, Phase> = HashMap::new();
        // Time of the measurement, follower, its earlier speed, and the driver who changed before it.
        let mut concerned: Vec<(u32, VehicleId, f64, usize)> = Vec::new();
        drive(&mut world, 600, |world, step| {
            let scene = world.scene();
            for it in world.vehicles() {
                let was = phases.insert(it.id(), it.driver.phase);
                let Some(twin) = it.lane_change.counterpart.filter(|_| was == Some(Phase::Wants)) else {
                    continue;
                };
                let from = scene.viewpoint_at(scene.viewpoint(it.spot), twin.chain, twin.x);
                let Some(found) = scene.follower(from).filter(|it| it.distance < NEAR) else { continue };
                let (other, egoist) =
                    (scene.motion(found.spot), it.driver.parameters >= both.shares[1].first);
                let at = step + AFTER * STEPS_PER_SECOND;
                concerned.push((at, other.id, other.speed, usize::from(egoist)));
            }
            for (_, id, speed, who) in concerned.extract_if(.., |it| it.0 == step) {
                let now = world.vehicles().find(|it| it.id() == id);
                now.into_iter().for_each(|it| lost[who].add(speed - it.speed()));
            }
        });
        (0..2).for_each(|it| losses[it].push(lost[it].mean()));
    }
    assert_below(["speed [m/s] lost behind altruists who change", "behind egoists"], losses);
}

/// The missing share of a driver's desired speed.
fn shortfall(it: &Vehicle) -> f64 {
    1.0 - it.speed() / f64::from(it.driver.desired)
}

#[test]
fn vehicles_that_merge_lose_less_speed_beside_altruists_than_beside_egoists() {
    const SEEDS: u64 = 10;
    /// Seconds between two vehicles at the ramp.
    const HEADWAY: u32 = 8;
    let losses = ["altruistic", "egoistic"].map(|style| {
        let all = population(&[style, "conservative"]);
        let on_the_ramp = all.shares[1];
        let loss = |seed| {
            let network = own_map("on_ramp.osm");
            let ramp = network.entrances.iter().find(|it| it.chains.len() == 1).expect("a ramp").chains[0];
            let mut world = world(network, &all, &all.shares[..1], 4000.0, seed);
            drive(&mut world, 120, |_, _| ());
            let mut lost = Sum::default();
            for number in 0..60 {
                world
                    .place(Placement {
                        chain: ramp,
                        x: 5.0,
                        speed: 15.0,
                        class: Class::Car,
                        parameters: on_the_ramp.first + number % on_the_ramp.count,
                        destination: Some(0),
                    })
                    .expect("it fits on the road");
                drive(&mut world, HEADWAY, |world, _| {
                    let come = world.vehicles().filter(|it| it.driver.parameters >= on_the_ramp.first);
                    let merge =
                        come.filter(|it| it.spot.chain == ramp || it.lane_change.last_place.is_finite());
                    merge.for_each(|it| lost.add(shortfall(&it)));
                });
            }
            lost.mean()
        };
        (1..=SEEDS).map(loss).collect()
    });
    assert_below(["share of speed that merging vehicles lack beside altruists", "beside egoists"], losses);
}
