//! The trip log: records of trips until they end, if they are requested. They contain what the traffic of one instant
//! does not show.
//!
//! The records are rarely in the cache. Only rare events write to them: a vehicle enters, halts, drives on, goes to the
//! next chain, changes lanes, takes another route, or leaves the map.

use std::collections::VecDeque;

use laneweave_network::{ChainIndex, Position};
use serde::{Deserialize, Serialize};

use crate::record::events::{DrivingEvent, DrivingEventKind};
use crate::record::lanelet_aggregates::Mark;
use crate::record::numbering::Both;
use crate::record::trips::is_reached;
use crate::state::lane::VehicleId;
use crate::state::vehicle::Class;

/// A trip up to now.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TripRecord {
    /// Which vehicle.
    pub vehicle: VehicleId,
    /// Its class.
    pub class: Class,
    /// Index of its driver in the table of driver parameters.
    pub parameters: u32,
    /// Index of its origin in the demand; none if it did not enter by the demand.
    pub origin: Option<usize>,
    /// Index of its destination; none if it follows the road without a destination.
    pub destination: Option<usize>,
    /// Time when it arrived at the origin [s].
    pub arrived: f64,
    /// Time when it entered [s].
    pub entered: f64,
    /// Position of its front bumper when it entered.
    pub from: Position,
    /// Its speed when it entered [m/s].
    pub speed: f64,
    /// Time that its route takes on a free road at the speeds that the driver desires [s]; none without a destination.
    pub free_time: Option<f64>,
    /// The distance driven so far is this plus the station on its present chain [m].
    pub way_to_start: f64,
    /// Times that it came to a halt.
    pub stops: u32,
    /// Time for which it stood, without the present halt [s].
    pub stood: f64,
    /// Times that its centre crossed the line to another lane.
    pub lane_changes: u32,
    /// Times that its driver left the route for a better one.
    pub route_changes: u32,
    /// Times that its driver missed a turn.
    pub missed_turns: u32,
    /// Up to here the lanelet aggregates have recorded it.
    pub(crate) mark: Mark,
}

impl TripRecord {
    /// An empty record.
    pub(crate) fn of(vehicle: VehicleId, class: Class, parameters: u32) -> TripRecord {
        TripRecord {
            vehicle,
            class,
            parameters,
            origin: None,
            destination: None,
            arrived: 0.0,
            entered: 0.0,
            from: Position::new(ChainIndex(0), 0.0),
            speed: 0.0,
            free_time: None,
            way_to_start: 0.0,
            stops: 0,
            stood: 0.0,
            lane_changes: 0,
            route_changes: 0,
            missed_turns: 0,
            mark: Mark::default(),
        }
    }

    /// The distance that its front bumper has driven when it is at `x` on its chain [m].
    pub fn way(&self, x: f64) -> f64 {
        self.way_to_start + x
    }
}

/// The records of all vehicles on the road.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct TripLog {
    slots: Both<Slots>,
    records: Vec<TripRecord>,
    free: Vec<u32>,
}

/// The slots of the records of vehicles, by their number.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
struct Slots {
    /// The oldest vehicle whose trip has not ended.
    oldest: u32,
    /// For each vehicle from the oldest on: the slot of its record.
    slots: VecDeque<u32>,
}

/// Values in place of a slot: the trip has not begun, or has ended.
const AHEAD: u32 = u32::MAX;
const OVER: u32 = u32::MAX - 1;

impl TripLog {
    /// Whether its slots exist, and its records name only this many chains.
    pub(crate) fn fits(&self, chains: usize) -> bool {
        let TripLog { slots, records, free } = self;
        let is_there = |it: u32| (it as usize) < records.len();
        slots.all().into_iter().flat_map(|it| &it.slots).all(|it| *it >= OVER || is_there(*it))
            && free.iter().all(|it| is_there(*it))
            && records.iter().all(|it| it.from.chain.at() < chains)
    }

    /// Whether all vehicles before the vehicles `next`, of the demand and of users, have a slot, except at most
    /// `but_for` of the demand.
    pub(crate) fn reach(&self, next: [VehicleId; 2], but_for: usize) -> bool {
        next.into_iter().zip([but_for, 0]).all(|(next, but_for)| {
            let (Slots { oldest, slots }, next) = self.slots.of(next);
            is_reached(next, *oldest, slots.len(), but_for)
        })
    }

    /// Whether a vehicle has a record that has not ended.
    pub(crate) fn has(&self, id: VehicleId) -> bool {
        self.of(id).is_some()
    }

    /// Begins a trip.
    pub(crate) fn begin(&mut self, mut record: TripRecord) {
        record.way_to_start = -record.from.x;
        let (Slots { oldest, slots }, number) = self.slots.of_mut(record.vehicle);
        let place = (number - *oldest) as usize;
        if place >= slots.len() {
            slots.resize(place + 1, AHEAD);
        }
        slots[place] = match self.free.pop() {
            Some(slot) => {
                self.records[slot as usize] = record;
                slot
            }
            None => {
                self.records.push(record);
                self.records.len() as u32 - 1
            }
        };
    }

    /// The record of a vehicle on the road.
    pub(crate) fn of(&self, id: VehicleId) -> Option<&TripRecord> {
        self.records.get(self.slot(id)? as usize)
    }

    /// The same record, mutable.
    pub(crate) fn of_mut(&mut self, id: VehicleId) -> Option<&mut TripRecord> {
        let slot = self.slot(id)?;
        self.records.get_mut(slot as usize)
    }

    fn slot(&self, id: VehicleId) -> Option<u32> {
        let (Slots { oldest, slots }, number) = self.slots.of(id);
        slots.get(number.checked_sub(*oldest)? as usize).copied()
    }

    /// Records an event of a vehicle during its trip.
    pub(crate) fn note(&mut self, event: &DrivingEvent) {
        let Some(record) = self.of_mut(event.vehicle) else { return };
        match event.kind {
            DrivingEventKind::EmergencyBraking | DrivingEventKind::HardBraking(_) => {}
            DrivingEventKind::Halt => record.stops += 1,
            DrivingEventKind::SetOff { stood } => record.stood += f64::from(stood),
            DrivingEventKind::MissedTurn => record.missed_turns += 1,
            DrivingEventKind::RouteChange => record.route_changes += 1,
        }
    }

    /// Ends a trip, and returns its record.
    pub(crate) fn end(&mut self, id: VehicleId) -> Option<TripRecord> {
        let ended = *self.of(id)?;
        let (Slots { oldest, slots }, number) = self.slots.of_mut(id);
        let slot = &mut slots[(number - *oldest) as usize];
        self.free.push(std::mem::replace(slot, OVER));
        while slots.front() == Some(&OVER) {
            slots.pop_front();
            *oldest += 1;
        }
        Some(ended)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(vehicle: VehicleId, x: f64) -> TripRecord {
        TripRecord { from: Position::new(ChainIndex(0), x), ..TripRecord::of(vehicle, Class::Car, 0) }
    }

    #[test]
    fn who_waits_to_enter_while_later_ones_leave_is_recorded_all_the_same() {
        let mut trip_log = TripLog::default();
        trip_log.begin(record(1, 5.0));
        assert_eq!(trip_log.end(1).map(|it| it.vehicle), Some(1));
        assert_eq!((trip_log.of(0), trip_log.of(1)), (None, None));
        trip_log.begin(record(0, 4.5));
        trip_log.begin(record(7, 12.0));
        assert_eq!(trip_log.of(0).map(|it| it.way(104.5)), Some(100.0));
        assert_eq!(trip_log.end(0).map(|it| it.vehicle), Some(0));
        assert_eq!((trip_log.slots.of(0).0.oldest, trip_log.of(7).map(|it| it.vehicle)), (2, Some(7)));
        assert_eq!(
            (trip_log.end(0), trip_log.of(1), trip_log.of(6), trip_log.of(8)),
            (None, None, None, None)
        );
    }

    #[test]
    fn halts_and_the_time_at_rest_add_up() {
        let mut trip_log = TripLog::default();
        trip_log.begin(record(0, 0.0));
        let event =
            |kind| DrivingEvent { kind, vehicle: 0, time: 0.0, at: Position::new(ChainIndex(0), 0.0) };
        for stood in [2.0, 3.5] {
            trip_log.note(&event(DrivingEventKind::Halt));
            trip_log.note(&event(DrivingEventKind::SetOff { stood }));
        }
        trip_log.note(&event(DrivingEventKind::Halt));
        trip_log.note(&event(DrivingEventKind::RouteChange));
        trip_log.note(&DrivingEvent { vehicle: 4, ..event(DrivingEventKind::Halt) });
        let trip = trip_log.of(0).copied();
        assert_eq!(
            trip.map(|it| (it.stops, it.stood, it.route_changes, it.missed_turns)),
            Some((3, 5.5, 1, 0))
        );
    }
}
