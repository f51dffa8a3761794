//! Requests that concern other lanes are granted one after the other, the most pressing first: of two drivers who
//! want one gap exactly one goes, whoever asked first and on whichever thread.

use laneweave_models::Concentration;
use laneweave_network::ChainIndex;

use crate::driver::attention::concentration;
use crate::driver::gap::gap;
use crate::driver::plan::{Ask, Request, Want};
use crate::junction::passages::NO_PASSAGE;
use crate::record::events::{Event, LaneChange};
use crate::record::journal::TripRecord;
use crate::record::ledger::Mark;
use crate::state::traffic::{Car, Entry, Milestone, Mind, Motion, Phase, Reached, Twin, VehicleId};
use crate::state::trail::Trail;
use crate::step::world::World;
use crate::view::scene::Spot;

impl World {
    /// Gathers what concerns more than one lane.
    pub(crate) fn gather(&mut self) {
        let [first, others @ ..] = &mut self.work.outboxes[..] else { return };
        others.iter_mut().for_each(|it| first.gather(it));
        if let Some(journal) = &mut self.log.journal {
            first.halts.iter().for_each(|id| journal.stop(*id));
            first.set_off.iter().for_each(|(id, stood)| journal.set_off(*id, f64::from(*stood)));
            first.reroutings.iter().for_each(|(id, why)| journal.reroute(*id, *why));
        }
        first.halts.drain(..).for_each(|id| self.log.trips.stop(id));
        first.set_off.clear();
        first.reroutings.clear();
        first.empty.drain(..).for_each(|chain| self.traffic.busy.forget(chain));
    }

    /// Grants what can be granted.
    pub(crate) fn resolve(&mut self) {
        let mut requests = std::mem::take(&mut self.work.outboxes[0].requests);
        requests.sort_unstable_by(|a, b| {
            b.urgency.total_cmp(&a.urgency).then(a.id.cmp(&b.id)).then(a.ask.rank().cmp(&b.ask.rank()))
        });
        for request in requests.drain(..) {
            let Some(index) = self.traffic.lanes[request.chain.at()].find(request.id, request.x) else {
                continue;
            };
            self.grant(Spot { chain: request.chain, index }, &request);
        }
        self.work.outboxes[0].requests = requests;
    }

    fn grant(&mut self, spot: Spot, request: &Request) {
        let lane = &self.traffic.lanes[spot.chain.at()];
        let (phase, progress) = (lane.cars()[spot.index].phase, lane.minds()[spot.index].progress);
        match request.ask {
            Ask::Want(want) if phase == Phase::Cruises => self.begin_to_want(spot, request, &want),
            Ask::Change if phase == Phase::Wants => self.begin_to_change(spot),
            Ask::LetIn { follower, chain, x, gap, speed } => {
                let since = lane.minds()[spot.index].since;
                let found = self.traffic.lanes[chain.at()].find(follower, x);
                let heeds = |index: &usize| {
                    let behind = Spot { chain, index: *index };
                    self.has_seen(behind, since) && !self.scene().has_passage(behind, f64::from(gap))
                };
                if let Some(index) = found.filter(heeds) {
                    let (_, car, mind) = self.traffic.lanes[chain.at()].entry_mut(index);
                    // Of two who want in before it the nearer comes first.
                    if car.phase == Phase::Cruises && gap < mind.lets_in.0 {
                        mind.lets_in = (gap, speed);
                        car.heeds_more = true;
                    }
                }
            }
            // Who has crossed the line in the meantime goes on.
            Ask::Abort if phase == Phase::Changes && progress < 0.5 => self.turn_back(spot),
            _ => {}
        }
    }

    /// Whether the driver at `spot` has seen who signals since the step `since`: an inattentive one sees of the lane beside
    /// what it saw when it last considered lanes.
    fn has_seen(&self, spot: Spot, since: u32) -> bool {
        let lane = &self.traffic.lanes[spot.chain.at()];
        let (id, car) = (lane.motions()[spot.index].id, &lane.cars()[spot.index]);
        let attention = &self.roads.characters[car.character as usize].attention;
        match concentration(attention, self.roads.random, id, self.traffic.clock.time()) {
            Concentration::Concentrated => true,
            // No longer than an epoch lies between its last consideration and the next, which is due.
            Concentration::Inattentive => {
                since + self.traffic.clock.steps(attention.inattentive.epoch) <= car.due
            }
        }
    }

    fn begin_to_want(&mut self, spot: Spot, request: &Request, want: &Want) {
        let step = self.traffic.clock.step;
        let (motion, car, mind) = self.traffic.lanes[spot.chain.at()].entry_mut(spot.index);
        car.phase = Phase::Wants;
        mind.side = want.side;
        mind.kind = want.kind;
        mind.since = step;
        mind.urgency = request.urgency;
        mind.record = self.log.records.keep(LaneChange {
            vehicle: motion.id,
            character: car.character,
            class: car.class,
            started: 0.0,
            time: 0.0,
            duration: 0.0,
            from: (spot.chain, motion.x),
            to: (spot.chain, motion.x),
            side: want.side,
            kind: want.kind,
            speed: motion.speed,
            speed_gain: f64::from(want.speed_gain),
            appraisal: want.appraisal,
            gap_ahead: f64::INFINITY,
            gap_behind: f64::INFINITY,
            ttc_ahead: f64::INFINITY,
            ttc_behind: f64::INFINITY,
            is_completed: false,
        });
    }

    /// Puts a shadow into the target lane, if the gap is still acceptable.
    fn begin_to_change(&mut self, spot: Spot) {
        let scene = self.scene();
        let mind = scene.lanes[spot.chain.at()].minds()[spot.index];
        // Who has just been given a passage keeps its lane.
        if scene.has_passage(spot, f64::NEG_INFINITY) {
            return;
        }
        let Some(gap) = gap(&scene, spot, mind.side) else { return };
        if gap.is_coming || gap.accepted(&scene, spot, self.traffic.clock.dt).is_err() {
            return;
        }
        let [gap_ahead, gap_behind, ttc_ahead, ttc_behind] = gap.measures(&scene, spot);
        let tightness = gap.tightness(&scene, spot) as f32;
        let time = self.traffic.clock.time();
        let record = self.log.records.get_mut(mind.record);
        *record = LaneChange { started: time, gap_ahead, gap_behind, ttc_ahead, ttc_behind, ..*record };
        let lane = &mut self.traffic.lanes[spot.chain.at()];
        let (motion, car, mind) = lane.entry_mut(spot.index);
        motion.tightness = tightness;
        car.phase = Phase::Changes;
        mind.progress = 0.0;
        mind.since = self.traffic.clock.step;
        let (x, stretch) = (gap.x, gap.scale as f32);
        mind.twin = Some(Twin { chain: gap.chain, x, stretch });
        let Entry { motion, car, mind } = lane.entry(spot.index);
        let shadow = Entry {
            motion: Motion { x, ..motion },
            car: Car { is_shadow: true, heeds_more: false, ..car },
            mind: Mind {
                twin: Some(Twin { chain: spot.chain, x: motion.x, stretch: 1.0 }),
                stretch,
                trail: Trail::NONE,
                last_place: f64::INFINITY,
                lets_in: Mind::NOBODY,
                passage: NO_PASSAGE,
                ..mind
            },
        };
        self.insert(gap.chain, shadow);
    }

    /// Both entries of a vehicle go back.
    fn turn_back(&mut self, spot: Spot) {
        let (motion, car, mind) = self.traffic.lanes[spot.chain.at()].entry_mut(spot.index);
        car.phase = Phase::Aborts;
        let (id, twin) = (motion.id, mind.twin);
        let Some(twin) = twin else { return };
        let lane = &mut self.traffic.lanes[twin.chain.at()];
        if let Some(index) = lane.find(id, twin.x) {
            lane.entry_mut(index).1.phase = Phase::Aborts;
        }
    }

    /// Keeps account of the lane changes.
    pub(crate) fn account(&mut self) {
        let mut milestones = std::mem::take(&mut self.work.outboxes[0].milestones);
        milestones.sort_unstable_by_key(|it| (it.id, it.what));
        for milestone in milestones.drain(..) {
            self.note_milestone(&milestone);
        }
        self.work.outboxes[0].milestones = milestones;
    }

    fn note_milestone(&mut self, milestone: &Milestone) {
        let time = self.traffic.clock.time();
        match milestone.what {
            Reached::Nothing => {
                self.log.records.release(milestone.record);
                self.calm(milestone);
            }
            Reached::Crossing => {
                let record = self.log.records.get_mut(milestone.record);
                record.time = time;
                record.speed = milestone.speed;
                record.is_completed = true;
                record.to = milestone.at;
                record.from = milestone.shadow.unwrap_or(milestone.at);
                let jump = record.from.1 - record.to.1;
                match record.kind {
                    crate::state::traffic::Kind::Discretionary => self.log.counts.discretionary_changes += 1,
                    crate::state::traffic::Kind::Route => self.log.counts.route_changes += 1,
                }
                let ((from, x), (_, x_there)) = (record.from, record.to);
                if let Some(trip) = self.record_mut(milestone.id) {
                    trip.way_to_start += jump;
                    trip.lane_changes += 1;
                }
                self.leave_chain(milestone.id, from, [x, x_there].map(|x| Mark { x, time }));
            }
            Reached::End | Reached::Return => {
                let mut record = *self.log.records.get_mut(milestone.record);
                self.log.records.release(milestone.record);
                record.duration = time - record.started;
                if !record.is_completed {
                    record.time = time;
                    record.from = milestone.at;
                    record.to = milestone.shadow.unwrap_or(milestone.at);
                }
                self.log.events.push(Event::LaneChange(record));
                self.calm(milestone);
            }
        }
    }

    /// After a change, or giving one up, there is no new voluntary one for a while.
    fn calm(&mut self, milestone: &Milestone) {
        let (chain, x) = milestone.at;
        let lane = &mut self.traffic.lanes[chain.at()];
        if let Some(index) = lane.find(milestone.id, x) {
            let car = lane.entry_mut(index).1;
            let manner = &self.roads.characters[car.character as usize].manner;
            car.calm_until = self.traffic.clock.step + self.traffic.clock.steps(manner.calm);
        }
    }

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

    /// What a vehicle did on the chain `from` up to the first mark is put down, where trips are recorded; it goes on from the second.
    fn leave_chain(&mut self, id: VehicleId, from: ChainIndex, [there, on]: [Mark; 2]) {
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

impl Ask {
    fn rank(&self) -> u8 {
        match self {
            Ask::Abort => 0,
            Ask::Change => 1,
            Ask::Want(_) => 2,
            Ask::LetIn { .. } => 3,
        }
    }
}
