//! The main entry of a vehicle that a user drives by poses goes from place to place: along its lane, to the next one,
//! to any other, off the road, and back.

use laneweave_network::{Footprint, Position};

use crate::junction::reservations::NO_RESERVATION;
use crate::junction::state::JunctionState;
use crate::record::log::Log;
use crate::route::roads::Roads;
use crate::state::control::Control;
use crate::state::goal::Destination;
use crate::state::lane::{Entry, Kinematics};
use crate::state::previous_lanes::PreviousLanes;
use crate::state::traffic::Traffic;
use crate::state::vehicle::LONGEST;
use crate::step::obstacle::Moved;
use crate::step::work::Work;

/// What a new place of a main entry changes, and what it depends on.
pub(super) struct Relocating<'a> {
    pub(super) roads: &'a Roads,
    pub(super) traffic: &'a mut Traffic,
    pub(super) junctions: &'a mut JunctionState,
    pub(super) log: &'a mut Log,
    pub(super) work: &'a mut Work,
}

impl Relocating<'_> {
    /// Brings `entry`, which was at `from`, to a footprint. `None` stands for no lane.
    pub(super) fn relocate(
        &mut self,
        entry: &mut Entry,
        moved: &Moved,
        from: Option<Position>,
        onto: Option<&Footprint>,
    ) {
        let (network, clock) = (self.roads.network(), self.traffic.clock());
        let driven = if moved.before.is_some() { moved.way } else { 0.0 };
        let old = entry.motion;
        let extent = onto.map(|it| (it.to, moved.rear(network, it)));
        entry.motion = kinematics(&old, self.speed_of(moved, onto), moved.rectangle.length, extent, clock.dt);
        let at = onto.map(|it| Position::new(it.chain, entry.motion.x));
        self.go_on_in_reservation(entry, from, at);
        self.log.relocate(network, clock, &entry.motion, [from, at], driven - (entry.motion.x - old.x));
        if let Some(at) = at.or(from) {
            self.work.add_distance(at.chain, driven);
        }
        let is_along = from.map(|it| it.chain) == at.map(|it| it.chain);
        if !is_along {
            self.know_new_lane(entry, from, at);
        }
    }

    fn speed_of(&self, moved: &Moved, onto: Option<&Footprint>) -> f64 {
        let (network, dt) = (self.roads.network(), self.traffic.clock().dt);
        onto.map_or(moved.speed, |it| moved.speed_along(network, it, dt).max(0.0))
    }

    /// A vehicle that drives on along its route keeps its reservation. Otherwise the reservation ends.
    fn go_on_in_reservation(&mut self, entry: &mut Entry, from: Option<Position>, at: Option<Position>) {
        let (slot, id) = (entry.lane_change.reservation, entry.motion.id);
        if self.junctions.reservations().of(slot, id).is_none() {
            return;
        }
        let destination = entry.driver.goal.destination();
        let way = from.zip(at).and_then(|(from, at)| self.way_on(destination, from, at));
        let reservations = self.junctions.reservations_mut();
        match way {
            Some(way) => {
                reservations.advance(slot, way, entry.motion.speed, f64::from(entry.driver.desired));
            }
            None => {
                reservations.end(slot, id);
                entry.lane_change.reservation = NO_RESERVATION;
            }
        }
    }

    /// The way along the route to `destination` from one position to another [m], if that is on the same chain or on
    /// the next one.
    fn way_on(&self, destination: Destination, from: Position, at: Position) -> Option<f64> {
        let network = self.roads.network();
        if from.chain == at.chain {
            return Some((at.x - from.x).max(0.0));
        }
        let next = self.roads.navigator().next(network, destination, from.chain);
        (next == Some(at.chain)).then(|| network.chain(from.chain).length - from.x + at.x)
    }

    /// The driver considers lanes at once.
    fn know_new_lane(&self, entry: &mut Entry, from: Option<Position>, at: Option<Position>) {
        let (network, Entry { driver, lane_change, .. }) = (self.roads.network(), entry);
        let before =
            from.filter(|it| at.is_some_and(|at| network.chain(it.chain).following.contains(&at.chain)));
        let previous_lanes = lane_change.previous_lanes;
        lane_change.previous_lanes = before.map_or(PreviousLanes::NONE, |it| previous_lanes.left(it.chain));
        lane_change.last_place = f64::INFINITY;
        driver.due = self.traffic.clock().step;
        driver.needs_full_update = true;
        if let Some(at) = at {
            driver.limit_desired = self.roads.outlook(driver).fitting_speed(at, 0.0) as f32;
            driver.desired = driver.limit_desired;
        }
    }
}

/// The kinematics in a lane, from its front to its rear there, or in no lane. A vehicle at an angle may be longer
/// along the lane than its `length`.
fn kinematics(old: &Kinematics, speed: f64, length: f64, extent: Option<(f64, f64)>, dt: f64) -> Kinematics {
    let acceleration = ((speed - old.speed) / dt).clamp(-Control::HARDEST, Control::HARDEST) as f32;
    let (x, length) =
        extent.map_or((old.x, length), |(front, rear)| (front, length.max((front - rear).min(LONGEST))));
    Kinematics { x, speed, acceleration, length: length as f32, ..*old }
}
