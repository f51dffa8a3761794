//! Passages are given, and given back: one after the other once all have moved, on the state in which it takes effect.

use laneweave_network::ZoneKind;

use crate::driver::plan::{Outbox, RequestKind, Waiting};
use crate::driver::request_passage::surveyed;
use crate::junction::claim::Hold;
use crate::junction::need::SPARE_ROOM;
use crate::right_of_way::applicant::Applicant;
use crate::right_of_way::conditions::{Asking, may_pass};
use crate::right_of_way::survey::stands_beyond;
use crate::step::world::World;
use crate::view::scene::Spot;

/// Of those who let each other go a vehicle may stand within zones by so much [m] until those before it have moved up:
/// a truck comes into the place of a car (ours).
const HANGS_OUT: f64 = 8.0;

impl World {
    /// Vehicles with a passage drove on: what is behind them is free for others.
    pub(crate) fn pass_on(&mut self) {
        let mut progress = std::mem::take(&mut self.work.outboxes[0].progress);
        progress.sort_unstable_by_key(|it| it.slot);
        for it in progress.drain(..) {
            if self.junctions.passages.of(it.slot, it.id).is_some() {
                self.junctions.passages.advance(it.slot, it.distance, it.speed, it.desired);
            }
        }
        self.work.outboxes[0].progress = progress;
    }

    /// Passages are given back, and given to those who may pass, who asked first before the others.
    pub(crate) fn give_passages(&mut self) {
        let mut passage_requests = std::mem::take(&mut self.work.outboxes[0].passage_requests);
        let mut claims = std::mem::take(&mut self.work.outboxes[0].claims);
        let mut survey = std::mem::take(&mut self.work.outboxes[0].survey);
        self.claims_at_entrances(&mut claims, &mut survey);
        self.work.outboxes[0].survey = survey;
        self.junctions.passages.clear_claims();
        claims.drain(..).for_each(|(zone, side, turn)| self.junctions.passages.note_claim(zone, side, turn));
        let rings = self.work.outboxes[0].rings.drain(..);
        rings.for_each(|(way, claim)| self.junctions.passages.rings.note_claim(way, claim));
        let wants = self.work.outboxes[0].wants.drain(..);
        wants.for_each(|(refuge, claim, needed)| self.junctions.passages.note_want(refuge, claim, needed));
        passage_requests.sort_unstable_by_key(|it| (matches!(it.what, RequestKind::Pass), it.since, it.id));
        for request in passage_requests.drain(..) {
            let Some(index) = self.traffic.lanes[request.chain.at()].find(request.id, request.x) else {
                continue;
            };
            let spot = Spot { chain: request.chain, index };
            match request.what {
                RequestKind::Pass => self.give_passage(spot, request.since),
                RequestKind::GiveBack(from) => {
                    let slot = self.traffic.lanes[spot.chain.at()].minds()[index].passage;
                    if self.junctions.passages.of(slot, request.id).is_some() {
                        self.junctions.passages.take_back(slot, from);
                        // It keeps its place among those who wait.
                        let (index, since) = (index as u32, self.junctions.passages.since(slot));
                        let waiting = Waiting { index, id: request.id, since, is_held: true };
                        self.work.plans[spot.chain.at()].waiting.push(waiting);
                    }
                }
            }
        }
        let mut blocked = std::mem::take(&mut self.work.outboxes[0].blocked);
        if blocked.len() > 1 && self.traffic.clock.step.is_multiple_of(self.traffic.clock.steps(1.0)) {
            blocked.sort_unstable_by_key(|it| it.id);
            self.rotate(&blocked);
        }
        blocked.clear();
        self.work.outboxes[0].blocked = blocked;
        self.work.outboxes[0].passage_requests = passage_requests;
        self.work.outboxes[0].claims = claims;
    }

    fn give_passage(&mut self, spot: Spot, since: u32) {
        let mut outbox = std::mem::take(&mut self.work.outboxes[0]);
        let scene = self.scene();
        let applicant = Applicant::at(&scene, spot);
        let asking = Asking::of(&applicant, since, self.traffic.clock);
        let may = surveyed(&scene, &applicant, &mut outbox.survey)
            && may_pass(&scene, &applicant, &outbox.survey, asking).is_ok();
        if may {
            self.give_surveyed(spot, since, &mut outbox);
        }
        self.work.outboxes[0] = outbox;
    }

    /// Whether the driver at `spot`, whose way is surveyed anew, may pass if the vehicle at `next` drives off, and
    /// leaves it its place. Who stays within a merge for that is in nobody's way but of those who come after.
    pub(crate) fn may_after(&self, spot: Spot, asking: Asking, next: Spot, outbox: &mut Outbox) -> bool {
        let (scene, survey) = (self.scene(), &mut outbox.survey);
        let applicant = Applicant::at(&scene, spot);
        if !surveyed(&scene, &applicant, survey) {
            return false;
        }
        let is_freed = stands_beyond(&scene, scene.viewpoint(spot), survey, next);
        let room = survey.room + f64::from(scene.motion(next).length) + SPARE_ROOM + HANGS_OUT;
        let is_merge =
            |it: &Hold| matches!(scene.network.junctions.zones[it.zone.at()].kind, ZoneKind::Merging(_));
        let fits = room >= survey.needed - asking.squeezes_into() || survey.holds.iter().all(is_merge);
        survey.room = f64::INFINITY;
        is_freed && fits && may_pass(&scene, &applicant, survey, asking).is_ok()
    }

    /// Gives the driver at `spot`, who first asked in step `since`, the passage that it needs next.
    pub(crate) fn give_surveyed(&mut self, spot: Spot, since: u32, outbox: &mut Outbox) {
        let scene = self.scene();
        surveyed(&scene, &Applicant::at(&scene, spot), &mut outbox.survey);
        let (motion, car, mind) = self.traffic.lanes[spot.chain.at()].entry_mut(spot.index);
        let length = f64::from(motion.length);
        mind.passage = self.junctions.passages.give(mind.passage, motion.id, length, &outbox.survey);
        self.junctions.passages.note_since(mind.passage, since);
        car.needs_full_update = true;
        let (speed, desired) = (motion.speed, f64::from(car.desired));
        self.junctions.passages.advance(mind.passage, 0.0, speed, desired);
    }
}
