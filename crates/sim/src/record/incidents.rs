//! Incidents: two vehicles come to touch each other. Each is told once, for as long as they do.

use laneweave_network::{Point, Position};
use serde::{Deserialize, Serialize};

use crate::state::lane::VehicleId;
use crate::state::vehicle::Class;

/// Two vehicles whose rectangles come to intersect by more than 5 cm.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Incident {
    /// What it is.
    pub kind: IncidentKind,
    /// When it was seen [s].
    pub time: f64,
    /// Who, the smaller id first.
    pub vehicles: [VehicleId; 2],
    /// Their driver parameters' places in the table.
    pub driver_parameters: [u32; 2],
    /// Their classes.
    pub classes: [Class; 2],
    /// The front bumper of each.
    pub places: [Position; 2],
    /// Halfway between their centres.
    pub at: Point,
    /// Their speeds [m/s].
    pub speeds: [f64; 2],
    /// How deep they intersect [m].
    pub depth: f64,
}

/// Kinds of incidents.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum IncidentKind {
    /// One touches the other on its way, or they meet while they come closer to each other.
    Collision,
    /// Any other.
    Overlap,
}

impl IncidentKind {
    /// Its name in tables.
    pub fn name(self) -> &'static str {
        match self {
            IncidentKind::Collision => "collision",
            IncidentKind::Overlap => "overlap",
        }
    }
}

/// The pairs of vehicles that touched when it was last looked.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Touching(pub(crate) Vec<[VehicleId; 2]>);
