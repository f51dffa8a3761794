//! The first collision or overlap of a run.

use laneweave_network::{Id, Network};
use laneweave_sim::{Incident, VehicleId};
use laneweave_study::seconds;
use serde::Serialize;

/// The first incident of a run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct FirstIncident {
    /// When it was detected [s].
    pub time_s: f64,
    /// `collision` or `overlap`.
    pub kind: &'static str,
    /// The lanelet of the first of the two vehicles.
    pub lanelet: Id,
    /// Both vehicles, the smaller id first.
    pub vehicles: [VehicleId; 2],
}

impl FirstIncident {
    pub(super) fn of(network: &Network, incident: &Incident) -> FirstIncident {
        let &Incident { kind, time, vehicles, places: [at, _], .. } = incident;
        let lanelet = network.lanelet_at(at).0.id;
        FirstIncident { time_s: seconds(time), kind: kind.name(), lanelet, vehicles }
    }

    /// In words.
    pub fn to_text(&self) -> String {
        let FirstIncident { time_s, kind, lanelet, vehicles: [one, other] } = self;
        format!("{kind} at {time_s} s on lanelet {lanelet}, vehicles {one} and {other}")
    }
}
