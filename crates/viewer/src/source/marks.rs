//! The marks of a world: what happened in its last step, with places on the map.

use laneweave::VehicleId;
use laneweave::network::{Network, Position};
use laneweave::sim::{DrivingEventKind, Event, World};

use super::{Mark, MarkKind};

/// Adds what happened in the last step of `world`.
pub(super) fn look(world: &World, marks: &mut Vec<Mark>) {
    let network = world.network();
    for event in world.events() {
        marks.extend(match event {
            Event::LaneChange(it) if it.is_completed => {
                let mark = at(network, MarkKind::LaneChange, it.time, it.vehicle, it.to);
                Some(Mark { side: Some(it.side.name()), text: Some(it.kind.name()), ..mark })
            }
            Event::Incident(it) => {
                let [vehicle, other] = it.vehicles.map(|it| it.to_string());
                let (kind, time_s) = (MarkKind::Collision, it.time);
                let [x, y] = [it.at.x, it.at.y].map(round);
                Some(Mark { kind, time_s, x, y, vehicle, other: Some(other), side: None, text: None })
            }
            Event::Driving(it) => match it.kind {
                DrivingEventKind::EmergencyBraking => Some(MarkKind::EmergencyBraking),
                DrivingEventKind::MissedTurn => Some(MarkKind::MissedTurn),
                _ => None,
            }
            .map(|kind| at(network, kind, it.time, it.vehicle, it.at)),
            _ => None,
        });
    }
}

fn at(network: &Network, kind: MarkKind, time: f64, vehicle: VehicleId, position: Position) -> Mark {
    let place = network.chain(position.chain).centre.at(position.x);
    let (x, y) = (round(place.x), round(place.y));
    Mark { kind, time_s: time, x, y, vehicle: vehicle.to_string(), other: None, side: None, text: None }
}

/// Coordinates of marks are told to a centimetre.
fn round(metres: f64) -> f64 {
    (metres * 100.0).round() / 100.0
}
