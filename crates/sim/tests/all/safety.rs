//! No vehicle collides, overlaps, gets stuck or drives backwards, on random roads and at ramps.

use std::collections::BTreeMap;

use crate::roads::{Road, drivers};
use laneweave_generate::{Motorway, motorway};
use laneweave_models::Reading;
use laneweave_models::Style;
use laneweave_models::follow::{
    Acc, FollowingModel, Fvdm, Gfm, GfmForm, Gipps, Idm, IdmPlus, Krauss, Newell, Ovm,
};
use laneweave_network::{ChainIndex, Network};
use laneweave_sim::{Class, Placement, Setup, World};
use proptest::prelude::*;

/// Hardest braking of any vehicle [m/s²].
const HARDEST_BRAKING: f32 = 8.0;

fn world(network: Network, total: f64, trucks: f64, aggressive: f64, setup: Setup) -> World {
    let demand = drivers::demand(&network, total, trucks, &[aggressive, 1.0 - aggressive]);
    World::new(network, vec![drivers::aggressive(), drivers::conservative()], demand, setup)
        .expect("the set-up makes sense")
}

/// A random straight road, or a motorway with random ramps and a random end of a lane.
fn any_road() -> impl Strategy<Value = Network> {
    let straight = (1_usize..5, 8.0..45.0_f64)
        .prop_map(|(lanes, limit)| Road { lanes, length: 1500.0, limit, ..Road::default() }.network());
    let at = |from: f64| proptest::option::of(from..from + 100.0);
    let with_ramps = (2_usize..5, 40.0..150.0_f64, at(300.0), at(1050.0), at(1400.0)).prop_map(
        |(lanes, speed_limit_kmh, on, off, lane_drop_at)| {
            let (on_ramp_at, off_ramp_at) = (on.into_iter().collect(), off.into_iter().collect());
            let length_m = 2000.0;
            let plan = Motorway {
                lanes,
                length_m,
                speed_limit_kmh,
                on_ramp_at,
                off_ramp_at,
                lane_drop_at,
                ..Motorway::default()
            };
            motorway(&plan).expect("the motorway is possible").build().expect("the drawing is sound").network
        },
    );
    prop_oneof![straight, with_ramps]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn v18_in_random_traffic_everybody_moves_as_vehicles_can(
        network in any_road(), load in 200.0..3000.0_f64, trucks in 0.0..0.5_f64,
        aggressive in 0.0..1.0_f64, step in 0.05..0.5_f64, seed in 0..u64::MAX,
    ) {
        let total = load * network.entrances.iter().map(|it| it.chains.len()).sum::<usize>() as f64;
        let mut world = world(network, total, trucks, aggressive, Setup { step, seed, threads: 1 });
        let mut places = BTreeMap::new();
        for _ in 0..(240.0 / step) as u32 {
            world.step();
            let scene = world.scene();
            for lane in scene.lanes {
                for pair in lane.motions().windows(2) {
                    prop_assert!(pair[1].rear() > pair[0].x, "{} touches {}", pair[0].id, pair[1].id);
                }
            }
            let mut now = BTreeMap::new();
            for vehicle in world.vehicles() {
                let (motion, chain) = (vehicle.motion, vehicle.spot.chain);
                prop_assert!(motion.x.is_finite() && motion.speed.is_finite() && motion.acceleration.is_finite());
                prop_assert!(motion.speed >= 0.0);
                prop_assert!(motion.acceleration >= -HARDEST_BRAKING - 1e-4, "{} m/s²", motion.acceleration);
                prop_assert!(f64::from(motion.acceleration) <= vehicle.driver.class.body().strength);
                if let Some(before) = places.get(&(motion.id, chain)) {
                    prop_assert!(motion.x >= *before, "{} went back", motion.id);
                    prop_assert!(motion.x - before <= (motion.speed + 8.0 * step) * step + 1e-6);
                }
                now.insert((motion.id, chain), motion.x);
            }
            places = now;
        }
        prop_assert_eq!((world.counters().collisions, world.counters().overlaps, world.counters().stuck), (0, 0, 0));
        prop_assert!(world.counts().left > 0);
    }
}

/// Ten minutes at a bottleneck: no incidents, and hardly any missed turns or emergency braking.
fn ten_minutes(plan: &Motorway, total: f64) {
    for aggressive in [0.12, 1.0] {
        let network =
            motorway(plan).expect("the motorway is possible").build().expect("the drawing is sound").network;
        let mut world = world(network, total, 0.1, aggressive, Setup { step: 0.1, seed: 1, threads: 1 });
        (0..6000).for_each(|_| world.step());
        let (counters, counts) = (world.counters(), world.counts());
        let hundreds_of_km = counters.distance / 1e5;
        assert!(counts.left > 100 && counts.route_changes > 20);
        assert_eq!(
            (counters.collisions, counters.overlaps, counters.stuck),
            (0, 0, 0),
            "share of FVDM {aggressive}"
        );
        assert!(
            counters.missed_turns as f64 <= 0.02 * counts.entered as f64,
            "{} missed",
            counters.missed_turns
        );
        let emergencies = counters.emergency_brakings as f64 / hundreds_of_km;
        assert!(emergencies <= 1.0, "{emergencies} emergencies on 100 veh-km");
    }
}

/// Every car-following model with its defaults, and in the literal reading where it has one.
fn all_models() -> Vec<FollowingModel> {
    let reading = Reading::Literal;
    let jiang = Gfm { form: GfmForm::Jiang, ..Gfm::default() };
    vec![
        FollowingModel::Idm(Idm::default()),
        FollowingModel::Acc(Acc::default()),
        FollowingModel::Fvdm(Fvdm::default()),
        FollowingModel::Fvdm(Fvdm { reading, ..Fvdm::default() }),
        FollowingModel::Ovm(Ovm { jam_gap: 1.5, ..Ovm::default() }),
        FollowingModel::Ovm(Ovm { reading, ..Ovm::default() }),
        FollowingModel::Gfm(Gfm::default()),
        FollowingModel::Gfm(jiang),
        FollowingModel::Gfm(Gfm { reading, ..jiang }),
        FollowingModel::Krauss(Krauss::default()),
        FollowingModel::Gipps(Gipps::default()),
        FollowingModel::Newell(Newell::default()),
        FollowingModel::IdmPlus(IdmPlus::default()),
    ]
}

#[test]
fn whatever_model_they_follow_by_nobody_is_harmed_where_lanes_merge() {
    let plan = Motorway {
        length_m: 3000.0,
        on_ramp_at: vec![1000.0],
        lane_drop_at: Some(2200.0),
        ..Motorway::default()
    };
    for follow in all_models() {
        let network =
            motorway(&plan).expect("the motorway is possible").build().expect("the drawing is sound").network;
        let demand = drivers::demand(&network, 4000.0, 0.1, &[1.0]);
        let styles = vec![Style { follow, ..drivers::conservative() }];
        let setup = Setup { step: 0.1, seed: 1, threads: 1 };
        let mut world = World::new(network, styles, demand, setup).expect("the set-up makes sense");
        (0..4000).for_each(|_| world.step());
        let counters = world.counters();
        assert_eq!((counters.collisions, counters.overlaps, counters.stuck), (0, 0, 0), "{follow:?}");
        assert!(world.counts().left > 50 && world.counts().route_changes > 10, "{follow:?}");
    }
}

fn four_km() -> Motorway {
    Motorway { length_m: 4000.0, lanelet_length_m: 200.0, ..Motorway::default() }
}

#[test]
fn traffic_merges_at_an_on_ramp() {
    ten_minutes(&Motorway { on_ramp_at: vec![1500.0], ..four_km() }, 4000.0);
}

#[test]
fn traffic_leaves_at_an_off_ramp() {
    ten_minutes(&Motorway { off_ramp_at: vec![2500.0], ..four_km() }, 4000.0);
}

#[test]
fn traffic_leaves_a_lane_that_ends() {
    ten_minutes(&Motorway { lane_drop_at: Some(2500.0), ..four_km() }, 3000.0);
}

#[test]
fn a_driver_who_would_still_accelerate_when_kinematics_sets_in_is_counted_once() {
    let reckless = Idm { acceleration: 3.0, deceleration: 1e6, time_gap: 0.0, jam_gap: 0.1, exponent: 4.0 };
    let follower = Style { follow: FollowingModel::Idm(reckless), ..drivers::conservative() };
    let leader = Style { speed_factor: 0.2, ..drivers::conservative() };
    let network = Road { lanes: 1, length: 2000.0, ..Road::default() }.network();
    let demand = drivers::demand(&network, 0.0, 0.0, &[1.0]);
    let setup = Setup { step: 0.01, seed: 1, threads: 1 };
    let mut world =
        World::new(network, vec![follower, leader], demand, setup).expect("the set-up makes sense");
    for (parameters, x) in [(0, 20.0), (1, 120.0)] {
        let (chain, class, destination) = (ChainIndex(0), Class::Car, Some(0));
        world
            .place(Placement { chain, x, speed: 5.0, class, parameters, destination })
            .expect("it fits on the road");
    }
    (0..1500).for_each(|_| world.step());
    assert_eq!(world.counters().collisions, 0);
    assert_eq!(world.counters().emergency_brakings, 1);
}
