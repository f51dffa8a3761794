//! A snapshot of a world's vehicles shows its drivers the same as the world does.

use laneweave_generate::{Motorway, motorway};
use laneweave_models::change::{LaneView, Situation};
use laneweave_network::{Position, Side};
use laneweave_sim::{Across, Navigator, Seen, Setup, Snapshot, Spot, Vehicle, World, perceive};

use crate::roads::drivers;

/// A world of dense traffic on three lanes with ramps, after two minutes.
fn world() -> World {
    let (on_ramp_at, off_ramp_at) = (vec![500.0], vec![1500.0]);
    let road = Motorway { length_m: 2000.0, on_ramp_at, off_ramp_at, ..Motorway::default() };
    let network = motorway(&road).expect("it fits").build().expect("it has lanes").network;
    let demand = drivers::demand(&network, 4400.0, 0.1, &[1.0, 1.0]);
    let driver_parameters = vec![drivers::aggressive(), drivers::conservative()];
    let setup = Setup { step: 0.1, seed: 3, threads: 1 };
    let mut world = World::new(network, driver_parameters, demand, setup).expect("the set-up makes sense");
    (0..1200).for_each(|_| world.step());
    world
}

fn seen(vehicle: &Vehicle) -> Seen {
    let Vehicle { spot, motion, driver, lane_change, .. } = vehicle;
    let other = lane_change.counterpart.filter(|_| driver.phase.is_between_lanes());
    Seen {
        id: motion.id,
        chain: spot.chain,
        x: motion.x,
        speed: motion.speed,
        acceleration: f64::from(motion.acceleration),
        length: f64::from(motion.length),
        class: driver.class,
        parameters: driver.parameters,
        desired: f64::from(driver.desired),
        destination: driver.goal.destination(),
        change: other.map(|counterpart| Across {
            side: lane_change.side,
            progress: f64::from(lane_change.progress),
            other: Position::new(counterpart.chain, counterpart.x),
        }),
    }
}

/// All that a camera can see of a situation, to the last bit.
fn visible(situation: &Situation) -> String {
    let Situation { me, here, there, section, .. } = situation;
    let lane = |it: &LaneView| {
        let behind = it.behind.map(|it| (it.gap, it.driver.pace.speed, it.driver.length));
        format!("{:?} {behind:?} {:?} {:?} {:?}", it.ahead, it.flow, it.anticipated_speed, it.route)
    };
    format!("{section:?} {:?} {:?} {} {}", me.pace.speed, me.pace.desired, lane(here), lane(there))
}

#[test]
fn drivers_see_the_same_in_a_world_and_in_a_snapshot_of_it() {
    let world = world();
    let scene = world.scene();
    let vehicles: Vec<Vehicle> = world.vehicles().collect();
    let navigator = Navigator::new(world.network());
    // The order of the vehicles does not matter.
    let snapshot = Snapshot::new(world.network(), vehicles.iter().rev().map(seen));
    let again = snapshot.scene(world.network(), &navigator, scene.driver_parameters);
    assert_eq!(snapshot.spots().len(), vehicles.len());
    let (mut situations, mut between_lanes) = (0, 0);
    for vehicle in &vehicles {
        between_lanes += usize::from(vehicle.driver.phase.is_between_lanes());
        let spot = snapshot.spot(vehicle.id()).expect("it is there");
        assert_eq!(again.motion(spot).x, vehicle.x());
        for side in Side::BOTH {
            let known = perceive(&scene, vehicle.spot, side);
            let seen = perceive(&again, spot, side);
            let plain = |it: Option<Situation>| it.as_ref().map(visible);
            let is_known = known.is_some();
            assert_eq!(plain(seen), plain(known), "vehicle {}", vehicle.id());
            situations += usize::from(is_known);
        }
    }
    assert!(situations > 100 && between_lanes > 3, "{situations} {between_lanes}");
}

#[test]
fn a_snapshot_has_nobody_who_was_not_seen() {
    let world = world();
    let snapshot = Snapshot::new(world.network(), []);
    assert_eq!((snapshot.spot(0), snapshot.spots().len()), (None::<Spot>, 0));
}
