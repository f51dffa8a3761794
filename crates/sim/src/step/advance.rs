//! Vehicles move, and drivers take note of what they decided. The only place where a lane's own entries change.

use laneweave_models::Style;

use crate::driver::plan::{Outbox, Plan, Progress};
use crate::junction::reservations::NO_RESERVATION;
use crate::state::clock::Clock;
use crate::state::goal::TripEnd;
use crate::state::lane::{Car, Counterpart, Lane, Milestone, Mind, Motion, Phase, Reached};
use crate::view::pose::crossing;
use laneweave_network::{ChainIndex, Position};

/// How fast a desired speed above a new, lower limit comes down [m/s²].
const EASING: f64 = 1.5;

/// Where vehicles go off a chain.
#[derive(Clone, Copy)]
pub(crate) struct Ends<'a> {
    /// Its length [m].
    pub(crate) length: f64,
    /// Where trips end before that.
    pub(crate) trips: &'a [TripEnd],
}

/// All vehicles of a lane move, and what else became of them is kept.
pub(crate) fn advance(
    lane: &mut Lane,
    chain: ChainIndex,
    ends: Ends,
    clock: Clock,
    characters: &[Style],
    plan: &mut Plan,
    outbox: &mut Outbox,
) {
    if lane.motions().is_empty() {
        outbox.empty.push(chain);
        return;
    }
    plan.notes.iter().for_each(|it| lane.prefetch_car(it.index));
    plan.upkeep.iter().for_each(|it| lane.prefetch_driver(it.index));
    take_note(lane, chain, clock, plan, outbox);
    lane.swap_motions(&mut plan.next);
    let mut has_ended = false;
    for upkeep in &plan.upkeep {
        let (motion, car, mind) = lane.entry_mut(upkeep.index as usize);
        car.in_emergency = upkeep.in_emergency;
        if car.desired != car.limit_desired {
            let eased = car.desired - (EASING * clock.dt) as f32;
            car.desired = eased.max(car.limit_desired);
        }
        if mind.reservation != NO_RESERVATION && !upkeep.reservation_is_over {
            let Motion { speed, id, .. } = *motion;
            let (slot, distance, desired) = (mind.reservation, upkeep.distance, f64::from(car.desired));
            outbox.progress.push(Progress { slot, id, distance, speed, desired });
        }
        if car.phase != Phase::Cruises {
            if let Some(counterpart) = &mut mind.counterpart {
                counterpart.x += upkeep.distance * f64::from(counterpart.stretch);
            }
            let manner = &characters[car.character as usize].manner;
            let step = crossing(manner, motion, mind).progress_in(clock.dt) as f32;
            has_ended |= go_across(motion, car, mind, chain, clock, step, outbox);
        }
        if car.needs_full_update {
            mind.lets_in = Mind::NOBODY;
            if upkeep.reservation_is_over {
                mind.reservation = NO_RESERVATION;
            }
            let minds_offside = characters[car.character as usize].change.minds_offside();
            car.needs_full_update =
                mind.last_place.is_finite() || mind.reservation != NO_RESERVATION || minds_offside;
        }
    }
    end_trips(lane, chain, ends.trips, plan, outbox);
    if has_ended {
        lane.remove_ended();
    }
    while let Some(entry) = lane.pop_beyond(ends.length) {
        outbox.leaving.push((chain, entry));
    }
}

/// Vehicles whose front bumpers passed the places that they go to in this step are gone.
fn end_trips(lane: &mut Lane, chain: ChainIndex, trips: &[TripEnd], plan: &Plan, outbox: &mut Outbox) {
    let (before, ended) = (&plan.next, &mut outbox.ended);
    ended.clear();
    for trip in trips {
        let (from, cars) = (lane.ahead_of(trip.station), lane.cars());
        let passed = before[from..].iter().zip(from..).take_while(|(it, _)| it.x <= trip.station);
        let ends = |index: usize| cars[index].goal == trip.goal && !cars[index].is_shadow;
        ended.extend(passed.map(|(_, index)| index).filter(|it| ends(*it)).map(|it| it as u32));
    }
    ended.sort_unstable_by(|a, b| b.cmp(a));
    for index in ended.iter() {
        outbox.arrived.push((chain, lane.remove(*index as usize)));
    }
}

/// Drivers who considered lanes keep in mind what they saw and resolved.
fn take_note(lane: &mut Lane, chain: ChainIndex, clock: Clock, plan: &mut Plan, outbox: &mut Outbox) {
    let cars = lane.cars_mut();
    for note in &plan.notes {
        let car = &mut cars[note.index as usize];
        car.due = note.due;
        car.limit_desired = note.limit_desired;
        car.standing = note.standing;
    }
    for concern in &plan.concerns {
        let (motion, car, mind) = lane.entry_mut(concern.index as usize);
        if let Some(destination) = concern.rerouted {
            car.goal = destination.into();
            car.due = clock.step + 1;
        }
        mind.last_place = concern.last_place;
        mind.urgency = concern.urgency;
        car.needs_full_update |= concern.last_place.is_finite() || concern.minds_offside;
        if concern.gives_up && car.phase == Phase::Wants {
            car.phase = Phase::Cruises;
            outbox.milestones.push(milestone(motion, mind, chain, Reached::Nothing));
        }
    }
}

/// A change is done at this share of its time: the steps add up to 1 but for rounding.
const DONE: f32 = 0.9999;

fn milestone(motion: &Motion, mind: &Mind, chain: ChainIndex, what: Reached) -> Milestone {
    Milestone {
        id: motion.id,
        record: mind.record,
        what,
        at: Position::new(chain, motion.x),
        shadow: mind.counterpart.map(|it| it.at()),
        speed: motion.speed,
    }
}

/// A change goes on by `step` of its time, or back. Both entries of a vehicle come to the same. Returns whether this
/// entry has ended.
fn go_across(
    motion: &Motion,
    car: &mut Car,
    mind: &mut Mind,
    chain: ChainIndex,
    clock: Clock,
    step: f32,
    outbox: &mut Outbox,
) -> bool {
    let was = mind.progress;
    match car.phase {
        Phase::Changes => {
            mind.progress = was + step;
            if was < 0.5 && mind.progress >= 0.5 {
                cross(car, mind);
                if !car.is_shadow {
                    outbox.milestones.push(milestone(motion, mind, chain, Reached::Crossing));
                }
            }
            if mind.progress < DONE {
                return false;
            }
        }
        Phase::Aborts => {
            mind.progress = was - step;
            if mind.progress > 0.0 {
                return false;
            }
        }
        Phase::Cruises | Phase::Wants => return false,
    }
    if car.is_shadow {
        car.phase = Phase::Cruises;
        return true;
    }
    let reached = if car.phase == Phase::Changes { Reached::End } else { Reached::Return };
    outbox.milestones.push(milestone(motion, mind, chain, reached));
    car.phase = Phase::Cruises;
    mind.progress = 0.0;
    mind.counterpart = None;
    car.due = clock.step + 1;
    false
}

/// The centre crosses the line: main entry and shadow swap their parts.
fn cross(car: &mut Car, mind: &mut Mind) {
    let scale = if car.is_shadow {
        mind.stretch
    } else {
        mind.counterpart.map_or(1.0, |counterpart| counterpart.stretch)
    };
    car.is_shadow = !car.is_shadow;
    let (own, other) = if car.is_shadow { (1.0 / scale, 1.0) } else { (1.0, 1.0 / scale) };
    mind.stretch = own;
    if let Some(Counterpart { stretch, .. }) = &mut mind.counterpart {
        *stretch = other;
    }
}
