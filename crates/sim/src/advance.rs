//! Vehicles move, and drivers take note of what they decided. The only place where a lane's own entries change.

use laneweave_models::Style;

use crate::clock::Clock;
use crate::plan::Plan;
use crate::pose::least_way;
use crate::traffic::{Car, Lane, Milestone, Mind, Phase, Reached, Twin};
use laneweave_network::ChainIndex;

/// How fast a desired speed above a new, lower limit comes down [m/s²].
const EASING: f64 = 1.5;
/// Distance to the last place for a change from which a driver in a wrong lane heeds it [m].
const HEEDED_WITHIN: f64 = 400.0;
/// Share of its usual pace at which a change goes on at standstill.
const SLOWEST_SHARE: f64 = 0.2;

/// All vehicles of a lane move.
pub(crate) fn advance(
    lane: &mut Lane,
    chain: ChainIndex,
    length: f64,
    clock: Clock,
    characters: &[Style],
    plan: &mut Plan,
) {
    take_note(lane, chain, clock, plan);
    let (cars, minds) = lane.parts();
    let mut has_ended = false;
    for (index, (car, mind)) in cars.iter_mut().zip(minds.iter_mut()).enumerate() {
        let stretch = if car.phase == Phase::Cruises { 1.0 } else { f64::from(mind.stretch) };
        let distance = drive(car, plan.accelerations[index], stretch, clock.dt);
        if !car.is_shadow {
            plan.tally.distance += distance;
            plan.tally.updates += 1;
        }
        let style = || &characters[car.character as usize];
        if car.tightness < 1.0 {
            car.tightness = style().manner.relaxed(f64::from(car.tightness), clock.dt) as f32;
        }
        if car.phase != Phase::Cruises {
            if let Some(twin) = &mut mind.twin {
                twin.x += distance * f64::from(twin.stretch);
            }
            let duration = style().manner.duration(f64::from(mind.urgency));
            has_ended |= go_across(car, mind, chain, clock, duration, plan);
        }
        if car.heeds_more {
            mind.lets_in = None;
            car.heeds_more = mind.last_place.is_finite();
        }
    }
    for index in plan.emergencies.drain(..) {
        cars[index as usize].in_emergency = true;
    }
    for index in plan.collisions.drain(..) {
        cars[index as usize].in_collision = true;
    }
    if has_ended {
        lane.remove_ended();
    }
    while let Some(entry) = lane.pop_beyond(length) {
        plan.leaving.push(entry);
    }
}

/// Moves one entry; returns the distance driven [m].
#[inline]
fn drive(car: &mut Car, acceleration: f64, stretch: f64, dt: f64) -> f64 {
    let next = car.speed + acceleration * dt;
    let (next, distance) = if next >= 0.0 {
        car.acceleration = acceleration as f32;
        (next, 0.5 * (car.speed + next) * dt)
    } else {
        car.acceleration = (-car.speed / dt) as f32;
        (0.0, -0.5 * car.speed * car.speed / acceleration)
    };
    car.x += distance * stretch;
    car.speed = next;
    if car.desired != car.limit_desired {
        let eased = car.desired - (EASING * dt) as f32;
        car.desired = eased.max(car.limit_desired);
    }
    car.in_emergency &= acceleration < 0.0;
    car.in_collision = false;
    distance
}

/// Drivers who considered lanes keep in mind what they saw and resolved.
fn take_note(lane: &mut Lane, chain: ChainIndex, clock: Clock, plan: &mut Plan) {
    let (cars, minds) = lane.parts();
    for note in plan.notes.drain(..) {
        let car = &mut cars[note.index as usize];
        car.due = note.due;
        car.limit_desired = note.limit_desired;
        if car.standing < STUCK_AFTER && note.standing >= STUCK_AFTER {
            plan.tally.stuck += 1;
        }
        car.standing = note.standing;
        if let Some(destination) = note.rerouted {
            car.goal = destination.into();
            car.due = clock.step + 1;
        }
        let is_near = note.last_place - car.x < HEEDED_WITHIN;
        if car.phase == Phase::Cruises && !car.heeds_more && !is_near {
            continue;
        }
        let mind = &mut minds[note.index as usize];
        mind.last_place = if is_near { note.last_place } else { f64::INFINITY };
        mind.urgency = note.urgency;
        car.heeds_more |= is_near;
        if note.gives_up && car.phase == Phase::Wants {
            car.phase = Phase::Cruises;
            plan.milestones.push(milestone(car, mind, chain, Reached::Nothing));
        }
    }
}

/// A change is done at this share of its time: the steps add up to 1 but for rounding.
const DONE: f32 = 0.9999;

/// A vehicle that stands this long is stuck [s].
const STUCK_AFTER: f32 = 300.0;

fn milestone(car: &Car, mind: &Mind, chain: ChainIndex, what: Reached) -> Milestone {
    Milestone {
        id: car.id,
        record: mind.record,
        what,
        at: (chain, car.x),
        shadow: mind.twin.map(|twin| (twin.chain, twin.x)),
        speed: car.speed,
    }
}

/// A change goes on, or back. Both entries of a vehicle come to the same. Returns whether this entry has ended.
fn go_across(
    car: &mut Car,
    mind: &mut Mind,
    chain: ChainIndex,
    clock: Clock,
    duration: f64,
    plan: &mut Plan,
) -> bool {
    // A slow vehicle needs way, not time.
    let pace = (car.speed * duration / least_way(car)).clamp(SLOWEST_SHARE, 1.0);
    let step = (pace * clock.dt / duration) as f32;
    let was = mind.progress;
    match car.phase {
        Phase::Changes => {
            mind.progress = was + step;
            if was < 0.5 && mind.progress >= 0.5 {
                cross(car, mind);
                if !car.is_shadow {
                    plan.milestones.push(milestone(car, mind, chain, Reached::Crossing));
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
    plan.milestones.push(milestone(car, mind, chain, reached));
    car.phase = Phase::Cruises;
    mind.progress = 0.0;
    mind.twin = None;
    car.due = clock.step + 1;
    false
}

/// The centre crosses the line: main entry and shadow swap their parts.
fn cross(car: &mut Car, mind: &mut Mind) {
    let scale = if car.is_shadow { mind.stretch } else { mind.twin.map_or(1.0, |twin| twin.stretch) };
    car.is_shadow = !car.is_shadow;
    let (own, other) = if car.is_shadow { (1.0 / scale, 1.0) } else { (1.0, 1.0 / scale) };
    mind.stretch = own;
    if let Some(Twin { stretch, .. }) = &mut mind.twin {
        *stretch = other;
    }
}
