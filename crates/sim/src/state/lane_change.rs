//! What only lane changes of a vehicle need.

use laneweave_network::{ChainIndex, Position, Side};
use serde::{Deserialize, Serialize};

use crate::state::phase::LaneChangeKind;
use crate::state::previous_lanes::PreviousLanes;

/// The warm part of a vehicle: its lane-change state.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LaneChangeState {
    /// Side of the desired or current change.
    pub side: Side,
    /// Kind of the desired or current change.
    pub kind: LaneChangeKind,
    /// The driver may have to stay behind its leader in the overtaking lane.
    pub minds_offside: bool,
    /// Step in which the vehicle entered the map.
    pub entered: u32,
    /// Step in which the desire came, or the change began.
    pub since: u32,
    /// Distance along this chain per metre driven: 1 except for shadows in curves.
    pub stretch: f32,
    /// Share of the duration of the change that has passed.
    pub progress: f32,
    /// Urgency of the desired change, 0…1.
    pub urgency: f32,
    /// G of the side when the desire came.
    pub gain: f32,
    /// The slot of the record of the desired or current change.
    pub record: u32,
    /// The chains that it came from.
    pub previous_lanes: PreviousLanes,
    /// Its other entry.
    pub counterpart: Option<Counterpart>,
    /// Last place for a driver in a wrong lane to leave it, along the chain [m]; infinite in a right lane.
    pub last_place: f64,
    /// The vehicle that the driver lets in: gap [m], infinite if there is none, and speed [m/s].
    pub lets_in: (f32, f32),
    /// The slot of its reservation, if it has one.
    pub(crate) reservation: u32,
}

impl LaneChangeState {
    /// No vehicle to let in.
    pub(crate) const NOBODY: (f32, f32) = (f32::INFINITY, 0.0);
}

const _: () = assert!(size_of::<LaneChangeState>() <= 88, "memory of a vehicle");

/// The other entry of a vehicle that changes lanes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Counterpart {
    /// Its chain.
    pub chain: ChainIndex,
    /// Its front bumper there [m].
    pub x: f64,
    /// Distance along its chain per metre driven.
    pub stretch: f32,
}

impl Counterpart {
    /// Its position.
    pub(crate) fn at(&self) -> Position {
        Position::new(self.chain, self.x)
    }
}
