//! Vehicles in the order of their lanes. A leader is the next entry.
//!
//! An entry has three parts, kept in arrays of the same order: its [`Kinematics`], written anew at every step, is all
//! that others need to see; [`DriverState`] is what its driver needs to drive on and to consider lanes;
//! [`LaneChangeState`] what only changes of lane need. A vehicle that changes lanes stands in both lanes: with its main
//! entry where its centre is, with a shadow in the other.

use laneweave_models::follow::Ahead;
use laneweave_network::{ChainIndex, Position, Side};
use serde::{Deserialize, Serialize};

use crate::state::goal::Goal;
use crate::state::prefetch::prefetch;
use crate::state::previous_lanes::PreviousLanes;
use crate::state::vehicle::Class;

/// Name of a vehicle; it never changes and is never given again.
pub type VehicleId = u32;

/// How a vehicle moves, and what others see of it: half a cache line.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[repr(align(32))]
pub struct Kinematics {
    /// Front bumper along the chain [m].
    pub x: f64,
    /// Speed [m/s].
    pub speed: f64,
    /// Acceleration of the last step [m/s²].
    pub acceleration: f32,
    /// Share of its usual time gap that the driver accepts for now.
    pub headway_relaxation: f32,
    /// Vehicle length [m].
    pub length: f32,
    /// Who it is.
    pub id: VehicleId,
}

impl Kinematics {
    /// Rear bumper along the chain [m].
    #[inline]
    pub fn rear(&self) -> f64 {
        self.x - f64::from(self.length)
    }

    /// It as the leader of one whose net gap to it is `gap` [m].
    #[inline(always)]
    pub(crate) fn ahead(&self, gap: f64) -> Ahead {
        Ahead { gap, speed: self.speed, acceleration: f64::from(self.acceleration) }
    }
}

/// What the driver of a vehicle needs at every step: half a cache line.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[repr(align(32))]
pub struct DriverState {
    /// Desired speed [m/s]; a lower limit is approached gently.
    pub desired: f32,
    /// Desired speed that the current speed limit gives [m/s].
    pub limit_desired: f32,
    /// Time at standstill [s].
    pub standing: f32,
    /// Its driver's place in the table of driver parameters.
    pub parameters: u32,
    /// Step at which its driver considers lanes next.
    pub due: u32,
    /// Step before which there is no new voluntary change.
    pub cooldown_until: u32,
    /// Where it goes.
    pub goal: Goal,
    /// Its class.
    pub class: Class,
    /// What its driver is about.
    pub phase: Phase,
    /// This entry is the shadow of one in another lane.
    pub is_shadow: bool,
    /// Kinematics, not the model, decided in the present braking.
    pub in_emergency: bool,
    /// Its driver reacts to more than the leader: the last place for a change, or a vehicle that it lets in.
    pub needs_full_update: bool,
}

const _: () =
    assert!(size_of::<Kinematics>() == 32 && size_of::<DriverState>() == 32, "an entry fills one cache line");

impl DriverState {
    /// Its driver only follows: no change of lanes, nothing else to react to or to remember.
    #[inline]
    pub(crate) fn only_follows(&self) -> bool {
        self.phase == Phase::Cruises
            && !self.needs_full_update
            && !self.in_emergency
            && self.desired == self.limit_desired
    }
}

/// What a driver is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[repr(u8)]
pub enum Phase {
    /// Keeps its lane.
    Cruises,
    /// Waits for a gap.
    Wants,
    /// Changes lanes.
    Changes,
    /// Goes back to where it came from.
    Aborts,
}

impl Phase {
    /// Its vehicle is between two lanes, and stands in both.
    #[inline]
    pub fn is_between_lanes(self) -> bool {
        matches!(self, Phase::Changes | Phase::Aborts)
    }
}

/// The warm part of a vehicle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LaneChangeState {
    /// Side of the desired or current change.
    pub side: Side,
    /// Kind of the desired or current change.
    pub kind: Kind,
    /// Step at which it entered.
    pub entered: u32,
    /// Step at which the desire came, or the change began.
    pub since: u32,
    /// Metres along this chain for a metre driven: 1 but for shadows in curves.
    pub stretch: f32,
    /// Share of the change's time that has passed.
    pub progress: f32,
    /// Urgency of the desired change, 0…1.
    pub urgency: f32,
    /// Where the appraisal of the desired or current change is kept.
    pub record: u32,
    /// Where it came from.
    pub previous_lanes: PreviousLanes,
    /// Where its other entry stands.
    pub counterpart: Option<Counterpart>,
    /// Where a driver in a wrong lane has to have left it, along the chain [m]; infinite in a right one.
    pub last_place: f64,
    /// A vehicle that the driver lets in: gap [m], infinite if there is none, and speed [m/s].
    pub lets_in: (f32, f32),
    /// Where its reservation through a junction is kept, if it has one.
    pub(crate) reservation: u32,
}

impl LaneChangeState {
    /// Nobody to let in.
    pub(crate) const NOBODY: (f32, f32) = (f32::INFINITY, 0.0);
}

const _: () = assert!(size_of::<LaneChangeState>() <= 80, "memory of a vehicle");

/// The other entry of a vehicle that changes lanes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Counterpart {
    /// Its chain.
    pub chain: ChainIndex,
    /// Its front bumper there [m].
    pub x: f64,
    /// Its metres for a metre driven.
    pub stretch: f32,
}

impl Counterpart {
    /// Where it stands.
    pub(crate) fn at(&self) -> Position {
        Position::new(self.chain, self.x)
    }
}

/// Something that happened to a lane change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Milestone {
    /// Who.
    pub(crate) id: VehicleId,
    /// Where its record is kept.
    pub(crate) record: u32,
    /// What.
    pub(crate) what: Reached,
    /// The front bumper of its main entry.
    pub(crate) at: Position,
    /// The shadow's.
    pub(crate) shadow: Option<Position>,
    /// Speed [m/s].
    pub(crate) speed: f64,
}

/// What a lane change has reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Reached {
    /// The desire was given up.
    Nothing,
    /// The centre crossed the line.
    Crossing,
    /// It is done.
    End,
    /// It is back where it came from.
    Return,
}

/// Why a change is desired.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[repr(u8)]
pub enum Kind {
    /// Between lanes that lead to the same place.
    Discretionary,
    /// For the route, or off it.
    Route,
}

/// An entry with all its parts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Entry {
    /// How it moves.
    pub(crate) motion: Kinematics,
    /// Its driver's hot part.
    pub(crate) driver: DriverState,
    /// Its driver's warm part.
    pub(crate) lane_change: LaneChangeState,
}

/// The vehicles of one chain in driving order: the last entry is foremost.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Lane {
    motions: Vec<Kinematics>,
    drivers: Vec<DriverState>,
    lane_change_states: Vec<LaneChangeState>,
}

impl Lane {
    /// Whether its arrays go together, and its vehicles stand in driving order.
    pub(crate) fn is_sound(&self) -> bool {
        let Lane { motions, drivers, lane_change_states } = self;
        let is_number = |it: &Kinematics| it.x.is_finite() && it.speed.is_finite() && it.length > 0.0;
        let is_in_order = motions.windows(2).all(|it| it[0].x <= it[1].x);
        drivers.len() == motions.len()
            && lane_change_states.len() == motions.len()
            && motions.iter().all(is_number)
            && is_in_order
    }

    /// How they move.
    #[inline]
    pub fn motions(&self) -> &[Kinematics] {
        &self.motions
    }

    /// Their drivers' hot parts.
    #[inline]
    pub fn drivers(&self) -> &[DriverState] {
        &self.drivers
    }

    /// Their drivers' warm parts.
    #[inline]
    pub fn lane_change_states(&self) -> &[LaneChangeState] {
        &self.lane_change_states
    }

    /// Their drivers' hot parts, to change.
    #[inline]
    pub(crate) fn drivers_mut(&mut self) -> &mut [DriverState] {
        &mut self.drivers
    }

    /// All parts of the entry at `index`.
    pub(crate) fn entry(&self, index: usize) -> Entry {
        Entry {
            motion: self.motions[index],
            driver: self.drivers[index],
            lane_change: self.lane_change_states[index],
        }
    }

    /// The parts of the entry at `index`, to change. The order must stay that of the positions.
    #[inline]
    pub(crate) fn entry_mut(
        &mut self,
        index: usize,
    ) -> (&mut Kinematics, &mut DriverState, &mut LaneChangeState) {
        (&mut self.motions[index], &mut self.drivers[index], &mut self.lane_change_states[index])
    }

    /// Number of entries that there is room for.
    #[inline]
    pub(crate) fn capacity(&self) -> usize {
        self.drivers.capacity()
    }

    /// Asks for the memory of the hot part of the driver at `index`.
    #[inline]
    pub(crate) fn prefetch_car(&self, index: u32) {
        prefetch(&self.drivers[index as usize]);
    }

    /// Asks for the memory of both parts of the driver at `index`.
    #[inline]
    pub(crate) fn prefetch_driver(&self, index: u32) {
        prefetch(&self.drivers[index as usize]);
        prefetch(&self.lane_change_states[index as usize]);
    }

    /// Asks for the memory of the entry at `index`, if there is one.
    #[inline]
    pub(crate) fn prefetch(&self, index: usize) {
        if let (Some(motion), Some(driver)) = (self.motions.get(index), self.drivers.get(index)) {
            prefetch(motion);
            prefetch(driver);
        }
    }

    /// All move: `next` becomes how they move, and is given what it was.
    #[inline]
    pub(crate) fn swap_motions(&mut self, next: &mut Vec<Kinematics>) {
        assert_eq!(self.motions.len(), next.len(), "every entry moves once");
        std::mem::swap(&mut self.motions, next);
    }

    /// Number of entries that are not beyond `x`: the index of the first one ahead.
    #[inline]
    pub fn ahead_of(&self, x: f64) -> usize {
        self.motions.partition_point(|it| it.x <= x)
    }

    /// The same, sought from the index `hint` on: drivers who look across one after the other are near each other, and
    /// a walk over neighbours meets no cold memory as a bisection does.
    #[inline]
    pub(crate) fn ahead_of_near(&self, x: f64, hint: usize) -> usize {
        let mut index = hint.min(self.motions.len());
        while index < self.motions.len() && self.motions[index].x <= x {
            index += 1;
        }
        while index > 0 && self.motions[index - 1].x > x {
            index -= 1;
        }
        index
    }

    /// Index of the entry of vehicle `id`, which stood at `x` at most one step ago.
    pub fn find(&self, id: VehicleId, x: f64) -> Option<usize> {
        /// No vehicle moves further in a step of at most one second [m].
        const STEP: f64 = 100.0;
        /// Rounding [m].
        const NEAR: f64 = 0.01;
        let from = self.motions.partition_point(|it| it.x < x - NEAR);
        let within = self.motions[from..].iter().take_while(|it| it.x <= x + STEP);
        within.zip(from..).find(|(it, _)| it.id == id).map(|(_, index)| index)
    }

    /// Adds an entry at its place.
    pub(crate) fn insert(&mut self, entry: Entry) {
        let index = self.ahead_of(entry.motion.x);
        if self.drivers.len() == self.drivers.capacity() {
            // Doubling would leave a third of the memory of much traffic unused.
            let more = 4 + self.drivers.len() / 32;
            self.drivers.reserve_exact(more);
            self.lane_change_states.reserve_exact(more);
        }
        if self.motions.len() == self.motions.capacity() {
            self.motions.reserve_exact(self.drivers.capacity() - self.motions.len());
        }
        self.motions.insert(index, entry.motion);
        self.drivers.insert(index, entry.driver);
        self.lane_change_states.insert(index, entry.lane_change);
    }

    /// Takes an entry out.
    pub(crate) fn remove(&mut self, index: usize) -> Entry {
        Entry {
            motion: self.motions.remove(index),
            driver: self.drivers.remove(index),
            lane_change: self.lane_change_states.remove(index),
        }
    }

    /// Takes out the shadows of changes that are over.
    pub(crate) fn remove_ended(&mut self) {
        let mut index = 0;
        while index < self.drivers.len() {
            if self.drivers[index].is_shadow && self.drivers[index].phase == Phase::Cruises {
                self.remove(index);
            } else {
                index += 1;
            }
        }
    }

    /// Takes the foremost entry out if it is beyond `end`.
    pub(crate) fn pop_beyond(&mut self, end: f64) -> Option<Entry> {
        self.motions.last().filter(|it| it.x > end)?;
        Some(self.remove(self.motions.len() - 1))
    }
}
