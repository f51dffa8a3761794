//! The path of a lane change: smooth, only one vehicle into one gap, and back if it must be aborted.

use crate::roads::{Road, WIDTH, drivers};
use laneweave_models::Style;
use laneweave_models::change::{ConstantHazard, LaneChangeModel};
use laneweave_models::follow::{FollowingModel, Fvdm};
use laneweave_models::{Attention, Manner};
use laneweave_network::{ChainIndex, Network, Pose, Side};
use laneweave_sim::{Class, Destination, Event, LaneChange, Phase, Placement, Setup, World};

/// Length of a step, and of the epoch of drivers who are always ready to change [s].
const STEP: f64 = 0.1;

/// A driver who wants to change at once, wherever it may.
fn eager(style: Style) -> Style {
    let change = LaneChangeModel::ConstantHazard(ConstantHazard { hazard: 1.0 });
    Style { change, attention: Attention { epoch: STEP, ..Attention::default() }, ..style }
}

/// A driver who never wants to change.
fn steadfast(style: Style) -> Style {
    Style { change: LaneChangeModel::ConstantHazard(ConstantHazard { hazard: 0.0 }), ..style }
}

/// A driver who keeps its speed as long as kinematics allows.
fn unyielding(style: Style) -> Style {
    let follow = Fvdm { sensitivity: 0.0, relative_sensitivity: 0.0, ..Fvdm::default() };
    Style { follow: FollowingModel::Fvdm(follow), ..style }
}

fn world(network: Network, styles: Vec<Style>, threads: usize) -> World {
    let nobody = drivers::demand(&network, 0.0, 0.0, &[1.0]);
    World::new(network, styles, nobody, Setup { step: STEP, seed: 1, threads })
        .expect("the set-up makes sense")
}

fn put(world: &mut World, lane: u32, x: f64, speed: f64, class: Class, parameters: u32) {
    let destination: Destination = Some(0);
    world
        .place(Placement { chain: ChainIndex(lane), x, speed, class, parameters, destination })
        .expect("it fits on the road");
}

fn changes(world: &World) -> impl Iterator<Item = &LaneChange> {
    world.events().iter().filter_map(|event| match event {
        Event::LaneChange(change) => Some(change),
        _ => None,
    })
}

/// The path of a lane change seen from above, step by step.
struct Way {
    poses: Vec<Pose>,
    /// Lateral offset of the vehicle from the centre of the first lane, as the vehicle reports it [m].
    offsets: Vec<f64>,
    duration: f64,
}

/// One change of a single vehicle at `speed` [m/s] from `x` in lane `from` of two, up to a second after its end.
fn lonely_change(road: Road, from: u32, x: f64, class: Class, speed: f64) -> Way {
    let style = unyielding(eager(drivers::conservative()));
    let mut world = world(road.network(), vec![style], 1);
    put(&mut world, from, x, speed, class, 0);
    let (mut poses, mut offsets, mut duration, mut after) = (Vec::new(), Vec::new(), 0.0, 0);
    while after < 10 {
        let vehicle = world.vehicles().next().expect("it is on the road");
        let fast_side = if road.is_mirrored { -1.0 } else { 1.0 };
        // Chains are numbered row by row.
        let lanes_moved = f64::from(vehicle.spot.chain.0 % 2) - f64::from(from);
        poses.push(vehicle.pose());
        offsets.push(vehicle.lateral_offset() + fast_side * WIDTH * lanes_moved);
        world.step();
        duration = changes(&world).map(|it| it.duration).fold(duration, f64::max);
        after += usize::from(duration > 0.0);
    }
    Way { poses, offsets, duration }
}

#[test]
fn v46_a_change_leads_smoothly_across_one_lane_and_back_to_its_heading() {
    for (from, side) in [(0, 1.0), (1, -1.0)] {
        for (class, speed) in [(Class::Car, 30.0), (Class::Car, 8.0), (Class::Truck, 22.0)] {
            for (is_mirrored, crosses_a_chain_end) in
                [(false, false), (true, false), (false, true), (true, true)]
            {
                // The road is so long that its lanes are cut into several chains.
                let road = Road { lanes: 2, length: 60_000.0, is_mirrored, ..Road::default() };
                let chain_end = road.network().chains[0].length;
                assert!(chain_end < road.length);
                let x = if crosses_a_chain_end { chain_end - 2.0 * speed } else { 30.0 };
                let side = if is_mirrored { -side } else { side };
                let way = lonely_change(road, from, x, class, speed);
                let (first, last) = (way.poses[0], way.poses[way.poses.len() - 1]);
                assert!((side * (last.at.y - first.at.y) - WIDTH).abs() < 1e-9);
                assert_eq!((first.heading, last.heading), (0.0, 0.0));
                for (pair, offsets) in way.poses.windows(2).zip(way.offsets.windows(2)) {
                    let aside = side * (pair[1].at.y - pair[0].at.y);
                    // It never moves back, and nowhere faster than the quintic in the duration of this change allows.
                    let fastest = 15.0 / 8.0 * WIDTH / way.duration * STEP;
                    assert!((-1e-9..1.35 * fastest).contains(&aside), "{aside} m in a step");
                    assert!((side * (offsets[1] - offsets[0]) - aside).abs() < 1e-6);
                    assert!(((pair[1].at.x - pair[0].at.x) - speed * STEP).abs() < 0.05);
                    assert!(pair[1].heading * side >= -1e-9);
                }
            }
        }
    }
}

#[test]
fn v46_a_fast_change_takes_four_seconds_and_a_slow_one_as_long_as_it_needs_way() {
    let road = Road { lanes: 2, ..Road::default() };
    let duration = |class, speed| lonely_change(road, 0, 30.0, class, speed).duration;
    assert!((duration(Class::Car, 30.0) - Manner::default().change_duration).abs() < 0.11);
    assert!((duration(Class::Car, 2.0) - 6.0).abs() < 0.11);
    assert!((duration(Class::Truck, 3.0) - 6.0).abs() < 0.11);
}

#[test]
fn v46_in_a_curve_a_change_leads_just_as_smoothly_onto_a_shorter_or_longer_lane() {
    const RADIUS: f64 = 120.0;
    for (from, inwards) in [(0, 1.0), (1, -1.0)] {
        for class in [Class::Car, Class::Truck] {
            for is_mirrored in [false, true] {
                let road = Road { lanes: 2, length: 500.0, radius: RADIUS, is_mirrored, ..Road::default() };
                let network = road.network();
                assert!(network.chains[0].length > network.chains[1].length + 10.0);
                let way = lonely_change(road, from, 30.0, class, 15.0);
                let centre_y = if is_mirrored { -RADIUS } else { RADIUS };
                let radii: Vec<f64> = way.poses.iter().map(|it| it.at.x.hypot(it.at.y - centre_y)).collect();
                let moved = inwards * (radii[0] - radii[radii.len() - 1]);
                assert!((moved - WIDTH).abs() < 0.02, "{moved} m");
                for (pair, radii) in way.poses.windows(2).zip(radii.windows(2)) {
                    // A chord of 2 m deviates from the arc by 4 mm.
                    assert!(inwards * (radii[0] - radii[1]) > -0.02);
                    let step = pair[0].at.distance(&pair[1].at);
                    // The front bumper moves without a jump. The centre moves by half the vehicle's length, seen from
                    // the centre of the curve.
                    assert!((step - 15.0 * STEP).abs() < 0.25, "{step} m in a step");
                }
            }
        }
    }
}

#[test]
fn v46_both_entries_of_a_vehicle_that_changes_drive_side_by_side() {
    for radius in [f64::INFINITY, 120.0] {
        let network = Road { lanes: 2, length: 500.0, radius, ..Road::default() }.network();
        let mut world = world(network, vec![eager(drivers::aggressive())], 1);
        put(&mut world, 0, 30.0, 15.0, Class::Car, 0);
        let mut steps = 0;
        for _ in 0..100 {
            world.step();
            let scene = world.scene();
            let entries = [0, 1].map(|chain| scene.lanes[chain].motions().first());
            if let [Some(slow), Some(fast)] = entries {
                steps += 1;
                assert_eq!(slow.speed.to_bits(), fast.speed.to_bits());
                let shadows = [0, 1].map(|chain| scene.lanes[chain].drivers()[0].is_shadow);
                assert_ne!(shadows[0], shadows[1]);
                let beside = scene.network.chains[0].beside(Side::Left, slow.x).unwrap();
                assert!((beside.across(slow.x) - fast.x).abs() < 0.02);
            }
        }
        assert!((35..=45).contains(&steps), "{steps} steps");
    }
}

/// Three lanes with a gap in the middle one, and a vehicle on each side of it that wants to change into it.
fn rivals(network: Network, first_lane: u32, threads: usize) -> World {
    let styles =
        vec![unyielding(eager(drivers::conservative())), steadfast(unyielding(drivers::aggressive()))];
    let is_reversed = !network.chains[0].right.is_empty();
    let lane = |number: u32| if is_reversed { 2 - number } else { number };
    let (one, other, middle) = (lane(first_lane), lane(2 - first_lane), lane(1));
    let mut world = world(network, styles, threads);
    for chain in [one, other] {
        put(&mut world, chain, 300.0, 20.0, Class::Car, 0);
    }
    put(&mut world, middle, 330.0, 20.0, Class::Car, 1);
    put(&mut world, middle, 270.0, 20.0, Class::Car, 1);
    world
}

#[test]
fn v47_of_two_who_aim_at_one_gap_exactly_one_enters() {
    let network = || Road { lanes: 3, ..Road::default() }.network();
    for first_lane in [0, 2] {
        let mut hashes = Vec::new();
        for (network, threads) in
            [(network(), 1), (network(), 2), (network(), 4), (network().with_chains_reversed(), 1)]
        {
            let mut world = rivals(network, first_lane, threads);
            let (mut both_wanted, mut entered) = (false, 0);
            // As long as the first vehicle is in its cooldown.
            for _ in 0..120 {
                world.step();
                let phase = |id| world.vehicles().find(|it| it.id() == id).map(|it| it.driver.phase);
                both_wanted |= phase(0) == Some(Phase::Wants) && phase(1) == Some(Phase::Wants);
                // They stay side by side, so the gap is never free for the second.
                assert_ne!(phase(1), Some(Phase::Changes));
                entered += changes(&world).filter(|it| it.vehicle == 0 && it.is_completed).count();
            }
            assert!(both_wanted && entered == 1);
            assert_eq!((world.counters().overlaps, world.counters().collisions), (0, 0));
            hashes.push(world.state_hash());
        }
        assert!(hashes.iter().all(|it| *it == hashes[0]));
    }
}

#[test]
fn v47_a_change_is_called_off_when_the_new_leader_brakes_hard_and_the_driver_returns() {
    let style = unyielding(eager(drivers::conservative()));
    let network = Road { lanes: 2, length: 1000.0, ..Road::default() }.network();
    let mut world = world(network, vec![style, steadfast(unyielding(drivers::conservative()))], 1);
    put(&mut world, 0, 100.0, 8.0, Class::Car, 0);
    // The leader brakes at 8 m/s² for a standing car as late as it can, when the change has just begun.
    put(&mut world, 1, 114.5, 5.0, Class::Car, 1);
    put(&mut world, 1, 124.0, 0.0, Class::Car, 1);
    let mut called_off = Vec::new();
    let mut furthest: f64 = 0.0;
    for _ in 0..100 {
        world.step();
        let vehicle = world.vehicles().find(|it| it.id() == 0).unwrap();
        if called_off.is_empty() {
            furthest = furthest.max(vehicle.lateral_offset());
            assert_eq!(vehicle.spot.chain, ChainIndex(0));
        }
        called_off.extend(changes(&world).copied());
    }
    assert_eq!(called_off.len(), 1);
    assert!(!called_off[0].is_completed);
    assert!(furthest > 0.1 && furthest < 0.5 * WIDTH, "{furthest} m");
    let vehicle = world.vehicles().find(|it| it.id() == 0).unwrap();
    assert_eq!((vehicle.spot.chain, vehicle.lateral_offset()), (ChainIndex(0), 0.0));
    assert_eq!(world.on_road(), 3);
    assert_eq!((world.counters().overlaps, world.counters().collisions), (0, 0));
}
