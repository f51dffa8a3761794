//! Drivers accelerate: behind their leaders, towards the ends of lanes, into and out of lanes, and above all that
//! emergency braking.

use laneweave_models::braking::{HARDEST_BRAKING, secure_speed, stays_secure};
use laneweave_models::follow::{Ahead, CarFollowing, Pace};
use laneweave_network::ChainIndex;

use crate::clock::Clock;
use crate::plan::Plan;
use crate::scene::{Scene, Spot};
use crate::traffic::{Car, Lane, Phase};

/// Drivers brake for the end of a lane, or the last place for a change, when this is needed to stop there [m/s²].
const COMFORTABLE_BRAKING: f64 = 2.0;
/// Road kept before the end of a lane, and before the last place for a change, to steer on [m]: what a truck needs to
/// get past another vehicle and into the lane.
const ROOM_AT_THE_END: f64 = 16.0;
/// What is left of it when it is used [m].
const LEAST_ROOM: f64 = 1.0;
/// Who has waited this long [s] for a gap, and hardly moves [m/s], uses that room.
const WAITS: f64 = 8.0;
const HARDLY_MOVES: f64 = 3.0;
/// Drivers who desire no more than this stop at the last place for a change [m/s]; the faster slow down to half of
/// what they desire beyond it (ours: in a town one waits for a gap, on a motorway one does not stop).
const WAITS_BELOW: f64 = 17.0;

/// All drivers of a lane choose their accelerations.
pub(crate) fn accelerate(scene: &Scene, clock: Clock, chain: ChainIndex, plan: &mut Plan) {
    let cars = scene.cars(chain);
    let lane_end = lane_end(scene, chain);
    plan.accelerations.clear();
    plan.accelerations.reserve_exact(cars.len());
    for (index, car) in cars.iter().enumerate() {
        let follows_only = car.phase == Phase::Cruises && !car.heeds_more && lane_end.is_none();
        let usual =
            cars.get(index + 1).filter(|_| follows_only).and_then(|it| behind(scene, car, it, clock.dt));
        let acceleration = match usual {
            Some(acceleration) => acceleration,
            None => with_care(scene, clock, Spot { chain, index }, lane_end, plan),
        };
        plan.accelerations.push(acceleration);
    }
}

fn pace(car: &Car) -> Pace {
    Pace { speed: car.speed, desired: f64::from(car.desired), tightness: f64::from(car.tightness) }
}

/// The usual case: a driver who heeds only its leader on the same chain, and is secure behind it.
#[inline]
fn behind(scene: &Scene, car: &Car, leader: &Car, dt: f64) -> Option<f64> {
    let ahead = Ahead { gap: leader.rear() - car.x, speed: leader.speed };
    let follow = &scene.characters[car.character as usize].follow;
    let wish = follow.acceleration(pace(car), Some(ahead));
    let acceleration = within(wish, -HARDEST_BRAKING, car.class.strength());
    let next = car.speed + acceleration * dt;
    let next = if next > 0.0 { next } else { 0.0 };
    (ahead.gap >= 0.0 && stays_secure(car.speed, next, ahead, dt)).then_some(acceleration)
}

/// Every case: the leader may be beyond the end of the chain, the driver may heed more than it, and kinematics may have
/// to decide.
#[inline(never)]
fn with_care(scene: &Scene, clock: Clock, spot: Spot, lane_end: Option<f64>, plan: &mut Plan) -> f64 {
    let car = scene.car(spot);
    let leader = scene.ahead(scene.viewpoint(spot));
    let follow = &scene.characters[car.character as usize].follow;
    let wish = follow.acceleration(pace(car), leader);
    let (wish, lane_end) = heed(scene, clock, spot, wish, lane_end);
    let acceleration = within(wish, -HARDEST_BRAKING, car.class.strength());
    let behind_leader = bound(car.speed, acceleration, leader, clock.dt);
    let bounded = bound(car.speed, behind_leader, lane_end, clock.dt);
    if let Some(twin) = scene.mind(spot).twin.filter(|_| !car.is_shadow) {
        plan.couples.push((spot.index as u32, twin));
    }
    // To accelerate less is no braking. A shadow counts as well: kinematics in either lane is kinematics.
    if bounded < acceleration && bounded < 0.0 {
        plan.emergencies.push(spot.index as u32);
        plan.tally.emergency_brakings += u64::from(!car.in_emergency);
    }
    if leader.is_some_and(|it| it.gap < 0.0) {
        plan.collisions.push(spot.index as u32);
        plan.tally.collisions += u64::from(!car.in_collision);
    }
    bounded
}

/// `clamp` for bounds in order.
#[inline]
fn within(value: f64, low: f64, high: f64) -> f64 {
    let value = if value < high { value } else { high };
    if value > low { value } else { low }
}

/// What a driver accelerates who heeds more than its leader, and the end of its lane.
fn heed(
    scene: &Scene,
    clock: Clock,
    spot: Spot,
    behind_leader: f64,
    lane_end: Option<f64>,
) -> (f64, Option<Ahead>) {
    let car = scene.car(spot);
    let (mut wish, mut obstacle) = (behind_leader, None);
    if car.phase == Phase::Wants || car.heeds_more {
        wish = wish.min(beyond_the_leader(scene, clock, spot));
    }
    if let Some(end) = lane_end.filter(|_| !is_leaving(scene, spot)) {
        let kept = kept_room(scene, clock, spot);
        wish = wish.min(approach(car.speed, end - kept - car.x, 0.0));
        obstacle = Some(Ahead::standing(end - car.x));
    }
    (wish, obstacle)
}

/// Where the lane ends for all that are on it, along the chain [m].
fn lane_end(scene: &Scene, chain: ChainIndex) -> Option<f64> {
    let here = scene.network.chain(chain);
    match here.following[..] {
        [] => here.is_lane_drop.then_some(here.length),
        [only] => {
            let next = scene.network.chain(only);
            next.is_lane_drop.then_some(here.length + next.length)
        }
        _ => None,
    }
}

/// A vehicle whose centre has left the lane need not mind its end.
fn is_leaving(scene: &Scene, spot: Spot) -> bool {
    let car = scene.car(spot);
    car.is_shadow && car.phase == Phase::Changes && scene.mind(spot).progress >= 0.5
}

/// Road that a driver keeps before the place where it has to have left its lane [m]. Who changes already uses it; so
/// does who has waited there in vain, if only the vehicle behind is in the way: of two drivers side by side who want
/// each other's lane the one ahead moves on, and both can go.
fn kept_room(scene: &Scene, clock: Clock, spot: Spot) -> f64 {
    let (car, mind) = (scene.car(spot), scene.mind(spot));
    let moves_up = match car.phase {
        Phase::Changes => true,
        Phase::Wants => {
            let waited = f64::from(clock.step - mind.since) * clock.dt;
            let least = scene.characters[car.character as usize].safety.min_gap;
            waited > WAITS
                && car.speed < HARDLY_MOVES
                && leader_beside(scene, spot).is_none_or(|it| it.gap >= least)
        }
        Phase::Cruises | Phase::Aborts => false,
    };
    if moves_up { LEAST_ROOM } else { ROOM_AT_THE_END }
}

/// What a driver heeds beside its leader.
fn beyond_the_leader(scene: &Scene, clock: Clock, spot: Spot) -> f64 {
    let (car, mind) = (scene.car(spot), scene.mind(spot));
    let pace = pace(car);
    let style = &scene.characters[car.character as usize];
    let mut acceleration = f64::INFINITY;
    if car.phase == Phase::Wants {
        let falling_in = style.follow.acceleration(pace, leader_beside(scene, spot));
        acceleration = falling_in.max(-style.manner.adjust_deceleration);
    }
    if let Some((gap, speed)) = mind.lets_in {
        let ahead = Ahead { gap: f64::from(gap).max(0.1), speed: f64::from(speed) };
        let giving_way = style.follow.acceleration(pace, Some(ahead));
        acceleration = acceleration.min(giving_way.max(-style.manner.yield_deceleration));
    }
    if mind.last_place.is_finite() && matches!(car.phase, Phase::Cruises | Phase::Wants) {
        let room = mind.last_place - kept_room(scene, clock, spot) - car.x;
        let passing = 0.5 * (pace.desired - WAITS_BELOW).max(0.0);
        acceleration = acceleration.min(approach(car.speed, room, passing).max(-2.0 * COMFORTABLE_BRAKING));
    }
    acceleration
}

/// The leader on the lane that a driver waits to change to.
fn leader_beside(scene: &Scene, spot: Spot) -> Option<Ahead> {
    let car = scene.car(spot);
    let beside = scene.network.chain(spot.chain).beside(scene.mind(spot).side, car.x)?;
    let x = beside.across(car.x);
    scene.ahead(scene.viewpoint_at(beside.chain, x, car.id, car.goal.destination()))
}

/// Braking that passes a place `room` metres ahead at `passing` [m/s], as soon as it is no longer gentle.
fn approach(speed: f64, room: f64, passing: f64) -> f64 {
    if speed <= passing {
        return if room <= 0.0 && passing == 0.0 { 0.0 } else { f64::INFINITY };
    }
    let needed = (speed * speed - passing * passing) / (2.0 * room.max(0.1));
    if needed > COMFORTABLE_BRAKING { -needed } else { f64::INFINITY }
}

/// The acceleration, or what kinematics leaves of it behind `obstacle`.
#[inline]
fn bound(speed: f64, acceleration: f64, obstacle: Option<Ahead>, dt: f64) -> f64 {
    let next = speed + acceleration * dt;
    let next = if next > 0.0 { next } else { 0.0 };
    match obstacle {
        Some(obstacle) if !stays_secure(speed, next, obstacle, dt) => {
            let slowed = (secure_speed(speed, obstacle, dt) - speed) / dt;
            acceleration.min(slowed.max(-HARDEST_BRAKING))
        }
        _ => acceleration,
    }
}

/// A vehicle in a lane change follows both leaders: both its entries take the lower acceleration.
pub(crate) fn couple(lanes: &[Lane], plans: &mut [Plan]) {
    for here in 0..plans.len() {
        if plans[here].couples.is_empty() {
            continue;
        }
        let couples = std::mem::take(&mut plans[here].couples);
        for (index, twin) in &couples {
            let index = *index as usize;
            let id = lanes[here].cars()[index].id;
            let Some(shadow) = lanes[twin.chain.at()].find(id, twin.x) else { continue };
            let lower = plans[here].accelerations[index].min(plans[twin.chain.at()].accelerations[shadow]);
            plans[here].accelerations[index] = lower;
            plans[twin.chain.at()].accelerations[shadow] = lower;
        }
        plans[here].couples = couples;
    }
}
