//! Wait cycles: drivers each of whom waits for the space of the next, as on a full roundabout or around a full block.
//! None of them could go if each waited until the next one's space is free. Therefore they go together, each into the
//! space of the next.

use crate::driver::plan::ReservationRequest;
use crate::junction::need::Survey;
use crate::junction::waiting_priority::ZoneReservation;
use crate::right_of_way::applicant::Applicant;
use crate::right_of_way::may_pass::Asking;
use crate::state::standstill::STANDS;
use crate::step::grant_reservations::Granting;
use crate::view::scene::{Scene, Spot};

/// Largest number of standing vehicles from one waiting driver to the next in a cycle.
const LONGEST_QUEUE: usize = 100;
/// A vehicle with a smaller gap ahead stands in a queue [m]; others wait for something else (ours).
const QUEUES_WITHIN: f64 = 4.0;

/// Grants reservations to drivers who wait for each other's space. `waiting` are the drivers who wait for space, in
/// the order of ids.
pub(super) fn open_wait_cycles(granting: &mut Granting, waiting: &[ReservationRequest], survey: &mut Survey) {
    let scene = granting.scene();
    let spots: Vec<Option<Spot>> = waiting.iter().map(|it| spot(&scene, it)).collect();
    let next: Vec<Option<usize>> =
        spots.iter().map(|it| it.and_then(|it| waits_for(&scene, it, waiting))).collect();
    for cycle in wait_cycles(&next) {
        let members: Vec<(Spot, ReservationRequest)> =
            cycle.iter().filter_map(|it| Some((spots[*it]?, waiting[*it]))).collect();
        let_go_together(granting, &members, survey);
    }
}

/// Grants reservations to all `members` of a wait cycle, if each of them waits only for the space that the next one
/// frees. They then go even if a light changes.
fn let_go_together(granting: &mut Granting, members: &[(Spot, ReservationRequest)], survey: &mut Survey) {
    let mut holds: Vec<ZoneReservation> = Vec::new();
    let scene = granting.scene();
    let next = members.iter().cycle().skip(1);
    let may_go = members.iter().zip(next).all(|((spot, request), (next, _))| {
        let asking = Asking::of(&Applicant::at(&scene, *spot), request.since, granting.traffic.clock());
        let may = granting.may_after(*spot, asking, *next, survey);
        let crosses =
            |one: &ZoneReservation| holds.iter().any(|it| it.zone == one.zone && it.side != one.side);
        let is_apart = !survey.holds.iter().any(crosses);
        holds.extend(survey.holds.iter().copied());
        may && is_apart
    });
    if may_go {
        for (spot, request) in members {
            granting.grant_surveyed(*spot, request.since, survey);
            let slot = granting.traffic.lane(spot.chain).lane_change_states()[spot.index].reservation;
            granting.junctions.reservations_mut().goes_in_wait_cycle(slot);
        }
    }
}

fn spot(scene: &Scene, request: &ReservationRequest) -> Option<Spot> {
    let index = scene.lanes[request.chain.at()].find(request.id, request.x)?;
    Some(Spot { chain: request.chain, index })
}

/// The waiting driver at the head of the queue that the driver at `from` would join.
fn waits_for(scene: &Scene, from: Spot, waiting: &[ReservationRequest]) -> Option<usize> {
    let mut at = from;
    for _ in 0..LONGEST_QUEUE {
        at = scene.leader_spot(scene.viewpoint(at))?;
        let motion = scene.motion(at);
        if let Ok(place) = waiting.binary_search_by_key(&motion.id, |it| it.id) {
            return Some(place);
        }
        let is_in_queue = scene.ahead(scene.viewpoint(at)).is_some_and(|it| it.gap < QUEUES_WITHIN);
        if motion.speed > STANDS || !is_in_queue {
            return None;
        }
    }
    None
}

/// The cycles of a map from each index to the next one, each from its first index on.
fn wait_cycles(next: &[Option<usize>]) -> Vec<Vec<usize>> {
    const NEW: usize = usize::MAX;
    let mut seen = vec![NEW; next.len()];
    let mut wait_cycles = Vec::new();
    for first in 0..next.len() {
        let mut at = Some(first);
        while let Some(place) = at.filter(|it| seen[*it] == NEW) {
            seen[place] = first;
            at = next[place];
        }
        if let Some(start) = at.filter(|it| seen[*it] == first) {
            let mut cycle = vec![start];
            let mut place = next[start];
            while let Some(member) = place.filter(|it| *it != start) {
                cycle.push(member);
                place = next[member];
            }
            wait_cycles.push(cycle);
        }
    }
    wait_cycles
}

#[cfg(test)]
mod tests;
