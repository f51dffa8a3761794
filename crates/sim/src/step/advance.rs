//! Vehicles move, and drivers store what they decided. A lane's own entries change only here.

use laneweave_models::Style;

use crate::driver::plan::{Outbox, Plan, Progress};
use crate::junction::reservations::NO_RESERVATION;
use crate::state::clock::Clock;
use crate::state::goal::TripEnd;
use crate::state::lane::{Counterpart, DriverState, Kinematics, Lane, LaneChangeState, Phase};
use crate::state::milestone::{Milestone, Reached};
use crate::view::pose::crossing;
use laneweave_network::{ChainIndex, Position};

/// Where vehicles leave a chain.
#[derive(Clone, Copy)]
pub(crate) struct Ends<'a> {
    /// Its length [m].
    pub(crate) length: f64,
    /// The trip ends before that.
    pub(crate) trips: &'a [TripEnd],
}

/// Moves all vehicles of a lane, and carries out their plans.
pub(crate) fn advance(
    lane: &mut Lane,
    chain: ChainIndex,
    ends: Ends,
    clock: Clock,
    driver_parameters: &[Style],
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
        let (motion, driver, lane_change) = lane.entry_mut(upkeep.index as usize);
        driver.in_emergency = upkeep.in_emergency;
        if driver.desired != driver.limit_desired {
            let manner = &driver_parameters[driver.parameters as usize].manner;
            let eased = driver.desired - (driver.slowing(manner, clock) * clock.dt) as f32;
            driver.desired = eased.max(driver.limit_desired);
        }
        if lane_change.reservation != NO_RESERVATION && !upkeep.reservation_is_over {
            let Kinematics { speed, id, .. } = *motion;
            let (slot, distance, desired) =
                (lane_change.reservation, upkeep.distance, f64::from(driver.desired));
            outbox.progress.push(Progress { slot, id, distance, speed, desired });
        }
        if driver.phase != Phase::Cruises {
            if let Some(counterpart) = &mut lane_change.counterpart {
                counterpart.x += upkeep.distance * f64::from(counterpart.stretch);
            }
            let manner = &driver_parameters[driver.parameters as usize].manner;
            let step = crossing(manner, motion, lane_change)
                .progress_in(clock.dt, f64::from(upkeep.per_metre)) as f32;
            has_ended |= go_across(motion, driver, lane_change, chain, clock, step, outbox);
        }
        if driver.needs_full_update {
            lane_change.lets_in = LaneChangeState::NOBODY;
            if upkeep.reservation_is_over {
                lane_change.reservation = NO_RESERVATION;
            }
            driver.needs_full_update = lane_change.last_place.is_finite()
                || lane_change.reservation != NO_RESERVATION
                || lane_change.minds_offside;
        }
    }
    // Only an external vehicle drives through another one.
    let is_in_order = plan.controls.is_empty() || lane.is_in_order();
    end_trips(lane, chain, ends.trips, is_in_order, plan, outbox);
    if has_ended {
        lane.remove_ended();
    }
    if !is_in_order {
        lane.restore_order();
    }
    plan.controls.clear();
    while let Some(entry) = lane.pop_beyond(ends.length) {
        outbox.leaving.push((chain, entry));
    }
}

/// Removes vehicles whose front bumpers passed their trip ends in this step.
fn end_trips(
    lane: &mut Lane,
    chain: ChainIndex,
    trips: &[TripEnd],
    is_in_order: bool,
    plan: &Plan,
    outbox: &mut Outbox,
) {
    let (before, ended) = (&plan.next, &mut outbox.ended);
    ended.clear();
    for trip in trips {
        let drivers = lane.drivers();
        let from = if is_in_order { lane.ahead_of(trip.station) } else { 0 };
        let was_before = |index: &usize| before[*index].x <= trip.station;
        let passes = |index: &usize| was_before(index) && lane.motions()[*index].x > trip.station;
        let ends = |index: &usize| drivers[*index].goal == trip.goal && !drivers[*index].is_shadow;
        let near = (from..before.len()).take_while(|it| !is_in_order || was_before(it));
        ended.extend(near.filter(|it| passes(it) && ends(it)).map(|it| it as u32));
    }
    ended.sort_unstable_by(|a, b| b.cmp(a));
    for index in ended.iter() {
        outbox.arrived.push((chain, lane.remove(*index as usize)));
    }
}

/// Stores what drivers who considered lanes perceived and decided.
fn take_note(lane: &mut Lane, chain: ChainIndex, clock: Clock, plan: &mut Plan, outbox: &mut Outbox) {
    let drivers = lane.drivers_mut();
    for note in &plan.notes {
        let driver = &mut drivers[note.index as usize];
        driver.due = note.due;
        driver.limit_desired = note.limit_desired;
        driver.standing = note.standing;
    }
    for concern in &plan.concerns {
        let (motion, driver, lane_change) = lane.entry_mut(concern.index as usize);
        if let Some(destination) = concern.rerouted {
            driver.goal = destination.into();
            driver.due = clock.step + 1;
        }
        lane_change.last_place = concern.last_place;
        lane_change.urgency = concern.urgency;
        lane_change.minds_offside = concern.minds_offside;
        driver.needs_full_update |= concern.last_place.is_finite() || concern.minds_offside;
        if concern.gives_up && driver.phase == Phase::Wants {
            driver.phase = Phase::Cruises;
            outbox.milestones.push(milestone(motion, lane_change, chain, Reached::Nothing));
        }
    }
}

/// A change is complete at this share of its time: the steps add up to 1 except for rounding.
const DONE: f32 = 0.9999;
/// At this share its vehicle is across but for a millimetre: it is complete if the vehicle stands (ours).
const ACROSS: f32 = 0.97;
/// A vehicle that goes back is out of the other lane at this share of the time: its front bumper is a tenth of the way
/// across at most.
const OUT: f32 = 0.1;

fn milestone(
    motion: &Kinematics,
    lane_change: &LaneChangeState,
    chain: ChainIndex,
    what: Reached,
) -> Milestone {
    Milestone {
        id: motion.id,
        record: lane_change.record,
        what,
        at: Position::new(chain, motion.x),
        shadow: lane_change.counterpart.map(|it| it.at()),
        speed: motion.speed,
    }
}

/// Advances a change by `step` of its time, or moves it back. Both entries of a vehicle reach the same progress.
/// Returns whether this entry has ended.
fn go_across(
    motion: &Kinematics,
    driver: &mut DriverState,
    lane_change: &mut LaneChangeState,
    chain: ChainIndex,
    clock: Clock,
    step: f32,
    outbox: &mut Outbox,
) -> bool {
    let was = lane_change.progress;
    match driver.phase {
        Phase::Changes => {
            lane_change.progress = was + step;
            if was < 0.5 && lane_change.progress >= 0.5 {
                cross(driver, lane_change);
                if !driver.is_shadow {
                    outbox.milestones.push(milestone(motion, lane_change, chain, Reached::Crossing));
                }
            }
            if lane_change.progress < if step > 0.0 { DONE } else { ACROSS } {
                return false;
            }
        }
        Phase::Aborts => {
            lane_change.progress = was - step;
            if lane_change.progress > 0.0 {
                let is_out = lane_change.progress <= OUT;
                if is_out && driver.is_shadow {
                    driver.phase = Phase::Cruises;
                } else if is_out {
                    lane_change.counterpart = None;
                }
                return is_out && driver.is_shadow;
            }
        }
        Phase::Cruises | Phase::Wants => return false,
    }
    if driver.is_shadow {
        driver.phase = Phase::Cruises;
        return true;
    }
    let reached = if driver.phase == Phase::Changes { Reached::End } else { Reached::Return };
    outbox.milestones.push(milestone(motion, lane_change, chain, reached));
    driver.phase = Phase::Cruises;
    lane_change.progress = 0.0;
    lane_change.counterpart = None;
    driver.due = clock.step + 1;
    false
}

/// Lets the centre cross the line: main entry and shadow exchange their roles.
fn cross(driver: &mut DriverState, lane_change: &mut LaneChangeState) {
    let scale = if driver.is_shadow {
        lane_change.stretch
    } else {
        lane_change.counterpart.map_or(1.0, |counterpart| counterpart.stretch)
    };
    driver.is_shadow = !driver.is_shadow;
    let (own, other) = if driver.is_shadow { (1.0 / scale, 1.0) } else { (1.0, 1.0 / scale) };
    lane_change.stretch = own;
    if let Some(Counterpart { stretch, .. }) = &mut lane_change.counterpart {
        *stretch = other;
    }
}
