//! What a driver perceives of a scene placed by hand equals what is computed by hand.

use crate::roads::{Road, drivers};
use laneweave_generate::{Motorway, motorway};
use laneweave_models::Attention;
use laneweave_models::Style;
use laneweave_models::change::{ConstantHazard, LaneChangeModel, LaneRule, Situation, Toward};
use laneweave_models::follow::Ahead;
use laneweave_network::{ChainIndex, Network, Side};
use laneweave_sim::{Class, Phase, Placement, Scene, Setup, Spot, Waypoint, World, perceive};

/// Length of a car [m].
const CAR: f64 = 4.5;
/// Length of a truck [m].
const TRUCK: f64 = 12.0;
/// How far drivers anticipate [m].
const SIGHT: f64 = 295.0;

#[track_caller]
fn assert_near(value: f64, expected: f64) {
    assert!((value - expected).abs() <= 1e-9 * expected.abs().max(1.0), "{value} is not {expected}");
}

/// Drivers with a desired speed of 30 m/s. Number 0 is a usual driver; number 1 wants to change wherever it may.
fn world(network: Network) -> World {
    let eager = Style {
        change: LaneChangeModel::ConstantHazard(ConstantHazard { hazard: 1.0 }),
        attention: Attention { epoch: 0.1, ..Attention::default() },
        speed_factor: 1.0,
        ..drivers::aggressive()
    };
    let nobody = drivers::demand(&network, 0.0, 0.0, &[1.0]);
    let setup = Setup { step: 0.1, seed: 1, threads: 1 };
    World::new(network, vec![drivers::conservative(), eager], nobody, setup).expect("the set-up makes sense")
}

fn straight(length: f64) -> World {
    world(Road { lanes: 2, length, limit: 30.0, ..Road::default() }.network())
}

fn put(world: &mut World, chain: u32, x: f64, speed: f64, class: Class) -> u32 {
    let (chain, destination) = (ChainIndex(chain), Some(0));
    world
        .place(Placement { chain, x, speed, class, parameters: 0, destination })
        .expect("it fits on the road")
}

fn car(world: &mut World, chain: u32, x: f64, speed: f64) -> u32 {
    put(world, chain, x, speed, Class::Car)
}

fn truck(world: &mut World, chain: u32, x: f64, speed: f64) -> u32 {
    put(world, chain, x, speed, Class::Truck)
}

fn spot(world: &World, id: u32) -> Spot {
    world.vehicles().find(|it| it.id() == id).expect("it is on the road").spot
}

fn look<'a>(scene: &'a Scene, world: &World, id: u32, side: Side) -> Situation<'a> {
    perceive(scene, spot(world, id), side).expect("there is a lane beside")
}

/// Anticipated speed behind one leader [m/s].
fn anticipated(gap: f64, speed: f64) -> f64 {
    (1.0 - gap / SIGHT) * speed + gap / SIGHT * 30.0
}

#[test]
fn gaps_means_and_prospects_of_both_lanes_are_those_of_the_scene() {
    let mut world = straight(1000.0);
    let me = car(&mut world, 0, 500.0, 20.0);
    car(&mut world, 0, 560.0, 18.0);
    car(&mut world, 0, 650.0, 10.0);
    car(&mut world, 0, 460.0, 22.0);
    // In sight, but beyond the window of 200 m ahead and 100 m back.
    truck(&mut world, 0, 720.0, 15.0);
    car(&mut world, 0, 399.0, 5.0);
    // Just within the window.
    truck(&mut world, 1, 700.0, 22.0);
    car(&mut world, 1, 495.0, 25.0);
    let scene = world.scene();
    let seen = look(&scene, &world, me, Side::Left);
    let Situation { toward, me, here, there, section, band, lane_rule, merging } = seen;
    assert!(toward == Toward::Offside && lane_rule == LaneRule::Free);
    // A driver without a recommended route keeps its own.
    assert_eq!(band, f64::INFINITY);
    assert_eq!(
        (me.pace.speed, me.pace.desired, me.pace.headway_relaxation, me.length),
        (20.0, 30.0, 1.0, CAR)
    );
    assert_eq!(here.ahead, Some(Ahead::steady(60.0 - CAR, 18.0)));
    assert_eq!(there.ahead, Some(Ahead::steady(200.0 - TRUCK, 22.0)));
    let behind = here.behind.unwrap();
    assert_eq!((behind.gap, behind.driver.pace.speed), (40.0 - CAR, 22.0));
    let behind = there.behind.unwrap();
    assert_eq!((behind.gap, behind.driver.pace.speed, behind.driver.length), (0.5, 25.0, CAR));
    assert_eq!((here.flow.spacing, here.flow.length), (100.0, CAR));
    assert_near(here.flow.speed, 50.0 / 3.0);
    assert_eq!((there.flow.spacing, there.flow.speed, there.flow.length), (150.0, 23.5, (CAR + TRUCK) / 2.0));
    // The second leader limits the anticipated speed more than the first.
    assert_near(here.anticipated_speed, anticipated(150.0 - CAR, 10.0));
    assert_near(there.anticipated_speed, anticipated(200.0 - TRUCK, 22.0));
    assert_eq!((here.route.changes, there.route.changes), (0, 0));
    assert_eq!((here.route.remaining, section), (f64::INFINITY, SIGHT));
    assert_near(here.route.onward, (500.0 - SIGHT) / 30.0);
    assert!(merging == [None; 2] && here.route.alternative.is_none());
}

#[test]
fn an_empty_window_looks_like_a_free_road_and_is_clipped_where_the_lane_begins_and_ends() {
    for (x, extent) in [(30.0, 230.0), (500.0, 300.0), (880.0, 220.0)] {
        let mut world = straight(1000.0);
        let me = car(&mut world, 0, x, 20.0);
        let scene = world.scene();
        let Situation { here, there, .. } = look(&scene, &world, me, Side::Left);
        for lane in [here, there] {
            assert_eq!((lane.flow.spacing, lane.flow.speed, lane.flow.length), (extent, 30.0, CAR));
            assert_eq!((lane.ahead, lane.behind, lane.anticipated_speed), (None, None, 30.0));
        }
    }
    let mut world = straight(1000.0);
    let me = car(&mut world, 1, 880.0, 20.0);
    car(&mut world, 0, 900.0, 20.0);
    let scene = world.scene();
    assert_eq!(look(&scene, &world, me, Side::Right).there.flow.spacing, 220.0);
    assert!(perceive(&scene, spot(&world, me), Side::Left).is_none());
}

#[test]
fn leaders_and_followers_are_seen_across_the_ends_of_chains() {
    // The road is so long that its lanes are cut into several chains.
    let mut world = straight(60_000.0);
    let chain_ends = world.network().chain(ChainIndex(0)).length;
    let [next, next_left] = [0, 1].map(|chain| world.network().chain(ChainIndex(chain)).following[0].0);
    let before = car(&mut world, 0, chain_ends - 50.0, 20.0);
    let beyond = car(&mut world, next, 30.0, 16.0);
    car(&mut world, next_left, 60.0, 25.0);
    let scene = world.scene();
    let back = look(&scene, &world, before, Side::Left);
    assert_eq!(back.here.ahead, Some(Ahead::steady(80.0 - CAR, 16.0)));
    assert_eq!(back.there.ahead, Some(Ahead::steady(110.0 - CAR, 25.0)));
    assert_near(back.here.anticipated_speed, anticipated(80.0 - CAR, 16.0));
    assert_eq!((back.here.flow.spacing, back.here.flow.speed), (300.0, 16.0));
    let front = look(&scene, &world, beyond, Side::Left);
    let behind = front.here.behind.unwrap();
    assert_eq!((behind.gap, behind.driver.pace.speed), (80.0 - CAR, 20.0));
    assert_eq!((front.here.flow.spacing, front.here.flow.speed), (300.0, 20.0));
    assert_eq!(front.there.behind, None);
}

fn drawn(plan: Motorway) -> World {
    let plan = Motorway { length_m: 4000.0, lanelet_length_m: 200.0, speed_limit_kmh: 108.0, ..plan };
    world(motorway(&plan).expect("the motorway is possible").build().expect("the drawing is sound").network)
}

#[test]
fn the_end_of_a_lane_stands_in_the_way_like_a_vehicle() {
    let mut world = drawn(Motorway { lane_drop_at: Some(2500.0), ..Motorway::default() });
    let me = car(&mut world, 0, 2400.0, 20.0);
    let beside = car(&mut world, 1, 2300.0, 20.0);
    let scene = world.scene();
    let Situation { here, there, section, .. } = look(&scene, &world, me, Side::Left);
    assert_eq!(here.ahead.map(|it| it.speed), Some(0.0));
    assert_near(here.ahead.unwrap().gap, 100.0);
    assert_near(here.anticipated_speed, anticipated(100.0, 0.0));
    assert_near(here.flow.spacing, 200.0);
    assert_eq!((here.route.changes, there.route.changes), (1, 0));
    assert_near(here.route.remaining, 100.0);
    assert_near(section, 100.0);
    // The driver beside sees the end, too, behind the nearer vehicle.
    let view = look(&scene, &world, beside, Side::Right).there;
    assert_eq!(view.ahead, Some(Ahead::steady(100.0 - CAR, 20.0)));
    assert_near(view.anticipated_speed, anticipated(200.0, 0.0));
    assert_near(view.route.remaining, 200.0);
}

#[test]
fn a_route_counts_the_changes_and_the_road_that_remains_for_them() {
    let mut world = drawn(Motorway { off_ramp_at: vec![2500.0], ..Motorway::default() });
    let ramp = world.network().exits.iter().position(|it| it.chains.len() == 1).unwrap() as u16;
    let mut route = |chain, x| {
        let new = Placement {
            chain: ChainIndex(chain),
            x,
            speed: 20.0,
            class: Class::Car,
            parameters: 0,
            destination: Some(ramp),
        };
        let id = world.place(new).expect("it fits on the road");
        let side = if chain == 2 { Side::Right } else { Side::Left };
        let scene = world.scene();
        let Situation { here, there, .. } = look(&scene, &world, id, side);
        [here, there].map(|it| (it.route.changes, (1000.0 * it.route.remaining).round() / 1000.0))
    };
    // Each further change takes 40 m of road before the last place of the one after it.
    assert_eq!(route(0, 2000.0), [(1, 500.0), (2, 460.0)]);
    assert_eq!(route(1, 2100.0), [(2, 360.0), (3, 320.0)]);
    assert_eq!(route(2, 2200.0), [(3, 220.0), (2, 260.0)]);
    // Beyond the last place there is no route any more.
    assert_eq!(route(0, 2470.0), [(1, 30.0), (Waypoint::NO_WAY, 0.0)]);
    assert_eq!(route(0, 2600.0), [(Waypoint::NO_WAY, 0.0), (Waypoint::NO_WAY, 0.0)]);
}

#[test]
fn followers_in_both_lanes_see_a_vehicle_that_changes_between_them() {
    let mut world = straight(2000.0);
    let (slow, fast) = (car(&mut world, 0, 240.0, 20.0), car(&mut world, 1, 210.0, 20.0));
    let chain = ChainIndex(0);
    let destination = Some(0);
    let changer = Placement { chain, x: 300.0, speed: 20.0, class: Class::Car, parameters: 1, destination };
    let changer = world.place(changer).expect("it fits on the road");
    let mut seen_from = std::collections::BTreeSet::new();
    for _ in 0..60 {
        world.step();
        let scene = world.scene();
        let at = spot(&world, changer);
        let (front, phase) = (scene.motion(at), scene.driver(at).phase);
        let [own, left] = [slow, fast].map(|id| (scene.motion(spot(&world, id)), spot(&world, id)));
        let acceleration = f64::from(front.acceleration);
        let gap_to = |it: &laneweave_sim::Kinematics| {
            Some(Ahead { gap: front.rear() - it.x, speed: front.speed, acceleration })
        };
        let from_slow = look(&scene, &world, slow, Side::Left);
        let from_fast = look(&scene, &world, fast, Side::Right);
        if phase == Phase::Changes {
            seen_from.insert(at.chain);
            assert_eq!((from_slow.here.ahead, from_slow.there.ahead), (gap_to(own.0), gap_to(own.0)));
            assert_eq!((from_fast.here.ahead, from_fast.there.behind.is_some()), (gap_to(left.0), false));
            // It counts as one vehicle in the means of each lane, and never as its own neighbour.
            let itself = scene.viewpoint(spot(&world, changer));
            assert_eq!(scene.ahead(itself), None);
            assert_eq!(from_slow.there.flow.spacing, 150.0);
        }
    }
    // Before and after its centre crossed the line.
    assert_eq!(seen_from.into_iter().collect::<Vec<_>>(), [ChainIndex(0), ChainIndex(1)]);
}

/// Drivers at 20 m/s on three lanes: one in the middle lane, and one beside it that waits to change there. The front
/// bumper of the waiting one is `forward` of the other [m]. Other drivers are given by lane and by distance ahead.
struct Waiting {
    world: World,
    me: u32,
    waiting: u32,
}

impl Waiting {
    fn new(lane: u32, forward: f64, others: &[(u32, f64)]) -> Waiting {
        let mut world = world(Road { lanes: 3, length: 1000.0, limit: 30.0, ..Road::default() }.network());
        let me = car(&mut world, 1, 500.0, 20.0);
        let (chain, destination) = (ChainIndex(lane), Some(0));
        let (x, class) = (500.0 + forward, Class::Car);
        let waiting = world
            .place(Placement { chain, x, speed: 20.0, class, parameters: 1, destination })
            .expect("it fits on the road");
        for (lane, ahead) in others {
            car(&mut world, *lane, 500.0 + ahead, 20.0);
        }
        // It wants to change at once, and has no space to do so.
        world.step();
        let phase = world.vehicles().find(|it| it.id() == waiting).expect("it is on the road").driver.phase;
        assert_eq!(phase, Phase::Wants);
        Waiting { world, me, waiting }
    }

    /// What the driver sees of merging vehicles if it left to `side`: on the other side, and on this one.
    fn seen(&self, side: Side) -> [Option<[Option<Ahead>; 2]>; 2] {
        let scene = self.world.scene();
        let merging = look(&scene, &self.world, self.me, side).merging;
        let speed = scene.motion(spot(&self.world, self.waiting)).speed;
        merging.map(|it| {
            it.map(|it| {
                assert_eq!((it.driver.pace.speed, it.urgency), (speed, 0.0));
                [it.blocked, it.freed]
            })
        })
    }

    /// What the waiting driver would have ahead if vehicle `id` were its leader, wherever both are.
    fn ahead(&self, id: u32) -> Option<Ahead> {
        let scene = self.world.scene();
        let [from, to] = [self.waiting, id].map(|it| scene.motion(spot(&self.world, it)));
        let acceleration = f64::from(to.acceleration);
        Some(Ahead { gap: to.rear() - from.x, speed: to.speed, acceleration })
    }
}

#[track_caller]
fn assert_ahead(found: Option<Ahead>, expected: Option<Ahead>) {
    let [found, expected] = [found, expected].map(|it| it.map_or((f64::NAN, 0.0), |it| (it.gap, it.speed)));
    assert_eq!(found.0.is_nan(), expected.0.is_nan());
    assert!(found.0.is_nan() || (found.0 - expected.0).abs() < 1e-9, "{found:?} is not {expected:?}");
    assert_eq!(found.1, expected.1);
}

#[test]
fn who_waits_behind_on_the_other_side_than_one_would_leave_to_follows_ones_leader_then() {
    let (leader, own_leader) = (2, 3);
    let scenery = [(1, 50.0), (0, 30.0)];
    // Behind, side by side, and ahead.
    for (forward, is_behind) in [(-6.0, true), (-2.0, false), (2.0, false), (6.0, false)] {
        let waiting = Waiting::new(0, forward, &scenery);
        let [across, near] = waiting.seen(Side::Left);
        let [blocked, freed] = across.expect("it is seen");
        assert_ahead(blocked, waiting.ahead(if is_behind { waiting.me } else { own_leader }));
        assert_ahead(freed, waiting.ahead(leader));
        assert!(near.is_none());
    }
    // On a free road.
    let waiting = Waiting::new(0, 2.0, &[]);
    assert_eq!(waiting.seen(Side::Left), [Some([None, None]), None]);
}

#[test]
fn on_the_side_that_one_would_leave_to_the_new_leader_may_merge_and_the_new_follower_is_just_that() {
    let waiting = Waiting::new(0, 2.0, &[(1, 50.0)]);
    let [across, near] = waiting.seen(Side::Right);
    assert!(across.is_none());
    assert_ahead(near.expect("it is seen")[1], waiting.ahead(2));
    assert_eq!(Waiting::new(0, -2.0, &[]).seen(Side::Right), [None, None]);
}

#[test]
fn room_is_made_only_for_those_who_signal_into_the_own_lane_with_nobody_between() {
    // Behind the driver's own follower, and beside its own leader.
    assert_eq!(Waiting::new(0, -12.0, &[(1, -10.0)]).seen(Side::Left), [None, None]);
    assert_eq!(Waiting::new(0, 12.0, &[(1, 10.0)]).seen(Side::Left), [None, None]);
    // A vehicle that keeps its lane does not merge.
    let mut world = world(Road { lanes: 3, length: 1000.0, limit: 30.0, ..Road::default() }.network());
    let me = car(&mut world, 1, 500.0, 20.0);
    car(&mut world, 0, 498.0, 20.0);
    let scene = world.scene();
    assert_eq!(look(&scene, &world, me, Side::Left).merging, [None; 2]);
}

#[test]
fn who_waits_at_the_end_of_its_lane_has_that_ahead_and_its_urgency() {
    let mut world = drawn(Motorway { lanes: 3, lane_drop_at: Some(2500.0), ..Motorway::default() });
    let merging = car(&mut world, 0, 2400.0, 20.0);
    let me = car(&mut world, 1, 2399.0, 20.0);
    let phase = |world: &World| world.vehicles().find(|it| it.id() == merging).unwrap().driver.phase;
    while phase(&world) != Phase::Wants {
        world.step();
    }
    let scene = world.scene();
    let seen = look(&scene, &world, me, Side::Left).merging[0].expect("it is seen");
    let end = Ahead::steady(2500.0 - scene.motion(spot(&world, merging)).x, 0.0);
    assert_ahead(seen.blocked, Some(end));
    // The desire arises at once, 100 m before the end at 20 m/s.
    assert!((seen.urgency - 0.883721).abs() < 1e-6, "{}", seen.urgency);
}
