//! What a driver perceives of a scene placed by hand is what one can compute by hand.

mod roads;

use laneweave_maps::generate::{Motorway, motorway};
use laneweave_models::Attention;
use laneweave_models::Style;
use laneweave_models::change::{ConstantHazard, LaneChangeModel, Situation};
use laneweave_models::follow::Ahead;
use laneweave_network::{ChainIndex, Network, Side};
use laneweave_sim::{Class, NewVehicle, Phase, Scene, Setup, Spot, Waypoint, World, perceive};
use roads::{Road, drivers};

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

/// Drivers who want 30 m/s: number 0 as usual, number 1 wants to change wherever it may.
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
    world.place(NewVehicle { chain, x, speed, class, character: 0, destination })
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

/// Speed anticipated behind one leader [m/s].
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
    let Situation { me, here, there, section, merging } = look(&scene, &world, me, Side::Left);
    assert_eq!((me.pace.speed, me.pace.desired, me.pace.tightness, me.length), (20.0, 30.0, 1.0, CAR));
    assert_eq!(here.ahead, Some(Ahead { gap: 60.0 - CAR, speed: 18.0 }));
    assert_eq!(there.ahead, Some(Ahead { gap: 200.0 - TRUCK, speed: 22.0 }));
    let behind = here.behind.unwrap();
    assert_eq!((behind.gap, behind.driver.pace.speed), (40.0 - CAR, 22.0));
    let behind = there.behind.unwrap();
    assert_eq!((behind.gap, behind.driver.pace.speed, behind.driver.length), (0.5, 25.0, CAR));
    assert_eq!((here.flow.spacing, here.flow.length), (100.0, CAR));
    assert_near(here.flow.speed, 50.0 / 3.0);
    assert_eq!((there.flow.spacing, there.flow.speed, there.flow.length), (150.0, 23.5, (CAR + TRUCK) / 2.0));
    // The second leader holds up more than the first.
    assert_near(here.prospect, anticipated(150.0 - CAR, 10.0));
    assert_near(there.prospect, anticipated(200.0 - TRUCK, 22.0));
    assert_eq!((here.route.changes, there.route.changes), (0, 0));
    assert_eq!((here.route.remaining, section), (f64::INFINITY, SIGHT));
    assert_near(here.route.onward, (500.0 - SIGHT) / 30.0);
    assert!(merging.is_none() && here.route.alternative.is_none());
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
            assert_eq!((lane.ahead, lane.behind, lane.prospect), (None, None, 30.0));
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
    // So long that its lanes are cut into several chains.
    let mut world = straight(60_000.0);
    let chain_ends = world.network().chain(ChainIndex(0)).length;
    let [next, next_left] = [0, 1].map(|chain| world.network().chain(ChainIndex(chain)).following[0].0);
    let before = car(&mut world, 0, chain_ends - 50.0, 20.0);
    let beyond = car(&mut world, next, 30.0, 16.0);
    car(&mut world, next_left, 60.0, 25.0);
    let scene = world.scene();
    let back = look(&scene, &world, before, Side::Left);
    assert_eq!(back.here.ahead, Some(Ahead { gap: 80.0 - CAR, speed: 16.0 }));
    assert_eq!(back.there.ahead, Some(Ahead { gap: 110.0 - CAR, speed: 25.0 }));
    assert_near(back.here.prospect, anticipated(80.0 - CAR, 16.0));
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
    assert_near(here.prospect, anticipated(100.0, 0.0));
    assert_near(here.flow.spacing, 200.0);
    assert_eq!((here.route.changes, there.route.changes), (1, 0));
    assert_near(here.route.remaining, 100.0);
    assert_near(section, 100.0);
    // The neighbour sees the end, too, behind the one who is nearer.
    let view = look(&scene, &world, beside, Side::Right).there;
    assert_eq!(view.ahead, Some(Ahead { gap: 100.0 - CAR, speed: 20.0 }));
    assert_near(view.prospect, anticipated(200.0, 0.0));
    assert_near(view.route.remaining, 200.0);
}

#[test]
fn a_route_counts_the_changes_and_the_road_that_remains_for_them() {
    let mut world = drawn(Motorway { off_ramp_at: vec![2500.0], ..Motorway::default() });
    let ramp = world.network().exits.iter().position(|it| it.chains.len() == 1).unwrap() as u16;
    let mut route = |chain, x| {
        let new = NewVehicle {
            chain: ChainIndex(chain),
            x,
            speed: 20.0,
            class: Class::Car,
            character: 0,
            destination: Some(ramp),
        };
        let id = world.place(new);
        let side = if chain == 2 { Side::Right } else { Side::Left };
        let scene = world.scene();
        let Situation { here, there, .. } = look(&scene, &world, id, side);
        [here, there].map(|it| (it.route.changes, (1000.0 * it.route.remaining).round() / 1000.0))
    };
    // Each further change takes 40 m of road from the one before.
    assert_eq!(route(0, 2000.0), [(1, 500.0), (2, 460.0)]);
    assert_eq!(route(1, 2100.0), [(2, 360.0), (3, 320.0)]);
    assert_eq!(route(2, 2200.0), [(3, 220.0), (2, 260.0)]);
    // Beyond the last place there is no way any more.
    assert_eq!(route(0, 2470.0), [(1, 30.0), (Waypoint::NO_WAY, 0.0)]);
    assert_eq!(route(0, 2600.0), [(Waypoint::NO_WAY, 0.0), (Waypoint::NO_WAY, 0.0)]);
}

#[test]
fn followers_in_both_lanes_see_a_vehicle_that_changes_between_them() {
    let mut world = straight(2000.0);
    let (slow, fast) = (car(&mut world, 0, 240.0, 20.0), car(&mut world, 1, 210.0, 20.0));
    let chain = ChainIndex(0);
    let destination = Some(0);
    let changer = NewVehicle { chain, x: 300.0, speed: 20.0, class: Class::Car, character: 1, destination };
    let changer = world.place(changer);
    let mut seen_from = std::collections::BTreeSet::new();
    for _ in 0..60 {
        world.step();
        let scene = world.scene();
        let at = spot(&world, changer);
        let (front, phase) = (scene.motion(at), scene.car(at).phase);
        let [own, left] = [slow, fast].map(|id| (scene.motion(spot(&world, id)), spot(&world, id)));
        let gap_to =
            |it: &laneweave_sim::Motion| Some(Ahead { gap: front.rear() - it.x, speed: front.speed });
        let from_slow = look(&scene, &world, slow, Side::Left);
        let from_fast = look(&scene, &world, fast, Side::Right);
        if phase == Phase::Changes {
            seen_from.insert(at.chain);
            assert_eq!((from_slow.here.ahead, from_slow.there.ahead), (gap_to(own.0), gap_to(own.0)));
            assert_eq!((from_fast.here.ahead, from_fast.there.behind.is_some()), (gap_to(left.0), false));
            // It is one vehicle in each lane's means, and never its own neighbour.
            let itself = scene.viewpoint(spot(&world, changer));
            assert_eq!(scene.ahead(itself), None);
            assert_eq!(from_slow.there.flow.spacing, 150.0);
        }
    }
    // Before and after its centre crossed the line.
    assert_eq!(seen_from.into_iter().collect::<Vec<_>>(), [ChainIndex(0), ChainIndex(1)]);
}
