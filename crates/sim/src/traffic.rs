//! Vehicles in the order of their lanes. A leader is the next entry.
//!
//! What driving on and considering lanes need stands in [`Car`], one cache line; what only changes of lane need, in the same order, in [`Mind`]. A vehicle that changes lanes
//! stands in both lanes: with its main entry where its centre is, with a shadow in the other.

use laneweave_network::{ChainIndex, Side};

use crate::navigate::Goal;
use crate::vehicle::Class;

/// Name of a vehicle; it never changes and is never given again.
pub type VehicleId = u32;

/// The hot part of a vehicle: one cache line of 64 bytes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub struct Car {
    /// Front bumper along the chain [m].
    pub x: f64,
    /// Speed [m/s].
    pub speed: f64,
    /// Acceleration of the last step [m/s²].
    pub acceleration: f32,
    /// Desired speed [m/s]; a lower limit is approached gently.
    pub desired: f32,
    /// Desired speed that the current speed limit gives [m/s].
    pub limit_desired: f32,
    /// Vehicle length [m].
    pub length: f32,
    /// Share of its usual time gap that the driver accepts for now.
    pub tightness: f32,
    /// Time at standstill [s].
    pub standing: f32,
    /// Its driver's place in the table of characters.
    pub character: u32,
    /// Who it is.
    pub id: VehicleId,
    /// Step at which its driver considers lanes next.
    pub due: u32,
    /// Step before which there is no new voluntary change.
    pub calm_until: u32,
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
    /// It touches its leader.
    pub in_collision: bool,
    /// Its driver heeds more than the leader: the last place for a change, or a vehicle that it lets in.
    pub heeds_more: bool,
}

const _: () = assert!(size_of::<Car>() == 64, "a car fills one cache line");

impl Car {
    /// Rear bumper along the chain [m].
    #[inline]
    pub fn rear(&self) -> f64 {
        self.x - f64::from(self.length)
    }
}

/// What a driver is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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

/// The warm part of a vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mind {
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
    /// The chain it came from.
    pub came_from: Option<ChainIndex>,
    /// Where its other entry stands.
    pub twin: Option<Twin>,
    /// Where a driver in a wrong lane has to have left it, along the chain [m]; infinite in a right one.
    pub last_place: f64,
    /// A vehicle that the driver lets in: gap [m] and speed [m/s].
    pub lets_in: Option<(f32, f32)>,
}

/// The other entry of a vehicle that changes lanes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Twin {
    /// Its chain.
    pub chain: ChainIndex,
    /// Its front bumper there [m].
    pub x: f64,
    /// Its metres for a metre driven.
    pub stretch: f32,
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
    /// The main entry's chain and front bumper.
    pub(crate) at: (ChainIndex, f64),
    /// The shadow's.
    pub(crate) shadow: Option<(ChainIndex, f64)>,
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
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Kind {
    /// Between lanes that lead to the same place.
    Discretionary,
    /// For the route, or off it.
    Route,
}

/// The vehicles of one chain in driving order: the last entry is foremost.
#[derive(Clone, Debug, Default)]
pub struct Lane {
    cars: Vec<Car>,
    minds: Vec<Mind>,
}

impl Lane {
    /// Their hot parts.
    #[inline]
    pub fn cars(&self) -> &[Car] {
        &self.cars
    }

    /// Their warm parts.
    #[inline]
    pub fn minds(&self) -> &[Mind] {
        &self.minds
    }

    /// Both parts, to change. The order must stay that of the positions.
    #[inline]
    pub(crate) fn parts(&mut self) -> (&mut [Car], &mut [Mind]) {
        (&mut self.cars, &mut self.minds)
    }

    /// Number of entries that are not beyond `x`: the index of the first one ahead.
    #[inline]
    pub fn ahead_of(&self, x: f64) -> usize {
        self.cars.partition_point(|car| car.x <= x)
    }

    /// The same, sought from the index `hint` on: drivers who look across one after the other are near each other, and
    /// a walk over neighbours meets no cold memory as a bisection does.
    #[inline]
    pub(crate) fn ahead_of_near(&self, x: f64, hint: usize) -> usize {
        let mut index = hint.min(self.cars.len());
        while index < self.cars.len() && self.cars[index].x <= x {
            index += 1;
        }
        while index > 0 && self.cars[index - 1].x > x {
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
        let from = self.cars.partition_point(|car| car.x < x - NEAR);
        let within = self.cars[from..].iter().take_while(|car| car.x <= x + STEP);
        within.zip(from..).find(|(car, _)| car.id == id).map(|(_, index)| index)
    }

    /// Adds an entry at its place.
    pub(crate) fn insert(&mut self, car: Car, mind: Mind) {
        let index = self.ahead_of(car.x);
        if self.cars.len() == self.cars.capacity() {
            // Doubling would leave a third of the memory of much traffic unused.
            let more = 8 + self.cars.len() / 8;
            self.cars.reserve_exact(more);
            self.minds.reserve_exact(more);
        }
        self.cars.insert(index, car);
        self.minds.insert(index, mind);
    }

    /// Takes an entry out.
    pub(crate) fn remove(&mut self, index: usize) -> (Car, Mind) {
        (self.cars.remove(index), self.minds.remove(index))
    }

    /// Takes out the shadows of changes that are over.
    pub(crate) fn remove_ended(&mut self) {
        let mut index = 0;
        while index < self.cars.len() {
            if self.cars[index].is_shadow && self.cars[index].phase == Phase::Cruises {
                self.remove(index);
            } else {
                index += 1;
            }
        }
    }

    /// Takes the foremost entry out if it is beyond `end`.
    pub(crate) fn pop_beyond(&mut self, end: f64) -> Option<(Car, Mind)> {
        self.cars.last().filter(|car| car.x > end)?;
        Some((self.cars.pop()?, self.minds.pop()?))
    }
}
