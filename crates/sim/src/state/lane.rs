//! Vehicles in the order of their lanes. A leader is the next entry.
//!
//! An entry has three parts, in arrays of the same order. [`Kinematics`] is all that other vehicles see, and is
//! written again at every step. [`DriverState`] is what a driver needs to drive on and to consider lanes.
//! [`LaneChangeState`] is what only lane changes need. A vehicle that changes lanes has an entry in both lanes: its
//! main entry where its centre is, and a shadow in the other.

use laneweave_models::Manner;
use laneweave_models::follow::Ahead;
use serde::{Deserialize, Serialize};

use crate::state::clock::Clock;
use crate::state::goal::Goal;
pub use crate::state::lane_change::{Counterpart, LaneChangeState};
pub use crate::state::phase::{LaneChangeKind, Phase};
use crate::state::prefetch::prefetch;
use crate::state::vehicle::Class;

/// The id of a vehicle. It never changes, and is never used again.
pub type VehicleId = u32;

/// The kinematics of a vehicle, which is all that others see of it: half a cache line.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[repr(align(32))]
pub struct Kinematics {
    /// Front bumper along the chain [m].
    pub x: f64,
    /// Speed [m/s].
    pub speed: f64,
    /// Acceleration of the last step [m/s²].
    pub acceleration: f32,
    /// Headway relaxation: share of its usual time gap that the driver accepts at present.
    pub headway_relaxation: f32,
    /// Vehicle length [m].
    pub length: f32,
    /// The id of the vehicle.
    pub id: VehicleId,
}

impl Kinematics {
    /// Rear bumper along the chain [m].
    #[inline]
    pub fn rear(&self) -> f64 {
        self.x - f64::from(self.length)
    }

    /// Itself as the leader of a vehicle that has the net gap `gap` [m] to it.
    #[inline(always)]
    pub(crate) fn ahead(&self, gap: f64) -> Ahead {
        Ahead { gap, speed: self.speed, acceleration: f64::from(self.acceleration) }
    }
}

/// What the driver of a vehicle needs at every step: half a cache line.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[repr(align(32))]
pub struct DriverState {
    /// Desired speed [m/s]; it falls gradually to a lower one.
    pub desired: f32,
    /// Desired speed at the next turn of the driver, under the limits and in the bends ahead [m/s].
    pub limit_desired: f32,
    /// Time at standstill [s].
    pub standing: f32,
    /// Index of its driver in the table of driver parameters.
    pub parameters: u32,
    /// Step in which its driver considers lanes next.
    pub due: u32,
    /// End of the cooldown: the driver begins no discretionary change before this step.
    pub cooldown_until: u32,
    /// Its destination.
    pub goal: Goal,
    /// Its class.
    pub class: Class,
    /// The phase of its lane change.
    pub phase: Phase,
    /// This entry is the shadow of an entry in another lane.
    pub is_shadow: bool,
    /// Kinematics, not the model, decided the present braking.
    pub in_emergency: bool,
    /// Its driver reacts to more than the leader, such as the last place for a change, or a vehicle that it lets in.
    pub needs_full_update: bool,
    /// A user drives it.
    pub is_external: bool,
}

const _: () =
    assert!(size_of::<Kinematics>() == 32 && size_of::<DriverState>() == 32, "an entry fills one cache line");

impl DriverState {
    /// Whether its driver has anything to decide about lanes in `step`: it is its turn, or it wants or makes a change.
    #[inline]
    pub(crate) fn has_to_decide(&self, step: u32) -> bool {
        self.phase != Phase::Cruises || self.due <= step
    }

    /// Rate at which its desired speed, which is too high for the road ahead, falls [m/s²].
    pub(crate) fn slowing(&self, manner: &Manner, clock: Clock) -> f64 {
        let less = f64::from(self.desired - self.limit_desired);
        manner.slowing(less, clock.until(self.due).max(clock.dt))
    }

    /// Whether its driver only follows: it changes no lane, reacts to nothing else, and has nothing else to store.
    #[inline]
    pub(crate) fn only_follows(&self) -> bool {
        self.phase == Phase::Cruises && !self.needs_full_update && self.is_calm()
    }

    /// Whether its vehicle changes lanes, and its driver only follows in both.
    #[inline]
    pub(crate) fn only_follows_both(&self) -> bool {
        self.phase.is_between_lanes() && !self.needs_full_update && self.is_calm()
    }

    /// Whether its driver keeps its lane and has something to react to, but no emergency and no slower road ahead.
    #[inline]
    pub(crate) fn keeps_lane_calmly(&self) -> bool {
        self.phase == Phase::Cruises && self.needs_full_update && self.is_calm()
    }

    #[inline]
    fn is_calm(&self) -> bool {
        !self.in_emergency && self.desired == self.limit_desired
    }
}

/// An entry with all its parts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Entry {
    /// Its kinematics.
    pub(crate) motion: Kinematics,
    /// The hot part of its driver.
    pub(crate) driver: DriverState,
    /// The warm part of its driver.
    pub(crate) lane_change: LaneChangeState,
}

/// The vehicles of one chain in driving order: the last entry is the foremost.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Lane {
    motions: Vec<Kinematics>,
    drivers: Vec<DriverState>,
    lane_change_states: Vec<LaneChangeState>,
}

impl Lane {
    /// Whether its arrays have the same length, and its vehicles have valid numbers and are in driving order.
    pub(crate) fn is_sound(&self) -> bool {
        let Lane { motions, drivers, lane_change_states } = self;
        let is_number = |it: &Kinematics| it.x.is_finite() && it.speed.is_finite() && it.length > 0.0;
        drivers.len() == motions.len()
            && lane_change_states.len() == motions.len()
            && motions.iter().all(is_number)
            && self.is_in_order()
    }

    /// Copies all vehicles of `other`, into the memory that it has.
    pub(crate) fn copy_from(&mut self, other: &Lane) {
        self.motions.clone_from(&other.motions);
        self.drivers.clone_from(&other.drivers);
        self.lane_change_states.clone_from(&other.lane_change_states);
    }

    /// The kinematics of the vehicles.
    #[inline]
    pub fn motions(&self) -> &[Kinematics] {
        &self.motions
    }

    /// The hot parts of the drivers.
    #[inline]
    pub fn drivers(&self) -> &[DriverState] {
        &self.drivers
    }

    /// The warm parts of the drivers.
    #[inline]
    pub fn lane_change_states(&self) -> &[LaneChangeState] {
        &self.lane_change_states
    }

    /// The hot parts of the drivers, mutable.
    #[inline]
    pub(crate) fn drivers_mut(&mut self) -> &mut [DriverState] {
        &mut self.drivers
    }

    /// All parts of the entry at `index`.
    pub(crate) fn entry(&self, index: usize) -> Entry {
        let (motion, driver) = (self.motions[index], self.drivers[index]);
        Entry { motion, driver, lane_change: self.lane_change_states[index] }
    }

    /// The parts of the entry at `index`, mutable. The entries must stay in the order of their positions.
    #[inline]
    pub(crate) fn entry_mut(
        &mut self,
        index: usize,
    ) -> (&mut Kinematics, &mut DriverState, &mut LaneChangeState) {
        (&mut self.motions[index], &mut self.drivers[index], &mut self.lane_change_states[index])
    }

    /// Number of entries for which memory is allocated.
    #[inline]
    pub(crate) fn capacity(&self) -> usize {
        self.drivers.capacity()
    }

    /// Prefetches the hot part of the driver at `index`.
    #[inline]
    pub(crate) fn prefetch_car(&self, index: u32) {
        prefetch(&self.drivers[index as usize]);
    }

    /// Prefetches both parts of the driver at `index`.
    #[inline]
    pub(crate) fn prefetch_driver(&self, index: u32) {
        prefetch(&self.drivers[index as usize]);
        prefetch(&self.lane_change_states[index as usize]);
    }

    /// Prefetches the entry at `index`, if there is one.
    #[inline]
    pub(crate) fn prefetch(&self, index: usize) {
        if let (Some(motion), Some(driver)) = (self.motions.get(index), self.drivers.get(index)) {
            prefetch(motion);
            prefetch(driver);
        }
    }

    /// Moves all vehicles: `next` becomes their kinematics, and receives the old ones. Panics if the lengths differ.
    #[inline]
    pub(crate) fn swap_motions(&mut self, next: &mut Vec<Kinematics>) {
        assert_eq!(self.motions.len(), next.len(), "every entry moves once");
        std::mem::swap(&mut self.motions, next);
    }

    /// Number of entries up to `x`, which is the index of the first entry ahead.
    #[inline]
    pub fn ahead_of(&self, x: f64) -> usize {
        self.motions.partition_point(|it| it.x <= x)
    }

    /// The same, searched from the index `hint` on. Drivers who look at this lane one after the other are near each
    /// other. So the search stays among neighbours, where a bisection would read cold memory.
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

    /// Index of the entry of vehicle `id`, which was at `x` at most one step ago. Obstacles are no entries of it.
    pub fn find(&self, id: VehicleId, x: f64) -> Option<usize> {
        /// No vehicle moves further in a step of at most one second [m].
        const STEP: f64 = 100.0;
        /// Tolerance for rounding [m].
        const NEAR: f64 = 0.01;
        let from = self.motions.partition_point(|it| it.x < x - NEAR);
        let within = self.motions[from..].iter().take_while(|it| it.x <= x + STEP);
        let (_, index) = within.zip(from..).find(|(it, _)| it.id == id)?;
        if self.is_obstacle(index) { self.find_beyond(id, index) } else { Some(index) }
    }

    /// Index of the entry of vehicle `id`, of which there is an obstacle at `index`.
    #[cold]
    fn find_beyond(&self, id: VehicleId, index: usize) -> Option<usize> {
        (index + 1..self.motions.len()).find(|it| self.motions[*it].id == id && !self.is_obstacle(*it))
    }

    /// Index of the entry at `x` by which vehicle `id`, whose main entry is in another lane, is seen here.
    pub(crate) fn find_obstacle(&self, id: VehicleId, x: f64) -> Option<usize> {
        let from = self.motions.partition_point(|it| it.x < x);
        let mut here = self.motions[from..].iter().take_while(|it| it.x <= x).zip(from..);
        here.find(|(it, at)| it.id == id && self.is_obstacle(*at)).map(|it| it.1)
    }

    /// Whether the entry at `index` only stands for a vehicle that touches this lane.
    pub(crate) fn is_obstacle(&self, index: usize) -> bool {
        self.drivers[index].is_shadow && self.lane_change_states[index].counterpart.is_none()
    }

    /// Whether the vehicles are in driving order.
    pub(crate) fn is_in_order(&self) -> bool {
        self.motions.is_sorted_by(|a, b| a.x <= b.x)
    }

    /// Restores the driving order after a vehicle drove through others.
    pub(crate) fn restore_order(&mut self) {
        for end in 1..self.motions.len() {
            let mut index = end;
            while index > 0 && self.motions[index - 1].x > self.motions[index].x {
                self.motions.swap(index - 1, index);
                self.drivers.swap(index - 1, index);
                self.lane_change_states.swap(index - 1, index);
                index -= 1;
            }
        }
    }

    /// Inserts an entry in driving order.
    pub(crate) fn insert(&mut self, entry: Entry) {
        let index = self.ahead_of(entry.motion.x);
        if self.drivers.len() == self.drivers.capacity() {
            // If the capacity doubled, a third of the memory of much traffic would be unused.
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

    /// Removes an entry, and returns it.
    pub(crate) fn remove(&mut self, index: usize) -> Entry {
        Entry {
            motion: self.motions.remove(index),
            driver: self.drivers.remove(index),
            lane_change: self.lane_change_states.remove(index),
        }
    }

    /// Removes the shadows of changes that have ended.
    pub(crate) fn remove_ended(&mut self) {
        let mut index = 0;
        while index < self.drivers.len() {
            let driver = &self.drivers[index];
            let stands_for_an_external = driver.is_external && self.is_obstacle(index);
            if driver.is_shadow && driver.phase == Phase::Cruises && !stands_for_an_external {
                self.remove(index);
            } else {
                index += 1;
            }
        }
    }

    /// Removes the foremost entry if it is beyond `end`, and returns it.
    pub(crate) fn pop_beyond(&mut self, end: f64) -> Option<Entry> {
        self.motions.last().filter(|it| it.x > end)?;
        Some(self.remove(self.motions.len() - 1))
    }
}
