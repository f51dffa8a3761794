//! Collisions of a replay, by who is at fault.
//!
//! A recorded vehicle on its record does not react. So the collisions that it causes are told apart from those that
//! reactive drivers cause, and from those of vehicles that are handed over.

use std::collections::{BTreeMap, BTreeSet};

use laneweave::sim::Vehicle;
use laneweave::{Event, Incident, Simulation, VehicleId};
use laneweave_network::{ChainIndex, Position};
use laneweave_scenario::Played;
use serde::Serialize;

/// A vehicle that came into its lane from the side less than this before is at fault [s] (ours).
const JUST_CHANGED: f64 = 2.0;

/// Pairs of vehicles that touched each other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Collisions {
    /// A reactive driver ran into a recorded vehicle, or came into its lane too closely.
    pub by_reactive: usize,
    /// A recorded vehicle, which does not react, did that to a reactive driver.
    pub by_recorded: usize,
    /// Two reactive drivers.
    pub between_reactive: usize,
    /// A vehicle that was handed over, and anybody.
    pub of_handed_over: usize,
    /// Two recorded vehicles: their places or sizes are not exact.
    pub between_recorded: usize,
}

impl Collisions {
    /// All that would not have been without reactive drivers.
    pub(super) fn contacts(&self) -> usize {
        self.by_reactive + self.by_recorded + self.between_reactive + self.of_handed_over
    }
}

/// Watches for collisions.
#[derive(Default)]
pub(super) struct CollisionWatch {
    pub(super) collisions: Collisions,
    /// For each vehicle its chain, and the step in which it came into it from the side.
    lanes: BTreeMap<VehicleId, (ChainIndex, Option<u32>)>,
    /// The pairs that were counted.
    counted: BTreeSet<[VehicleId; 2]>,
}

impl CollisionWatch {
    /// Looks at the vehicles of the recording in `simulation`, and at what happened, once after each step.
    pub(super) fn observe(&mut self, simulation: &Simulation) {
        let now = simulation.clock().step;
        for played in simulation.played() {
            let Some(vehicle) = simulation.view(played.vehicle).filter(Vehicle::is_in_lane) else { continue };
            let chain = vehicle.spot.chain;
            let (lane, entered) = self.lanes.entry(played.vehicle).or_insert((chain, None));
            let before = std::mem::replace(lane, chain);
            if before != chain && !simulation.network().chain(before).following.contains(&chain) {
                *entered = Some(now);
            }
        }
        for event in simulation.events() {
            if let Event::Incident(incident) = event
                && self.counted.insert(incident.vehicles)
            {
                self.count(&incident, simulation);
            }
        }
    }

    fn count(&mut self, incident: &Incident, simulation: &Simulation) {
        let Some([a, b]) = both(incident.vehicles, simulation) else { return };
        let is_handed_over = |it: Played| it.is_handed_over && incident.vehicles.contains(&it.vehicle);
        let place = match [a, b].map(|it| it.is_on_its_own_path()) {
            _ if simulation.played().any(is_handed_over) => &mut self.collisions.of_handed_over,
            [true, true] => &mut self.collisions.between_recorded,
            [false, false] => &mut self.collisions.between_reactive,
            [a_is_recorded, _] => {
                let [reactive, recorded] = if a_is_recorded { [b, a] } else { [a, b] };
                if self.is_at_fault(&reactive, &recorded, simulation) {
                    &mut self.collisions.by_reactive
                } else {
                    &mut self.collisions.by_recorded
                }
            }
        };
        *place += 1;
    }

    /// Whether the first of two vehicles that touch is at fault: it alone changes lanes or has just done so; otherwise
    /// it is behind the other.
    fn is_at_fault(&self, one: &Vehicle, other: &Vehicle, simulation: &Simulation) -> bool {
        match [one, other].map(|it| self.changes_lanes(it, simulation)) {
            [true, false] => true,
            [false, true] => false,
            _ => {
                let [here, there] = [one.pose(), other.pose()];
                let (dx, dy) = (there.at.x - here.at.x, there.at.y - here.at.y);
                dx * here.heading.cos() + dy * here.heading.sin() > 0.0
            }
        }
    }

    fn changes_lanes(&self, vehicle: &Vehicle, simulation: &Simulation) -> bool {
        let entered = self.lanes.get(&vehicle.id()).and_then(|it| it.1);
        let has_just = entered
            .is_some_and(|it| f64::from(simulation.clock().step - it) * simulation.step_s() <= JUST_CHANGED);
        let is_over_the_line = || {
            let at = Position::new(vehicle.spot.chain, vehicle.x());
            let (lanelet, along) = simulation.network().lanelet_at(at);
            let [_, width] = vehicle.size();
            vehicle.lateral_offset().abs() + 0.5 * width > 0.5 * lanelet.width(along)
        };
        has_just || vehicle.driver.phase.is_between_lanes() || is_over_the_line()
    }
}

fn both(ids: [VehicleId; 2], simulation: &Simulation) -> Option<[Vehicle<'_>; 2]> {
    Some([simulation.view(ids[0])?, simulation.view(ids[1])?])
}
