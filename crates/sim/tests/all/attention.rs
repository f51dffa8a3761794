//! Inattentive drivers consider lanes less often, see less far, and see the lane beside as it was at their last turn.

use crate::roads::{Road, drivers};
use laneweave_generate::{Motorway, motorway};
use laneweave_models::change::{ConstantHazard, LaneChangeModel, Mcdm, Rule, Speed};
use laneweave_models::{Alertness, Attention, Style};
use laneweave_network::{ChainIndex, Network};
use laneweave_sim::{Class, Demand, Phase, Placement, Setup, VehicleId, World};

/// Length of a car [m].
const CAR: f64 = 4.5;

/// The style, of a driver who is always inattentive.
fn inattentive(style: Style, alertness: Alertness) -> Style {
    let attention =
        Attention { concentrated_for: 0.0, inattentive_for: 1.0, inattentive: alertness, ..style.attention };
    Style { attention, ..style }
}

fn world(network: Network, styles: Vec<Style>, demand: Demand) -> World {
    World::new(network, styles, demand, Setup { step: 0.1, seed: 1, threads: 1 }).expect("a world")
}

fn put(world: &mut World, chain: u32, x: f64, speed: f64, parameters: u32) -> VehicleId {
    let (chain, class, destination) = (ChainIndex(chain), Class::Car, Some(0));
    world.place(Placement { chain, x, speed, class, parameters, destination }).expect("it fits on the road")
}

/// The state of a driver that tests follow.
fn driver(world: &World, id: VehicleId) -> (Phase, u32, bool) {
    let vehicle = world.vehicles().find(|it| it.id() == id).expect("it is on the road");
    (vehicle.driver.phase, vehicle.driver.due, vehicle.driver.needs_full_update)
}

#[test]
fn the_inattentive_consider_lanes_every_two_seconds() {
    let network = Road { length: 5000.0, limit: 20.0, ..Road::default() }.network();
    let nobody = drivers::demand(&network, 0.0, 0.0, &[1.0]);
    let alone = |style| {
        let mut world = world(network.clone(), vec![style], nobody.clone());
        put(&mut world, 0, 10.0, 20.0, 0);
        (0..100).for_each(|_| world.step());
        world.reset_counts();
        (0..1000).for_each(|_| world.step());
        world.counters().considerations
    };
    for style in [drivers::conservative(), drivers::aggressive()] {
        assert_eq!(alone(style.clone()), 100);
        assert_eq!(alone(inattentive(style, Alertness::default())), 50);
    }
}

/// A driver who wants to change as soon as it sees any gain.
fn keen() -> Style {
    let change = LaneChangeModel::Mcdm(Mcdm {
        rule: Rule::Threshold,
        theta: 1e-6,
        speed: Speed { weight: 1.0, ..Speed::default() },
        ..Mcdm::default()
    });
    Style { change, ..drivers::conservative() }
}

#[test]
fn a_slow_leader_beyond_its_sight_is_no_reason_for_an_inattentive_driver() {
    /// Distance to a standing leader at which a driver at 30 m/s first wants to leave its lane [m].
    fn wants_from(style: Style) -> f64 {
        const LEADER: f64 = 1000.0;
        let network = Road { lanes: 2, length: 2000.0, limit: 30.0, ..Road::default() }.network();
        let nobody = drivers::demand(&network, 0.0, 0.0, &[1.0]);
        let stays = LaneChangeModel::ConstantHazard(ConstantHazard { hazard: 0.0 });
        let stands = Style { speed_factor: 0.0001, change: stays, ..drivers::conservative() };
        let mut world = world(network, vec![style, stands], nobody);
        let me = put(&mut world, 0, 500.0, 30.0, 0);
        put(&mut world, 0, LEADER, 0.0, 1);
        loop {
            let x = world.vehicles().find(|it| it.id() == me).expect("it is on the road").x();
            if driver(&world, me).0 == Phase::Wants {
                return LEADER - CAR - x;
            }
            world.step();
        }
    }
    // Within the distance driven in one epoch and in the step in which the desire takes effect.
    let found = wants_from(keen());
    assert!((262.0..295.0).contains(&found), "{found}");
    for sight in [250.0, 150.0] {
        let found = wants_from(inattentive(keen(), Alertness { sight, ..Alertness::default() }));
        assert!((sight - 63.0..sight).contains(&found), "{found} of {sight}");
    }
}

#[test]
fn a_wish_is_given_up_only_when_lanes_are_considered() {
    for style in [keen(), inattentive(keen(), Alertness::default())] {
        let epoch = if style.attention.inattentive_for > 0.0 { 20 } else { 10 };
        let network = Road { lanes: 2, length: 3000.0, ..Road::default() }.network();
        let demand = drivers::demand(&network, 2800.0, 0.15, &[1.0]);
        let mut world = world(network, vec![style], demand);
        let mut given_up = 0;
        for _ in 0..6000 {
            let step = world.clock().step;
            let before: Vec<_> =
                world.vehicles().map(|it| (it.id(), it.driver.phase, it.driver.due)).collect();
            world.step();
            for (id, _, due) in before.into_iter().filter(|(_, phase, _)| *phase == Phase::Wants) {
                let Some(now) = world.vehicles().find(|it| it.id() == id) else { continue };
                if now.driver.phase == Phase::Cruises {
                    assert!(due <= step, "{id} gives up at {step} and looks at {due}");
                    assert_eq!(now.driver.due, step + epoch);
                    given_up += 1;
                }
            }
        }
        assert!(given_up > 20, "{given_up}");
    }
}

#[test]
fn the_inattentive_let_in_whom_they_saw_when_they_last_looked() {
    /// Steps from the desire of a driver at the end of its lane until the follower beside makes space, and whether
    /// the follower considered lanes in between.
    fn let_in_after(follower: Style) -> (u32, bool) {
        let plan = Motorway { lanes: 2, lane_drop_at: Some(2500.0), length_m: 4000.0, ..Motorway::default() };
        let network = motorway(&plan).expect("a road").build().expect("a network").network;
        let nobody = drivers::demand(&network, 0.0, 0.0, &[1.0]);
        let mut world = world(network, vec![drivers::conservative(), follower], nobody);
        let merging = put(&mut world, 0, 2350.0, 20.0, 0);
        let beside = put(&mut world, 1, 2343.0, 20.0, 1);
        while driver(&world, merging).0 != Phase::Wants {
            world.step();
        }
        let (since, (_, due, _)) = (world.clock().step, driver(&world, beside));
        while !driver(&world, beside).2 {
            assert_eq!(driver(&world, merging).0, Phase::Wants);
            world.step();
        }
        (world.clock().step - since, world.clock().step > due)
    }
    assert_eq!(let_in_after(drivers::conservative()).0, 1);
    let (steps, has_looked) = let_in_after(inattentive(drivers::conservative(), Alertness::default()));
    assert!(steps > 1 && steps <= 21 && has_looked, "{steps} {has_looked}");
}
