//! Reservations are granted and revoked one after the other, once all vehicles have moved, on the state in which they
//! take effect.

use laneweave_network::ZoneKind;

use crate::driver::plan::{Outbox, RequestKind, ReservationRequest, Waiting};
use crate::driver::request_reservation::surveyed;
use crate::junction::need::{SPARE_SPACE, Survey};
use crate::junction::state::JunctionState;
use crate::junction::waiting_priority::ZoneReservation;
use crate::right_of_way::applicant::Applicant;
use crate::right_of_way::may_pass::{Asking, may_pass};
use crate::right_of_way::survey::stands_beyond;
use crate::route::roads::Roads;
use crate::state::traffic::Traffic;
use crate::step::wait_cycles::open_wait_cycles;
use crate::step::work::Work;
use crate::view::scene::{Scene, Spot};

/// Advances the reservations of vehicles that drove on. The zones behind them become free for others.
pub(crate) fn advance_reservations(junctions: &mut JunctionState, work: &mut Work) {
    let (reservations, progress) = (junctions.reservations_mut(), &mut work.outbox().progress);
    progress.sort_unstable_by_key(|it| it.slot);
    for it in progress.drain(..) {
        if reservations.of(it.slot, it.id).is_some() {
            reservations.advance(it.slot, it.distance, it.speed, it.desired);
        }
    }
}

/// Revokes reservations, then grants them to drivers who may pass, the earliest request first.
pub(crate) fn grant_reservations(
    roads: &Roads,
    traffic: &mut Traffic,
    junctions: &mut JunctionState,
    work: &mut Work,
) {
    let Outbox { priorities, roundabouts, space_requests, .. } = work.outbox();
    let reservations = junctions.reservations_mut();
    reservations.clear_priorities();
    priorities.drain(..).for_each(|(zone, side, turn)| reservations.note_priority(zone, side, turn));
    roundabouts.drain(..).for_each(|(way, priority)| reservations.roundabouts.note_priority(way, priority));
    space_requests
        .drain(..)
        .for_each(|(section, priority, needed)| reservations.note_space_request(section, priority, needed));
    let mut granting = Granting { roads, traffic, junctions };
    let mut requests = std::mem::take(&mut work.outbox().reservation_requests);
    requests.sort_unstable_by_key(|it| (matches!(it.what, RequestKind::Pass), it.since, it.id));
    requests.drain(..).for_each(|it| granting.answer(&it, work));
    let Outbox { reservation_requests, blocked, survey, .. } = work.outbox();
    *reservation_requests = requests;
    if blocked.len() > 1 && granting.traffic.clock().begins_a_second() {
        blocked.sort_unstable_by_key(|it| it.id);
        open_wait_cycles(&mut granting, blocked, survey);
    }
    blocked.clear();
}

/// What granting a reservation changes, and what it depends on.
pub(super) struct Granting<'a> {
    pub(super) roads: &'a Roads,
    pub(super) traffic: &'a mut Traffic,
    pub(super) junctions: &'a mut JunctionState,
}

impl Granting<'_> {
    pub(super) fn scene(&self) -> Scene<'_> {
        Scene::of(self.roads, self.traffic, self.junctions)
    }

    /// Grants the requested reservation if possible, or revokes it.
    fn answer(&mut self, request: &ReservationRequest, work: &mut Work) {
        let ReservationRequest { since, id, chain, x, what } = *request;
        let Some(index) = self.traffic.lane(chain).find(id, x) else { return };
        let spot = Spot { chain, index };
        // The vehicle has been moved, and only touches this lane.
        if self.traffic.lane(chain).drivers()[index].is_shadow {
            return;
        }
        match what {
            RequestKind::Pass => self.grant_if_it_may(spot, since, &mut work.outbox().survey),
            RequestKind::Revoke(from) => {
                let (slot, reservations) = (
                    self.traffic.lane(chain).lane_change_states()[index].reservation,
                    self.junctions.reservations_mut(),
                );
                if reservations.of(slot, id).is_some() {
                    reservations.revoke(slot, from);
                    // The driver keeps its waiting time.
                    let waiting =
                        Waiting { index: index as u32, id, since: reservations.since(slot), is_held: true };
                    work.plans[chain.at()].waiting.push(waiting);
                }
            }
        }
    }

    fn grant_if_it_may(&mut self, spot: Spot, since: u32, survey: &mut Survey) {
        let scene = self.scene();
        let applicant = Applicant::at(&scene, spot);
        let asking = Asking::of(&applicant, since, self.traffic.clock());
        if surveyed(&scene, &applicant, survey) && may_pass(&scene, &applicant, survey, asking).is_ok() {
            self.grant_surveyed(spot, since, survey);
        }
    }

    /// Surveys again, and checks whether the driver at `spot` may pass if the vehicle at `next` drives off and leaves
    /// its place. Then there has to be space for the front of its vehicle. The rest of it may stand within the zones
    /// until those before it have moved up, as where a truck takes the place of a car (ours). A driver who stands
    /// within a merge blocks only those that come after it.
    pub(super) fn may_after(&self, spot: Spot, asking: Asking, next: Spot, survey: &mut Survey) -> bool {
        let scene = self.scene();
        let applicant = Applicant::at(&scene, spot);
        if !surveyed(&scene, &applicant, survey) {
            return false;
        }
        let is_freed = stands_beyond(&scene, scene.viewpoint(spot), survey, next);
        let space = survey.space + f64::from(scene.motion(next).length) + SPARE_SPACE;
        let is_merge = |it: &ZoneReservation| {
            matches!(scene.network.junctions.zones[it.zone.at()].kind, ZoneKind::Merging(_))
        };
        let fits = space >= -asking.squeezes_into() || survey.holds.iter().all(is_merge);
        survey.space = f64::INFINITY;
        is_freed && fits && may_pass(&scene, &applicant, survey, asking).is_ok()
    }

    /// Grants the next reservation to the driver at `spot`, whose first request was in step `since`.
    pub(super) fn grant_surveyed(&mut self, spot: Spot, since: u32, survey: &mut Survey) {
        let scene = self.scene();
        surveyed(&scene, &Applicant::at(&scene, spot), survey);
        let (motion, driver, lane_change) = self.traffic.lane_mut(spot.chain).entry_mut(spot.index);
        let reservations = self.junctions.reservations_mut();
        lane_change.reservation =
            reservations.grant(lane_change.reservation, motion.id, f64::from(motion.length), survey);
        reservations.note_since(lane_change.reservation, since);
        driver.needs_full_update = true;
        reservations.advance(lane_change.reservation, 0.0, motion.speed, f64::from(driver.desired));
    }
}
