//! Incidents: two vehicles begin to touch each other. Each is reported once, for as long as they touch.

use laneweave_network::{Point, Position};
use serde::{Deserialize, Serialize};

use crate::state::lane::VehicleId;
use crate::state::vehicle::Class;

/// Two vehicles whose rectangles began to intersect by more than 5 cm.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Incident {
    /// Whether it is a collision or an overlap.
    pub kind: IncidentKind,
    /// Time when it was detected [s].
    pub time: f64,
    /// The vehicles, the smaller id first.
    pub vehicles: [VehicleId; 2],
    /// Indices of their drivers in the table of driver parameters.
    pub driver_parameters: [u32; 2],
    /// Their classes.
    pub classes: [Class; 2],
    /// Positions of their front bumpers.
    pub places: [Position; 2],
    /// The point halfway between their centres.
    pub at: Point,
    /// Their speeds [m/s].
    pub speeds: [f64; 2],
    /// How deep they intersect [m].
    pub depth: f64,
}

/// Kinds of incidents.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum IncidentKind {
    /// One touches the vehicle ahead of it, or they overlap while they approach each other.
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

/// The pairs of vehicles that touched at the last check.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Touching(pub(crate) Vec<[VehicleId; 2]>);
