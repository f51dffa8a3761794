//! The log of a run.

use laneweave_network::{ChainIndex, Network, Position};
use serde::{Deserialize, Serialize};

use crate::record::counters::Counters;
use crate::record::counts::Counts;
use crate::record::events::{DrivingEvent, DrivingEventKind, Event, LaneChange};
use crate::record::incidents::{Incident, IncidentKind, Touching};
use crate::record::lane_changes::Records;
use crate::record::lanelet_aggregates::{LaneletAggregate, LaneletAggregates, Mark};
use crate::record::trip_log::{TripLog, TripRecord};
use crate::record::trips::Trips;
use crate::state::clock::Clock;
use crate::state::externals::{FIRST_INSERTED, FIRST_OBSTACLE};
use crate::state::lane::{DriverState, Entry, Kinematics, Lane, LaneChangeKind, Phase, VehicleId};
use crate::state::milestone::{Milestone, Reached};

/// Lane changes under way, trips, counts and incidents.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Log {
    /// The lane changes under way.
    records: Records,
    trips: Trips,
    /// The trip log, if trips are recorded.
    trip_log: Option<TripLog>,
    /// The lanelet aggregates, if trips are recorded.
    aggregates: Option<LaneletAggregates>,
    /// Events of the last step.
    #[serde(skip)]
    events: Vec<Event>,
    /// The pairs of vehicles that touch.
    touching: Touching,
    /// Whether the world checks for overlaps at every step.
    #[serde(skip)]
    is_audited: bool,
    counts: Counts,
}

impl Log {
    /// Records every trip from now on until it ends, and what vehicles do on every lanelet of `network`.
    pub(crate) fn record_trips(&mut self, network: &Network) {
        self.trip_log = Some(TripLog::default());
        self.aggregates = Some(LaneletAggregates::new(network));
    }

    /// Makes the world check for overlaps at every step from now on.
    pub(crate) fn audit(&mut self) {
        self.is_audited = true;
    }

    /// Whether the world checks for overlaps at every step.
    pub(crate) fn is_audited(&self) -> bool {
        self.is_audited
    }

    /// Begins a step: clears the events.
    pub(crate) fn begin_step(&mut self) {
        self.events.clear();
    }

    /// Events of the last step.
    pub(crate) fn events(&self) -> &[Event] {
        &self.events
    }

    pub(crate) fn counts(&self) -> &Counts {
        &self.counts
    }

    /// Resets the counts. The `on_road` vehicles on the road count as entered.
    pub(crate) fn reset_counts(&mut self, on_road: usize) {
        self.counts = Counts { entered: on_road as u64, ..Counts::default() };
    }

    pub(crate) fn reset_lanelet_aggregates(&mut self, network: &Network) {
        self.aggregates = self.aggregates.as_ref().map(|_| LaneletAggregates::new(network));
    }

    /// The record of the trip of a vehicle on the road, if trips are recorded.
    pub(crate) fn trip(&self, id: VehicleId) -> Option<&TripRecord> {
        self.trip_log.as_ref()?.of(id)
    }

    /// The same record, mutable.
    pub(crate) fn trip_mut(&mut self, id: VehicleId) -> Option<&mut TripRecord> {
        self.trip_log.as_mut()?.of_mut(id)
    }

    /// Begins the trip of a vehicle that came onto the road. It takes `free_time` [s] on a free road. `record` makes
    /// its record, if trips are recorded.
    pub(crate) fn begin_trip(
        &mut self,
        id: VehicleId,
        free_time: Option<f64>,
        record: impl FnOnce() -> TripRecord,
    ) {
        self.trips.begin(id, free_time);
        if let Some(trip_log) = &mut self.trip_log {
            trip_log.begin(record());
        }
        self.counts.entered += 1;
    }

    /// Records that a vehicle entered by the demand, from this origin.
    pub(crate) fn note_origin(&mut self, id: VehicleId, origin: usize) {
        if let Some(record) = self.trip_mut(id) {
            record.origin = Some(origin);
        }
        self.events.push(Event::Entered(id));
    }

    /// Records an event of a vehicle during its trip.
    pub(crate) fn note_driving(&mut self, event: DrivingEvent) {
        if event.kind == DrivingEventKind::Halt {
            self.trips.stop(event.vehicle);
        }
        self.trip_log.iter_mut().for_each(|it| it.note(&event));
        self.events.push(Event::Driving(event));
    }

    /// Ends the trip of the vehicle of `entry`, which left the map from the chain `from`.
    pub(crate) fn end_trip(&mut self, network: &Network, clock: Clock, from: ChainIndex, entry: &Entry) {
        let Entry { motion, lane_change, .. } = *entry;
        let duration = f64::from(clock.step - lane_change.entered) * clock.dt;
        let trip = self.trips.end(motion.id);
        self.counts.left += 1;
        self.counts.trip_time += duration;
        self.counts.stops += u64::from(trip.stops());
        if let Some(delay) = trip.delay(duration) {
            self.counts.planned += 1;
            self.counts.delay += delay;
        }
        let length = network.chain(from).length;
        let end = Mark::at(motion.x.min(length), &motion, clock);
        self.leave_chain(network, motion.id, from, [end; 2]);
        if motion.x > length {
            self.pass_end(network, from);
        }
        let trip = self.trip_log.as_mut().and_then(|it| it.end(motion.id));
        self.events.push(Event::Left { vehicle: motion.id, duration, chain: from, motion, trip });
    }

    /// Counts and reports a vehicle that a user put on the road.
    pub(crate) fn note_inserted(&mut self, id: VehicleId) {
        self.counts.inserted += 1;
        self.events.push(Event::Entered(id));
    }

    /// Ends the trip of the vehicle of `entry`, which a user took off the road on `chain`. It does not count as
    /// completed.
    pub(crate) fn remove_trip(&mut self, network: &Network, clock: Clock, chain: ChainIndex, entry: &Entry) {
        let motion = entry.motion;
        self.trips.end(motion.id);
        self.counts.removed += 1;
        self.leave_chain(network, motion.id, chain, [Mark::at(motion.x, &motion, clock); 2]);
        self.trip_log.as_mut().and_then(|it| it.end(motion.id));
        self.events.push(Event::Removed { vehicle: motion.id, at: Position::new(chain, motion.x) });
    }

    /// Records that a user gave a driver another destination.
    pub(crate) fn set_destination(&mut self, id: VehicleId, number: Option<usize>) {
        if let Some(trip) = self.trip_mut(id) {
            trip.destination = number;
        }
    }

    /// Records that the vehicle of `entry` passed the end of the chain `from` and goes on.
    pub(crate) fn go_on(&mut self, network: &Network, clock: Clock, from: ChainIndex, entry: &Entry) {
        let (id, length) = (entry.motion.id, network.chain(from).length);
        if let Some(trip) = self.trip_mut(id) {
            trip.way_to_start += length;
        }
        let end = Mark::at(length, &entry.motion, clock);
        self.leave_chain(network, id, from, [end, Mark { x: 0.0, ..end }]);
        self.pass_end(network, from);
    }

    /// Records that a user moved a vehicle from one position to another; `None` stands for no lane. Its front bumper
    /// has driven `extra` metres more than the difference of its stations.
    pub(crate) fn relocate(
        &mut self,
        network: &Network,
        clock: Clock,
        motion: &Kinematics,
        [from, at]: [Option<Position>; 2],
        extra: f64,
    ) {
        let Some(trip) = self.trip_mut(motion.id) else { return };
        trip.way_to_start += extra;
        let there = Mark { x: motion.x, time: clock.time() };
        match (from, at) {
            (Some(from), Some(at)) if from.chain == at.chain && at.x >= from.x => {}
            (Some(from), _) => {
                self.leave_chain(network, motion.id, from.chain, [Mark { x: from.x, ..there }, there])
            }
            (None, _) => trip.mark = there,
        }
        let goes_on =
            |(from, at): (Position, Position)| network.chain(from.chain).following.contains(&at.chain);
        if let Some(from) = from.filter(|from| at.is_some_and(|at| goes_on((*from, at)))) {
            self.pass_end(network, from.chain);
        }
    }

    /// Records what a vehicle did on the chain `from` up to the first mark, if trips are recorded. It goes on from the
    /// second mark.
    fn leave_chain(&mut self, network: &Network, id: VehicleId, from: ChainIndex, [there, on]: [Mark; 2]) {
        let (Some(aggregates), Some(trip_log)) = (&mut self.aggregates, &mut self.trip_log) else { return };
        if let Some(trip) = trip_log.of_mut(id) {
            aggregates.note(network.chain(from), [std::mem::replace(&mut trip.mark, on), there]);
        }
    }

    fn pass_end(&mut self, network: &Network, chain: ChainIndex) {
        self.aggregates.iter_mut().for_each(|it| it.pass_end(network.chain(chain)));
    }

    /// Records what vehicles did on the lanelets up to now, if trips are recorded.
    pub(crate) fn put_down(&mut self, network: &Network, lanes: &[Lane], clock: Clock) {
        if let (Some(aggregates), Some(trip_log)) = (&mut self.aggregates, &mut self.trip_log) {
            aggregates.look(network, lanes, trip_log, clock);
        }
    }

    /// What vehicles did on each lanelet up to now, if trips are recorded. It works on a copy: the question does not
    /// change what is recorded later.
    pub(crate) fn lanelet_aggregates(
        &self,
        network: &Network,
        lanes: &[Lane],
        clock: Clock,
    ) -> Vec<LaneletAggregate> {
        let mut copy =
            Log { aggregates: self.aggregates.clone(), trip_log: self.trip_log.clone(), ..Log::default() };
        copy.put_down(network, lanes, clock);
        copy.aggregates.filter(|_| copy.trip_log.is_some()).map_or_else(Vec::new, |it| it.stays)
    }

    /// Stores the record of a lane change, and returns its slot.
    pub(crate) fn keep_change(&mut self, record: LaneChange) -> u32 {
        self.records.keep(record)
    }

    /// The record of a lane change under way.
    pub(crate) fn change_mut(&mut self, slot: u32) -> &mut LaneChange {
        self.records.get_mut(slot)
    }

    /// Records a milestone of a lane change at `time` [s].
    pub(crate) fn note_milestone(&mut self, network: &Network, milestone: &Milestone, time: f64) {
        match milestone.what {
            Reached::Nothing => self.records.release(milestone.record),
            Reached::Crossing => self.note_crossing(network, milestone, time),
            Reached::End | Reached::Return => {
                let mut record = *self.records.get_mut(milestone.record);
                self.records.release(milestone.record);
                record.duration = time - record.started;
                if !record.is_completed {
                    record.time = time;
                    record.from = milestone.at;
                    record.to = milestone.shadow.unwrap_or(milestone.at);
                }
                self.events.push(Event::LaneChange(record));
            }
        }
    }

    fn note_crossing(&mut self, network: &Network, milestone: &Milestone, time: f64) {
        let record = self.records.get_mut(milestone.record);
        record.time = time;
        record.speed = milestone.speed;
        record.is_completed = true;
        record.to = milestone.at;
        record.from = milestone.shadow.unwrap_or(milestone.at);
        let LaneChange { kind, from: Position { chain: from, x }, to: Position { x: x_there, .. }, .. } =
            *record;
        match kind {
            LaneChangeKind::Discretionary => self.counts.discretionary_changes += 1,
            LaneChangeKind::Route => self.counts.route_changes += 1,
            LaneChangeKind::Keeping => self.counts.keeping_changes += 1,
        }
        if let Some(trip) = self.trip_mut(milestone.id) {
            trip.way_to_start += x - x_there;
            trip.lane_changes += 1;
        }
        self.leave_chain(network, milestone.id, from, [x, x_there].map(|x| Mark { x, time }));
    }

    /// Counts and reports the vehicles that began to touch each other, of all pairs `seen` to touch. If all vehicles
    /// were `watched`, a pair that was not seen no longer touches.
    pub(crate) fn note_incidents(
        &mut self,
        seen: &mut Vec<Incident>,
        counters: &mut Counters,
        watched: bool,
    ) {
        let Log { touching: Touching(touching), events, counts, .. } = self;
        // If both vehicles report an incident, the more serious report counts.
        let gravity = |it: &Incident| it.kind == IncidentKind::Overlap;
        seen.sort_unstable_by(|a, b| {
            a.vehicles.cmp(&b.vehicles).then(gravity(a).cmp(&gravity(b))).then(b.depth.total_cmp(&a.depth))
        });
        seen.dedup_by_key(|it| it.vehicles);
        for incident in seen.iter() {
            let Err(place) = touching.binary_search(&incident.vehicles) else { continue };
            touching.insert(place, incident.vehicles);
            match incident.kind {
                IncidentKind::Collision => counters.collisions += 1,
                IncidentKind::Overlap => counters.overlaps += 1,
            }
            counts.first_incident.get_or_insert(*incident);
            events.push(Event::Incident(*incident));
        }
        if watched {
            touching.retain(|pair| seen.binary_search_by_key(pair, |it| it.vehicles).is_ok());
        }
        seen.clear();
    }

    /// Continues from a saved log. The checks for overlaps stay as they are.
    pub(crate) fn restore(&mut self, saved: Log) {
        *self = Log { is_audited: self.is_audited, ..saved };
    }

    /// Whether it knows all vehicles on these lanes, and those with the ids `off_road`, and whether the vehicles with
    /// the ids `waiting` can still begin their trips. `next_ids` are the first unused ids, of the demand and of users.
    pub(crate) fn fits(
        &self,
        network: &Network,
        lanes: &[Lane],
        mut off_road: impl Iterator<Item = VehicleId>,
        waiting: &[VehicleId],
        next_ids: [VehicleId; 2],
    ) -> bool {
        let Log { records, trips, trip_log, aggregates, events: _, touching: _, is_audited: _, counts: _ } =
            self;
        let is_given = |id: VehicleId| id < next_ids[usize::from(id >= FIRST_INSERTED)];
        let knows =
            |id: VehicleId| is_given(id) && trips.has(id) && trip_log.as_ref().is_none_or(|it| it.has(id));
        let lane_fits = |lane: &Lane| {
            let mut changes = lane
                .drivers()
                .iter()
                .zip(lane.lane_change_states())
                .filter(|(it, _)| it.phase != Phase::Cruises);
            let is_obstacle = |id: VehicleId, it: &DriverState| id >= FIRST_OBSTACLE && it.is_shadow;
            let mut entries = lane.motions().iter().map(|it| it.id).zip(lane.drivers());
            entries.all(|(id, driver)| is_obstacle(id, driver) || knows(id))
                && changes.all(|(_, it)| records.has(it.record))
        };
        let count = waiting.len();
        let trip_log_fits = |it: &TripLog| it.fits(network.chains.len()) && it.reach(next_ids, count);
        records.is_sound()
            && trip_log.as_ref().is_none_or(trip_log_fits)
            && aggregates.as_ref().is_none_or(|it| it.stays.len() == network.lanelets.len())
            && lanes.iter().all(lane_fits)
            && off_road.all(knows)
            && trips.reach(next_ids, count)
            && waiting.iter().all(|it| *it < next_ids[0] && trips.can_begin(*it))
    }
}
