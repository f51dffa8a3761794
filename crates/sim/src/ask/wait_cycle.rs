//! Who waits for whom in a circle.

use crate::ask::standing::{JunctionHindrance, StandsFor, stands_for};
use crate::state::lane::VehicleId;
use crate::state::standstill::STANDS;
use crate::step::world::World;
use crate::view::scene::Spot;

/// Largest number of vehicles that are asked for whom they wait.
const MOST_ASKED: usize = 1000;

/// Vehicles that stand and wait for each other, each for the next and the last for the first, as far as the vehicle at
/// `spot` waits for them; empty if there is no such circle.
pub fn wait_cycle(world: &World, spot: Spot) -> Vec<VehicleId> {
    let first = world.scene().motion(spot).id;
    // The way to each vehicle, with those for whom the vehicles on it wait and that are still to be followed.
    let (mut way, mut open, mut asked) = (vec![first], vec![waits_for(world, spot)], vec![first]);
    while let Some(others) = open.last_mut() {
        let Some(next) = others.pop() else {
            way.pop();
            open.pop();
            continue;
        };
        if let Some(start) = way.iter().position(|it| *it == next) {
            return way.split_off(start);
        }
        let stands = world.vehicle(next).filter(|it| it.is_in_lane() && it.speed() < STANDS);
        if let Some(vehicle) = stands.filter(|_| !asked.contains(&next) && asked.len() < MOST_ASKED) {
            way.push(next);
            asked.push(next);
            open.push(waits_for(world, vehicle.spot));
        }
    }
    Vec::new()
}

/// The vehicles for which the vehicle at `spot` waits.
fn waits_for(world: &World, spot: Spot) -> Vec<VehicleId> {
    match stands_for(world, spot) {
        StandsFor::Leader { vehicle, .. } | StandsFor::Obstacle { vehicle, .. } => vec![vehicle],
        StandsFor::After(others) => others,
        StandsFor::Junction { why: JunctionHindrance::Others, others, .. } => others,
        // The one behind which it would stand.
        StandsFor::Junction { why: JunctionHindrance::Space | JunctionHindrance::Roundabout, .. } => {
            let scene = world.scene();
            let leader = scene.leader_spot(scene.viewpoint(spot));
            leader.map(|it| scene.motion(it).id).into_iter().collect()
        }
        _ => Vec::new(),
    }
}
