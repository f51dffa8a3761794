//! Vehicles go on from chain to chain, and leave.

use laneweave_network::ChainIndex;

use crate::record::events::Event;
use crate::record::journal::TripRecord;
use crate::record::ledger::Mark;
use crate::state::traffic::{Entry, Milestone, Phase, Reached, Twin, VehicleId};
use crate::step::world::World;

impl World {
    /// Entries whose trips ended leave; those that passed the ends of their chains go on, or leave the map.
    pub(crate) fn transfer(&mut self) {
        let mut leaving = std::mem::take(&mut self.work.outboxes[0].leaving);
        self.end_trips(&mut leaving);
        // A vehicle's main entry comes before its shadow.
        leaving.sort_unstable_by_key(|(_, it)| (it.motion.id, it.car.is_shadow));
        let mut index = 0;
        while index < leaving.len() {
            let (from, mut entry) = leaving[index];
            index += 1;
            let onto = self.place_beyond(from, &entry);
            let own_shadow = leaving.get(index).filter(|(_, it)| it.motion.id == entry.motion.id);
            if let Some((shadow_from, mut shadow)) = own_shadow.copied() {
                index += 1;
                let shadow_onto = self.place_beyond(shadow_from, &shadow);
                entry.mind.twin = relocated(entry.mind.twin, shadow_onto);
                shadow.mind.twin = relocated(shadow.mind.twin, onto);
                if onto.is_some() && shadow_onto.is_some() {
                    self.go_on_or_leave(shadow_from, shadow_onto, shadow);
                }
            }
            self.go_on_or_leave(from, onto, entry);
        }
        leaving.clear();
        self.work.outboxes[0].leaving = leaving;
    }

    /// Entries whose trips ended leave, with their shadows, which may just have passed the ends of their own chains.
    fn end_trips(&mut self, leaving: &mut Vec<(ChainIndex, Entry)>) {
        let mut arrived = std::mem::take(&mut self.work.outboxes[0].arrived);
        arrived.sort_unstable_by_key(|(_, it)| it.motion.id);
        if !arrived.is_empty() {
            let is_gone = |id| arrived.binary_search_by_key(&id, |(_, it)| it.motion.id).is_ok();
            leaving.retain(|(_, it)| !is_gone(it.motion.id));
        }
        for (chain, entry) in arrived.drain(..) {
            self.leave(chain, entry);
        }
        self.work.outboxes[0].arrived = arrived;
    }

    /// Where an entry that passed the end of its chain stands now.
    fn place_beyond(&self, from: ChainIndex, entry: &Entry) -> Option<(ChainIndex, f64)> {
        let next = self.roads.navigator.next(&self.roads.network, entry.car.goal.destination(), from)?;
        Some((next, entry.motion.x - self.roads.network.chain(from).length))
    }

    fn go_on_or_leave(&mut self, from: ChainIndex, onto: Option<(ChainIndex, f64)>, entry: Entry) {
        match onto {
            Some((next, _)) => self.go_on(from, next, entry),
            None => self.leave(from, entry),
        }
    }

    fn go_on(&mut self, from: ChainIndex, next: ChainIndex, mut entry: Entry) {
        let length = self.roads.network.chain(from).length;
        if !entry.car.is_shadow {
            if let Some(trip) = self.record_mut(entry.motion.id) {
                trip.way_to_start += length;
            }
            let end = Mark::at(length, &entry.motion, self.traffic.clock);
            self.leave_chain(entry.motion.id, from, [end, Mark { x: 0.0, ..end }]);
            self.pass_end(from);
        }
        entry.motion.x -= length;
        entry.mind.last_place -= length;
        entry.mind.trail = entry.mind.trail.left(from);
        let limit = self.roads.network.chain(next).limit(entry.motion.x);
        let style = &self.roads.characters[entry.car.character as usize];
        entry.car.limit_desired = entry.car.class.desired_speed(style, limit) as f32;
        self.tell_twin(&entry, Some((next, entry.motion.x)));
        self.insert(next, entry);
    }

    /// A main entry leaves the map; a shadow on a lane that ends is no longer needed.
    fn leave(&mut self, from: ChainIndex, entry: Entry) {
        let Entry { motion, car, mind } = entry;
        if car.is_shadow {
            self.tell_twin(&entry, None);
            return;
        }
        if let Some(twin) = mind.twin {
            let lane = &mut self.traffic.lanes[twin.chain.at()];
            if let Some(index) = lane.find(motion.id, twin.x) {
                lane.remove(index);
            }
        }
        if car.phase != Phase::Cruises {
            let is_across = car.phase == Phase::Changes && mind.progress >= 0.5;
            self.note_milestone(&Milestone {
                id: motion.id,
                record: mind.record,
                what: if is_across { Reached::End } else { Reached::Nothing },
                at: (from, motion.x),
                shadow: None,
                speed: motion.speed,
            });
        }
        self.junctions.passages.end(mind.passage, motion.id);
        self.log.counts.left += 1;
        self.traffic.crowd -= 1;
        let duration = f64::from(self.traffic.clock.step - mind.entered) * self.traffic.clock.dt;
        self.log.counts.trip_time += duration;
        let trip = self.log.trips.end(motion.id);
        self.log.counts.stops += u64::from(trip.stops());
        if let Some(delay) = trip.delay(duration) {
            self.log.counts.planned += 1;
            self.log.counts.delay += delay;
        }
        let length = self.roads.network.chain(from).length;
        let end = Mark::at(motion.x.min(length), &motion, self.traffic.clock);
        self.leave_chain(motion.id, from, [end; 2]);
        if motion.x > length {
            self.pass_end(from);
        }
        let trip = self.log.journal.as_mut().and_then(|it| it.end(motion.id));
        self.log.events.push(Event::Left { vehicle: motion.id, duration, chain: from, motion, trip });
    }

    /// The record of the trip of a vehicle on the road, where trips are recorded.
    pub(crate) fn record_mut(&mut self, id: VehicleId) -> Option<&mut TripRecord> {
        self.log.journal.as_mut()?.of_mut(id)
    }

    /// What a vehicle did on the chain `from` up to the first mark is put down, where trips are recorded; it goes on
    /// from the second.
    pub(super) fn leave_chain(&mut self, id: VehicleId, from: ChainIndex, [there, on]: [Mark; 2]) {
        let (Some(ledger), Some(journal)) = (&mut self.log.ledger, &mut self.log.journal) else { return };
        if let Some(trip) = journal.of_mut(id) {
            ledger.note(self.roads.network.chain(from), [std::mem::replace(&mut trip.mark, on), there]);
        }
    }

    /// A vehicle passed the end of `chain`.
    fn pass_end(&mut self, chain: ChainIndex) {
        if let Some(ledger) = &mut self.log.ledger {
            ledger.pass_end(self.roads.network.chain(chain));
        }
    }

    /// Tells the other entry of a vehicle where this one stands now.
    fn tell_twin(&mut self, entry: &Entry, now: Option<(ChainIndex, f64)>) {
        let Some(twin) = entry.mind.twin else { return };
        let lane = &mut self.traffic.lanes[twin.chain.at()];
        if let Some(index) = lane.find(entry.motion.id, twin.x) {
            let other = lane.entry_mut(index).2;
            other.twin = relocated(other.twin, now);
        }
    }
}

/// The twin at its new place, if it still has one.
fn relocated(twin: Option<Twin>, place: Option<(ChainIndex, f64)>) -> Option<Twin> {
    let (chain, x) = place?;
    twin.map(|old| Twin { chain, x, ..old })
}
