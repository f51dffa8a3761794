//! What happened in a step.

use laneweave_models::change::Appraisal;
use laneweave_network::{ChainIndex, Position, Side};
use serde::{Deserialize, Serialize};

use crate::record::incidents::Incident;
use crate::record::trip_log::TripRecord;
use crate::state::lane::{Kind, Kinematics, VehicleId};

/// Something that happened in a step.
#[derive(Clone, Debug, PartialEq)]
pub enum Event {
    /// A vehicle entered.
    Entered(VehicleId),
    /// A vehicle left the map after `duration` [s] on it.
    Left {
        /// Who.
        vehicle: VehicleId,
        /// Its time on the map [s].
        duration: f64,
        /// Its last chain.
        chain: ChainIndex,
        /// How it moved in its last step, which may have ended beyond the chain.
        motion: Kinematics,
        /// The record of its trip, where trips are recorded.
        trip: Option<TripRecord>,
    },
    /// A lane change is completed, or was aborted.
    LaneChange(LaneChange),
    /// Two vehicles came to touch each other.
    Incident(Incident),
    /// Something happened to one vehicle on its way.
    Driving(DrivingEvent),
}

/// Something that happens to one vehicle on its way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrivingEvent {
    /// What.
    pub kind: DrivingEventKind,
    /// To whom.
    pub vehicle: VehicleId,
    /// When [s].
    pub time: f64,
    /// Where: its front bumper.
    pub at: Position,
}

/// What happens to a vehicle on its way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DrivingEventKind {
    /// It begins to brake as kinematics, not its model, demands.
    EmergencyBraking,
    /// It came to a halt.
    Halt,
    /// It drives on after it stood.
    SetOff {
        /// For how long it stood [s].
        stood: f32,
    },
    /// Its driver missed a turn, and takes another route if there is one.
    MissedTurn,
    /// Its driver left its route for a better one.
    RouteChange,
}

impl DrivingEventKind {
    /// The order in which a vehicle's events of one step are told.
    pub(crate) fn rank(self) -> u8 {
        match self {
            DrivingEventKind::EmergencyBraking => 0,
            DrivingEventKind::Halt => 1,
            DrivingEventKind::SetOff { .. } => 2,
            DrivingEventKind::MissedTurn => 3,
            DrivingEventKind::RouteChange => 4,
        }
    }
}

/// A lane change, with the reasons for it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LaneChange {
    /// Who.
    pub vehicle: VehicleId,
    /// Its driver parameters' place in the table.
    pub parameters: u32,
    /// Its class.
    pub class: crate::state::vehicle::Class,
    /// Time when the lateral motion began [s].
    pub started: f64,
    /// Time when the centre crossed the line, or the change was called off [s].
    pub time: f64,
    /// Time from begin to end of the lateral motion [s].
    pub duration: f64,
    /// Where from: its front bumper.
    pub from: Position,
    /// Where to.
    pub to: Position,
    /// To which side.
    pub side: Side,
    /// Why.
    pub kind: Kind,
    /// Speed at the crossing [m/s].
    pub speed: f64,
    /// Anticipated gain of speed when the desire came [m/s].
    pub speed_gain: f64,
    /// What the driver made of it when the desire came.
    pub appraisal: Appraisal,
    /// Gap to the new leader at the start [m].
    pub gap_ahead: f64,
    /// Gap to the new follower at the start [m].
    pub gap_behind: f64,
    /// Time to collision with the new leader at the start [s].
    pub ttc_ahead: f64,
    /// Time to collision of the new follower at the start [s].
    pub ttc_behind: f64,
    /// It was carried out; otherwise it was aborted.
    pub is_completed: bool,
}
