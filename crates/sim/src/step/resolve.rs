//! Requests that concern other lanes are granted one after the other, the most pressing first: of two drivers who
//! want one gap exactly one goes, whoever asked first and on whichever thread.

use laneweave_models::Concentration;

use crate::driver::attention::concentration;
use crate::driver::gap::gap;
use crate::driver::plan::{Ask, Request, Want};
use crate::junction::passages::NO_PASSAGE;
use crate::record::events::{DrivingEventKind, Event, LaneChange};
use crate::record::ledger::Mark;
use crate::state::traffic::{Car, Entry, Milestone, Mind, Motion, Phase, Reached, Twin};
use crate::state::trail::Trail;
use crate::step::world::World;
use crate::view::scene::Spot;

impl World {
    /// Gathers what concerns more than one lane.
    pub(crate) fn gather(&mut self) {
        let [first, others @ ..] = &mut self.work.outboxes[..] else { return };
        others.iter_mut().for_each(|it| first.gather(it));
        // Both entries of a vehicle between two lanes may have to tell of the same.
        first.driving.sort_unstable_by_key(|it| (it.vehicle, it.kind.rank(), it.x.to_bits(), it.chain));
        for event in first.driving.drain(..) {
            if event.kind == DrivingEventKind::Halt {
                self.log.trips.stop(event.vehicle);
            }
            self.log.journal.iter_mut().for_each(|it| it.note(&event));
            self.log.events.push(Event::Driving(event));
        }
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
                let sees_it = |index: &usize| {
                    let behind = Spot { chain, index: *index };
                    self.has_seen(behind, since) && !self.scene().has_passage(behind, f64::from(gap))
                };
                if let Some(index) = found.filter(sees_it) {
                    let (_, car, mind) = self.traffic.lanes[chain.at()].entry_mut(index);
                    // Of two who want in before it the nearer comes first.
                    if car.phase == Phase::Cruises && gap < mind.lets_in.0 {
                        mind.lets_in = (gap, speed);
                        car.needs_full_update = true;
                    }
                }
            }
            // Who has crossed the line in the meantime goes on.
            Ask::Abort if phase == Phase::Changes && progress < 0.5 => self.turn_back(spot),
            _ => {}
        }
    }

    /// Whether the driver at `spot` has seen who signals since the step `since`: an inattentive one sees of the lane
    /// beside what it saw when it last considered lanes.
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
            car: Car { is_shadow: true, needs_full_update: false, ..car },
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

    pub(super) fn note_milestone(&mut self, milestone: &Milestone) {
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
