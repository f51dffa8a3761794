//! Traffic on real maps of towns with short, curved lanes that are not parallel.

use std::collections::HashMap;

use laneweave_network::{Network, Pose};
use laneweave_sim::{Setup, VehicleId, World};

use crate::roads::{drivers, real};

/// Length of a step [s].
const STEP: f64 = 0.1;

fn world(network: Network, total: f64, trucks: f64) -> World {
    let demand = drivers::demand(&network, total, trucks, &[0.5, 0.5]);
    let driver_parameters = vec![drivers::aggressive(), drivers::conservative()];
    World::new(network, driver_parameters, demand, Setup { step: STEP, seed: 2, threads: 1 })
        .expect("it makes sense")
}

#[test]
fn few_drivers_miss_their_turns_where_lanes_begin_and_end_at_junctions() {
    for file in ["karlsruhe_roundabout.osm", "intersection.osm"] {
        let Some((network, _)) = real(file) else { continue };
        let mut world = world(network, 1500.0, 0.1);
        (0..4800).for_each(|_| world.step());
        let (missed, counts) = (world.counters().missed_turns, world.counts());
        assert!(counts.discretionary_changes + counts.route_changes > 0, "{file}");
        assert!(missed as f64 <= 0.02 * counts.entered as f64, "{file}: {missed} of {}", counts.entered);
    }
}

#[test]
fn bodies_move_no_further_than_their_vehicles_drive() {
    /// A body that turns or changes lanes moves farther than its front along the lane, by at most this [m].
    const TURNING: f64 = 0.3;
    const HARDEST_BRAKING: f64 = 8.0;
    for (file, total) in [("karlsruhe.osm", 1500.0), ("kashiwanoha.osm", 600.0)] {
        let Some((network, _)) = real(file) else { continue };
        let mut world = world(network, total, 0.3);
        let mut before: HashMap<VehicleId, (Pose, f64)> = HashMap::new();
        for _ in 0..2400 {
            world.step();
            let now: HashMap<VehicleId, (Pose, f64)> =
                world.vehicles().map(|it| (it.id(), (it.pose(), it.speed()))).collect();
            for (id, (pose, speed)) in &now {
                let Some((was, old_speed)) = before.get(id) else { continue };
                let driven = speed.max(*old_speed) * STEP + 0.5 * HARDEST_BRAKING * STEP * STEP;
                let moved = pose.at.distance(&was.at);
                assert!(moved < driven + TURNING, "{file}: {id} moved {moved} m at {speed} m/s");
            }
            before = now;
        }
        assert!(world.counts().left > 10, "{file}: {} left", world.counts().left);
    }
}
