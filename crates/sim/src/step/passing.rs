//! Passages are given, and given back: one after the other once all have moved, on the state in which it takes effect.

use laneweave_network::ZoneKind;

use crate::demand::arrivals::Arrivals;
use crate::driver::plan::{Outbox, PassageRequest, RequestKind, Waiting};
use crate::driver::request_passage::surveyed;
use crate::junction::claim::Hold;
use crate::junction::need::{SPARE_ROOM, Survey};
use crate::junction::state::JunctionState;
use crate::right_of_way::applicant::Applicant;
use crate::right_of_way::conditions::{Asking, may_pass};
use crate::right_of_way::survey::stands_beyond;
use crate::route::roads::Roads;
use crate::state::traffic::Traffic;
use crate::step::reserve::claims_at_entrances;
use crate::step::rotation::rotate;
use crate::step::work::Work;
use crate::view::scene::{Scene, Spot};

/// Of those who let each other go a vehicle may stand within zones by so much [m] until those before it have moved up:
/// a truck comes into the place of a car (ours).
const HANGS_OUT: f64 = 8.0;

/// Vehicles with a passage drove on: what is behind them is free for others.
pub(crate) fn pass_on(junctions: &mut JunctionState, work: &mut Work) {
    let (passages, progress) = (junctions.passages_mut(), &mut work.outbox().progress);
    progress.sort_unstable_by_key(|it| it.slot);
    for it in progress.drain(..) {
        if passages.of(it.slot, it.id).is_some() {
            passages.advance(it.slot, it.distance, it.speed, it.desired);
        }
    }
}

/// Passages are given back, and given to those who may pass, who asked first before the others.
pub(crate) fn give_passages(
    roads: &Roads,
    traffic: &mut Traffic,
    junctions: &mut JunctionState,
    arrivals: &Arrivals,
    work: &mut Work,
) {
    let Outbox { claims, rings, wants, survey, .. } = work.outbox();
    let scene = Scene::of(roads, traffic, junctions);
    claims_at_entrances(&scene, arrivals, traffic.clock(), claims, survey);
    let passages = junctions.passages_mut();
    passages.clear_claims();
    claims.drain(..).for_each(|(zone, side, turn)| passages.note_claim(zone, side, turn));
    rings.drain(..).for_each(|(way, claim)| passages.rings.note_claim(way, claim));
    wants.drain(..).for_each(|(refuge, claim, needed)| passages.note_want(refuge, claim, needed));
    let mut giving = Giving { roads, traffic, junctions };
    let mut requests = std::mem::take(&mut work.outbox().passage_requests);
    requests.sort_unstable_by_key(|it| (matches!(it.what, RequestKind::Pass), it.since, it.id));
    requests.drain(..).for_each(|it| giving.answer(&it, work));
    let Outbox { passage_requests, blocked, survey, .. } = work.outbox();
    *passage_requests = requests;
    if blocked.len() > 1 && giving.traffic.clock().begins_a_second() {
        blocked.sort_unstable_by_key(|it| it.id);
        rotate(&mut giving, blocked, survey);
    }
    blocked.clear();
}

/// What giving a passage changes, and what it depends on.
pub(super) struct Giving<'a> {
    pub(super) roads: &'a Roads,
    pub(super) traffic: &'a mut Traffic,
    pub(super) junctions: &'a mut JunctionState,
}

impl Giving<'_> {
    pub(super) fn scene(&self) -> Scene<'_> {
        Scene::of(self.roads, self.traffic, self.junctions)
    }

    /// Gives what is requested if it can be given, or takes it back.
    fn answer(&mut self, request: &PassageRequest, work: &mut Work) {
        let PassageRequest { since, id, chain, x, what } = *request;
        let Some(index) = self.traffic.lane(chain).find(id, x) else { return };
        let spot = Spot { chain, index };
        match what {
            RequestKind::Pass => self.give_if_it_may(spot, since, &mut work.outbox().survey),
            RequestKind::GiveBack(from) => {
                let (slot, passages) =
                    (self.traffic.lane(chain).minds()[index].passage, self.junctions.passages_mut());
                if passages.of(slot, id).is_some() {
                    passages.take_back(slot, from);
                    // It keeps its place among those who wait.
                    let waiting =
                        Waiting { index: index as u32, id, since: passages.since(slot), is_held: true };
                    work.plans[chain.at()].waiting.push(waiting);
                }
            }
        }
    }

    fn give_if_it_may(&mut self, spot: Spot, since: u32, survey: &mut Survey) {
        let scene = self.scene();
        let applicant = Applicant::at(&scene, spot);
        let asking = Asking::of(&applicant, since, self.traffic.clock());
        if surveyed(&scene, &applicant, survey) && may_pass(&scene, &applicant, survey, asking).is_ok() {
            self.give_surveyed(spot, since, survey);
        }
    }

    /// Whether the driver at `spot`, whose way is surveyed anew, may pass if the vehicle at `next` drives off, and
    /// leaves it its place. Who stays within a merge for that is in nobody's way but of those who come after.
    pub(super) fn may_after(&self, spot: Spot, asking: Asking, next: Spot, survey: &mut Survey) -> bool {
        let scene = self.scene();
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
    pub(super) fn give_surveyed(&mut self, spot: Spot, since: u32, survey: &mut Survey) {
        let scene = self.scene();
        surveyed(&scene, &Applicant::at(&scene, spot), survey);
        let (motion, car, mind) = self.traffic.lane_mut(spot.chain).entry_mut(spot.index);
        let passages = self.junctions.passages_mut();
        mind.passage = passages.give(mind.passage, motion.id, f64::from(motion.length), survey);
        passages.note_since(mind.passage, since);
        car.needs_full_update = true;
        passages.advance(mind.passage, 0.0, motion.speed, f64::from(car.desired));
    }
}
