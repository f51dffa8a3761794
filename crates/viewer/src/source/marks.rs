//! Marks: what happened, with its place on the map.

use laneweave::network::Network;
use laneweave::{Event, Occurrence, VehicleId};

use super::{Mark, MarkKind};

/// The mark of an event, if pages show one.
pub(super) fn mark(event: &Event, network: &Network) -> Option<Mark> {
    match event {
        Event::LaneChange(change) if change.is_completed => {
            let mark = at(MarkKind::LaneChange, change.time_s, change.vehicle, [change.x_m, change.y_m]);
            Some(Mark { side: Some(change.side.name()), text: Some(change.kind.name()), ..mark })
        }
        Event::Incident(incident) => {
            let [vehicle, other] = incident.vehicles;
            let mark = at(MarkKind::Collision, incident.time_s, vehicle, [incident.x_m, incident.y_m]);
            Some(Mark { other: Some(other.to_string()), ..mark })
        }
        Event::EmergencyBraking(it) => happened(MarkKind::EmergencyBraking, it, network),
        Event::MissedTurn(it) => happened(MarkKind::MissedTurn, it, network),
        _ => None,
    }
}

fn happened(kind: MarkKind, it: &Occurrence, network: &Network) -> Option<Mark> {
    let lanelet = &network.lanelets[network.lanelet_with(it.lanelet)?.at()];
    let place = lanelet.centre.at(it.position_m);
    Some(at(kind, it.time_s, it.vehicle, [place.x, place.y]))
}

fn at(kind: MarkKind, time_s: f64, vehicle: VehicleId, place: [f64; 2]) -> Mark {
    let [x, y] = place.map(round);
    Mark { kind, time_s, x, y, vehicle: vehicle.to_string(), other: None, side: None, text: None }
}

/// Coordinates of marks are told to a centimetre.
fn round(metres: f64) -> f64 {
    (metres * 100.0).round() / 100.0
}
