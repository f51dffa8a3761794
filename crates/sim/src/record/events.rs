//! What happened in a step.

use laneweave_models::change::Appraisal;
use laneweave_network::{ChainIndex, Position, Side};
use serde::{Deserialize, Serialize};

use crate::record::incidents::Incident;
use crate::record::trip_log::TripRecord;
use crate::state::lane::{Kinematics, LaneChangeKind, VehicleId};

/// Something that happened in a step.
#[derive(Clone, Debug, PartialEq)]
pub enum Event {
    /// A vehicle entered the map.
    Entered(VehicleId),
    /// A user took a vehicle off the road.
    Removed {
        /// Which vehicle.
        vehicle: VehicleId,
        /// Position of its front bumper.
        at: Position,
    },
    /// A vehicle left the map: its trip is completed.
    Left {
        /// Which vehicle.
        vehicle: VehicleId,
        /// Its time on the map [s].
        duration: f64,
        /// Its last chain.
        chain: ChainIndex,
        /// Its kinematics in its last step, which may have ended beyond the chain.
        motion: Kinematics,
        /// The record of its trip, if trips are recorded.
        trip: Option<TripRecord>,
    },
    /// A lane change was completed or aborted.
    LaneChange(LaneChange),
    /// Two vehicles began to touch each other.
    Incident(Incident),
    /// Something happened to one vehicle during its trip.
    Driving(DrivingEvent),
}

/// Something that happened to one vehicle during its trip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrivingEvent {
    /// What happened.
    pub kind: DrivingEventKind,
    /// Which vehicle.
    pub vehicle: VehicleId,
    /// Time [s].
    pub time: f64,
    /// Position of its front bumper.
    pub at: Position,
}

/// What happened to a vehicle during its trip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DrivingEventKind {
    /// It began to brake as kinematics, not its model, demand.
    EmergencyBraking,
    /// It began to brake with more than 4 m/s², whoever decided it.
    HardBraking(BrakingCause),
    /// It came to a halt.
    Halt,
    /// It drove on after a standstill.
    SetOff {
        /// Time for which it stood [s].
        stood: f32,
    },
    /// Its driver missed a turn. It takes another route if there is one.
    MissedTurn,
    /// Its driver left its route for a better one.
    RouteChange,
}

/// What a vehicle brakes for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum BrakingCause {
    /// A place to stop at a junction, such as a red light.
    Stop,
    /// The end of its lane, or the last place for a lane change.
    LaneEnd,
    /// Its leader.
    Leader,
    /// Its leader, where one of the two changes lanes.
    CutIn,
    /// A lower desired speed.
    DesiredSpeed,
    /// Kinematics, not its model, decided.
    Kinematics,
    /// Its user.
    User,
}

impl BrakingCause {
    /// All of them, in their order.
    pub const ALL: [BrakingCause; 7] = [
        BrakingCause::Stop,
        BrakingCause::LaneEnd,
        BrakingCause::Leader,
        BrakingCause::CutIn,
        BrakingCause::DesiredSpeed,
        BrakingCause::Kinematics,
        BrakingCause::User,
    ];

    /// In a few words.
    pub fn name(self) -> &'static str {
        match self {
            BrakingCause::Stop => "stop at a junction",
            BrakingCause::LaneEnd => "lane end",
            BrakingCause::Leader => "leader",
            BrakingCause::CutIn => "cut-in",
            BrakingCause::DesiredSpeed => "lower desired speed",
            BrakingCause::Kinematics => "emergency",
            BrakingCause::User => "user",
        }
    }
}

impl DrivingEventKind {
    /// The order in which a vehicle's events of one step are reported.
    pub(crate) fn rank(self) -> u8 {
        match self {
            DrivingEventKind::EmergencyBraking => 0,
            DrivingEventKind::HardBraking(_) => 1,
            DrivingEventKind::Halt => 2,
            DrivingEventKind::SetOff { .. } => 3,
            DrivingEventKind::MissedTurn => 4,
            DrivingEventKind::RouteChange => 5,
        }
    }
}

/// A lane change, with the reasons for it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LaneChange {
    /// Which vehicle.
    pub vehicle: VehicleId,
    /// Index of its driver in the table of driver parameters.
    pub parameters: u32,
    /// The class of the vehicle that changes lanes.
    pub class: crate::state::vehicle::Class,
    /// Time when the lateral motion began [s].
    pub started: f64,
    /// Time when the centre crossed the line, or the change was aborted [s].
    pub time: f64,
    /// Time from the beginning to the end of the lateral motion [s].
    pub duration: f64,
    /// Position of its front bumper in the old lane.
    pub from: Position,
    /// Position of its front bumper in the new lane.
    pub to: Position,
    /// The side to which it changed.
    pub side: Side,
    /// The kind of the change.
    pub kind: LaneChangeKind,
    /// Speed when the centre crossed the line [m/s].
    pub speed: f64,
    /// Anticipated speed gain when the desire came [m/s].
    pub speed_gain: f64,
    /// The driver's appraisal when the desire came.
    pub appraisal: Appraisal,
    /// Gap to the new leader when the change began [m].
    pub gap_ahead: f64,
    /// Gap to the new follower when the change began [m].
    pub gap_behind: f64,
    /// Time to collision with the new leader when the change began [s].
    pub ttc_ahead: f64,
    /// Time to collision of the new follower when the change began [s].
    pub ttc_behind: f64,
    /// It was completed; otherwise it was aborted.
    pub is_completed: bool,
}
