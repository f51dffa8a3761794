//! Requests that concern other lanes are granted one after the other, the most pressing first: of two drivers who
//! want one gap exactly one goes, whoever asked first and on whichever thread.

use laneweave_network::ChainIndex;

use crate::decide::gap;
use crate::events::{Event, LaneChange};
use crate::plan::{Ask, Request, Want};
use crate::scene::Spot;
use crate::traffic::{Car, Milestone, Mind, Phase, Reached, Twin};
use crate::world::World;

impl World {
    /// Gathers what concerns more than one lane.
    pub(crate) fn gather(&mut self) {
        for (index, plan) in self.plans.iter_mut().enumerate() {
            let from = ChainIndex(index as u32);
            // What is empty is not written to: its cache line stays with the thread that has it.
            if !plan.requests.is_empty() {
                self.requests.append(&mut plan.requests);
            }
            if !plan.milestones.is_empty() {
                self.milestones.append(&mut plan.milestones);
            }
            if !plan.leaving.is_empty() {
                self.leaving.extend(plan.leaving.drain(..).map(|(car, mind)| (from, car, mind)));
            }
        }
    }

    /// Grants what can be granted.
    pub(crate) fn resolve(&mut self) {
        let mut requests = std::mem::take(&mut self.requests);
        requests.sort_unstable_by(|a, b| {
            b.urgency.total_cmp(&a.urgency).then(a.id.cmp(&b.id)).then(a.ask.rank().cmp(&b.ask.rank()))
        });
        for request in requests.drain(..) {
            let Some(index) = self.lanes[request.chain.at()].find(request.id, request.x) else { continue };
            self.grant(Spot { chain: request.chain, index }, &request);
        }
        self.requests = requests;
    }

    fn grant(&mut self, spot: Spot, request: &Request) {
        let lane = &self.lanes[spot.chain.at()];
        let (phase, progress) = (lane.cars()[spot.index].phase, lane.minds()[spot.index].progress);
        match request.ask {
            Ask::Want(want) if phase == Phase::Cruises => self.begin_to_want(spot, request, &want),
            Ask::Change if phase == Phase::Wants => self.begin_to_change(spot),
            Ask::LetIn { follower, chain, x, gap, speed } => {
                if let Some(index) = self.lanes[chain.at()].find(follower, x) {
                    let (cars, minds) = self.lanes[chain.at()].parts();
                    let manner = &self.characters[cars[index].character as usize].manner;
                    if manner.yield_deceleration > 0.0 && cars[index].phase == Phase::Cruises {
                        minds[index].lets_in = Some((gap, speed));
                        cars[index].heeds_more = true;
                    }
                }
            }
            // Who has crossed the line in the meantime goes on.
            Ask::Abort if phase == Phase::Changes && progress < 0.5 => self.turn_back(spot),
            _ => {}
        }
    }

    fn begin_to_want(&mut self, spot: Spot, request: &Request, want: &Want) {
        let step = self.clock.step;
        let (cars, minds) = self.lanes[spot.chain.at()].parts();
        let (car, mind) = (&mut cars[spot.index], &mut minds[spot.index]);
        car.phase = Phase::Wants;
        mind.side = want.side;
        mind.kind = want.kind;
        mind.since = step;
        mind.urgency = request.urgency;
        mind.record = self.records.keep(LaneChange {
            vehicle: car.id,
            character: car.character,
            class: car.class,
            started: 0.0,
            time: 0.0,
            duration: 0.0,
            from: (spot.chain, car.x),
            to: (spot.chain, car.x),
            side: want.side,
            kind: want.kind,
            speed: car.speed,
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
        let Some(gap) = gap(&scene, spot, mind.side) else { return };
        if gap.accepted(&scene, spot, self.clock.dt).is_err() {
            return;
        }
        let [gap_ahead, gap_behind, ttc_ahead, ttc_behind] = gap.measures(&scene, spot);
        let tightness = gap.tightness(&scene, spot) as f32;
        let time = self.clock.time();
        let record = self.records.get_mut(mind.record);
        *record = LaneChange { started: time, gap_ahead, gap_behind, ttc_ahead, ttc_behind, ..*record };
        let (cars, minds) = self.lanes[spot.chain.at()].parts();
        let (car, mind) = (&mut cars[spot.index], &mut minds[spot.index]);
        car.phase = Phase::Changes;
        car.tightness = tightness;
        mind.progress = 0.0;
        mind.since = self.clock.step;
        mind.twin = Some(Twin { chain: gap.chain, x: gap.x, stretch: gap.scale as f32 });
        let shadow = Car { x: gap.x, is_shadow: true, heeds_more: false, ..*car };
        let twin = Some(Twin { chain: spot.chain, x: car.x, stretch: 1.0 });
        let stretch = gap.scale as f32;
        let shadow_mind =
            Mind { twin, stretch, came_from: None, last_place: f64::INFINITY, lets_in: None, ..*mind };
        self.lanes[gap.chain.at()].insert(shadow, shadow_mind);
    }

    /// Both entries of a vehicle go back.
    fn turn_back(&mut self, spot: Spot) {
        let lane = &mut self.lanes[spot.chain.at()];
        let (cars, minds) = lane.parts();
        let id = cars[spot.index].id;
        cars[spot.index].phase = Phase::Aborts;
        if let Some(twin) = minds[spot.index].twin {
            let lane = &mut self.lanes[twin.chain.at()];
            if let Some(index) = lane.find(id, twin.x) {
                lane.parts().0[index].phase = Phase::Aborts;
            }
        }
    }

    /// Keeps account of the lane changes.
    pub(crate) fn account(&mut self) {
        let mut milestones = std::mem::take(&mut self.milestones);
        milestones.sort_unstable_by_key(|it| (it.id, it.what));
        for milestone in milestones.drain(..) {
            self.note_milestone(&milestone);
        }
        self.milestones = milestones;
    }

    fn note_milestone(&mut self, milestone: &Milestone) {
        let time = self.clock.time();
        match milestone.what {
            Reached::Nothing => {
                self.records.release(milestone.record);
                self.calm(milestone);
            }
            Reached::Crossing => {
                let record = self.records.get_mut(milestone.record);
                record.time = time;
                record.speed = milestone.speed;
                record.is_completed = true;
                record.to = milestone.at;
                record.from = milestone.shadow.unwrap_or(milestone.at);
                match record.kind {
                    crate::traffic::Kind::Discretionary => self.counts.discretionary_changes += 1,
                    crate::traffic::Kind::Route => self.counts.route_changes += 1,
                }
            }
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
                self.calm(milestone);
            }
        }
    }

    /// After a change, or giving one up, there is no new voluntary one for a while.
    fn calm(&mut self, milestone: &Milestone) {
        let (chain, x) = milestone.at;
        let lane = &mut self.lanes[chain.at()];
        if let Some(index) = lane.find(milestone.id, x) {
            let cars = lane.parts().0;
            let manner = &self.characters[cars[index].character as usize].manner;
            cars[index].calm_until = self.clock.step + self.clock.steps(manner.calm);
        }
    }

    /// Entries that passed the ends of their chains go on, or leave the map.
    pub(crate) fn transfer(&mut self) {
        let mut leaving = std::mem::take(&mut self.leaving);
        // A vehicle's main entry comes before its shadow.
        leaving.sort_unstable_by_key(|(_, car, _)| (car.id, car.is_shadow));
        let mut index = 0;
        while index < leaving.len() {
            let (from, car, mut mind) = leaving[index];
            index += 1;
            let onto = self.place_beyond(from, &car);
            if let Some((shadow_from, shadow, mut shadow_mind)) =
                leaving.get(index).copied().filter(|(_, it, _)| it.id == car.id)
            {
                index += 1;
                let shadow_onto = self.place_beyond(shadow_from, &shadow);
                mind.twin = relocated(mind.twin, shadow_onto);
                shadow_mind.twin = relocated(shadow_mind.twin, onto);
                if onto.is_some() && shadow_onto.is_some() {
                    self.go_on_or_leave(shadow_from, shadow_onto, shadow, shadow_mind);
                }
            }
            self.go_on_or_leave(from, onto, car, mind);
        }
        leaving.clear();
        self.leaving = leaving;
    }

    /// Where an entry that passed the end of its chain stands now.
    fn place_beyond(&self, from: ChainIndex, car: &Car) -> Option<(ChainIndex, f64)> {
        let next = self.navigator.waypoint(car.goal.destination(), from).next?;
        Some((next, car.x - self.network.chain(from).length))
    }

    fn go_on_or_leave(&mut self, from: ChainIndex, onto: Option<(ChainIndex, f64)>, car: Car, mind: Mind) {
        match onto {
            Some((next, _)) => self.go_on(from, next, car, mind),
            None => self.leave(from, car, mind),
        }
    }

    fn go_on(&mut self, from: ChainIndex, next: ChainIndex, mut car: Car, mut mind: Mind) {
        let length = self.network.chain(from).length;
        car.x -= length;
        mind.last_place -= length;
        mind.came_from = Some(from);
        let limit = self.network.chain(next).limit(car.x);
        let style = &self.characters[car.character as usize];
        car.limit_desired = car.class.desired_speed(style, limit) as f32;
        self.tell_twin(&car, &mind, Some((next, car.x)));
        self.lanes[next.at()].insert(car, mind);
    }

    /// A main entry leaves the map; a shadow on a lane that ends is no longer needed.
    fn leave(&mut self, from: ChainIndex, car: Car, mind: Mind) {
        if car.is_shadow {
            self.tell_twin(&car, &mind, None);
            return;
        }
        if let Some(twin) = mind.twin {
            let lane = &mut self.lanes[twin.chain.at()];
            if let Some(index) = lane.find(car.id, twin.x) {
                lane.remove(index);
            }
        }
        if matches!(car.phase, Phase::Changes | Phase::Wants | Phase::Aborts) {
            self.note_milestone(&Milestone {
                id: car.id,
                record: mind.record,
                what: if car.phase == Phase::Changes && mind.progress >= 0.5 {
                    Reached::End
                } else {
                    Reached::Nothing
                },
                at: (from, car.x),
                shadow: None,
                speed: car.speed,
            });
        }
        self.counts.left += 1;
        self.crowd -= 1;
        let duration = f64::from(self.clock.step - mind.entered) * self.clock.dt;
        self.counts.trip_time += duration;
        self.events.push(Event::Left { vehicle: car.id, duration });
    }

    /// Tells the other entry of a vehicle where this one stands now.
    fn tell_twin(&mut self, car: &Car, mind: &Mind, now: Option<(ChainIndex, f64)>) {
        let Some(twin) = mind.twin else { return };
        let lane = &mut self.lanes[twin.chain.at()];
        if let Some(index) = lane.find(car.id, twin.x) {
            let other = &mut lane.parts().1[index];
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
