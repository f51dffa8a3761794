//! External vehicles do what their users say, in place of what their drivers decided. The drivers decide all the same:
//! what they note, and what they request at junctions, stays.

use laneweave_models::braking::HARDEST_BRAKING;
use laneweave_network::{ChainIndex, Side};

use crate::driver::choice::Choice;
use crate::driver::consider::{look, waypoint};
use crate::driver::drive::{begins_to_brake_hard, moved, stretch};
use crate::driver::me::{Attending, Me};
use crate::driver::plan::{Ask, Concern, Controlled, Outbox, Plan, Request, Told};
use crate::driver::wish::{asks, wish};
use crate::record::events::{BrakingCause, DrivingEventKind};
use crate::state::clock::Clock;
use crate::state::control::{Control, Lateral, Longitudinal};
use crate::state::lane::{Kinematics, Phase};
use crate::state::moment::Moment;
use crate::view::scene::{Scene, Spot};

/// The lengths of an outbox before the drivers of a lane decided.
#[derive(Clone, Copy)]
pub(crate) struct Before {
    requests: usize,
    driving: usize,
}

impl Before {
    /// The present lengths of `outbox`.
    #[inline]
    pub(crate) fn of(outbox: &Outbox) -> Before {
        Before { requests: outbox.requests.len(), driving: outbox.driving.len() }
    }
}

/// Makes the external vehicles of a lane obey. Its drivers have decided and driven since `before`.
#[inline(never)]
pub(crate) fn obey(
    scene: &Scene,
    moment: Moment,
    chain: ChainIndex,
    before: Before,
    plan: &mut Plan,
    outbox: &mut Outbox,
) {
    let controls = std::mem::take(&mut plan.controls);
    for Controlled { index, told, gives_way } in &controls {
        let me = Me::at(scene, Spot { chain, index: *index as usize });
        let would_go = plan.next[me.spot.index].speed > 0.0;
        let (longitudinal, lateral) = match told {
            Told::Drive(longitudinal, lateral) => (*longitudinal, *lateral),
            Told::Stay => {
                change(scene, moment, &me, None, before, plan, outbox);
                drive(scene, &me, (*me.motion, 0.0), (moment.clock, before), plan, outbox);
                let_others_go(scene, &me, would_go, *gives_way, plan, outbox);
                continue;
            }
        };
        match lateral {
            Lateral::Driver => {}
            Lateral::Keep => change(scene, moment, &me, None, before, plan, outbox),
            Lateral::Change(side) => change(scene, moment, &me, Some(side), before, plan, outbox),
        }
        let own = f64::from(plan.next[me.spot.index].acceleration);
        if let Some(acceleration) = acceleration(longitudinal, &me, own, moment.clock.dt) {
            let stretch = stretch(scene, me.spot);
            let next = moved(me.motion, acceleration, stretch, moment.clock.dt);
            drive(scene, &me, next, (moment.clock, before), plan, outbox);
            let_others_go(scene, &me, would_go, *gives_way, plan, outbox);
        }
    }
    plan.controls = controls;
}

/// A vehicle that stands although its driver `would_go` is idle. One that `gives_way` asks for no right of way, and
/// revokes what it does not use.
fn let_others_go(
    scene: &Scene,
    me: &Me,
    would_go: bool,
    gives_way: bool,
    plan: &mut Plan,
    outbox: &mut Outbox,
) {
    let stands = me.motion.speed == 0.0 && plan.next[me.spot.index].speed == 0.0;
    if would_go && stands && !me.driver.is_shadow {
        outbox.idle.push(me.motion.id);
    }
    if gives_way && stands {
        let index = me.spot.index as u32;
        plan.waiting.retain(|it| it.index != index);
        outbox.returns.extend(scene.reservation(me.spot).map(|it| (index, it.travelled)));
    }
}

/// The acceleration that the user wants of a driver who would choose its `own` [m/s²]; `None` if the driver's counts.
fn acceleration(longitudinal: Longitudinal, me: &Me, own: f64, dt: f64) -> Option<f64> {
    let wanted = match longitudinal {
        Longitudinal::Driver => return None,
        Longitudinal::Acceleration(acceleration) => acceleration,
        Longitudinal::Speed(speed) => {
            ((speed - me.motion.speed) / dt).clamp(-HARDEST_BRAKING, me.driver.class.strength())
        }
        Longitudinal::AtMost(speed) => {
            let slower = ((speed - me.motion.speed) / dt).max(-Control::GENTLE);
            if own <= slower {
                return None;
            }
            slower
        }
    };
    let to_the_fastest = (Control::FASTEST - me.motion.speed) / dt;
    Some(wanted.min(to_the_fastest.max(0.0)))
}

/// Makes a vehicle change to the side that it is `told`, or keep its lane.
fn change(
    scene: &Scene,
    moment: Moment,
    me: &Me,
    told: Option<Side>,
    before: Before,
    plan: &mut Plan,
    outbox: &mut Outbox,
) {
    if wish(me, &outbox.requests[before.requests..], &plan.concerns) == told {
        return;
    }
    match me.driver.phase {
        Phase::Cruises => {
            withdraw(me, before, outbox);
            let begun = told.and_then(|side| begin(scene, moment, me, side));
            outbox.requests.extend(begun);
        }
        Phase::Wants if told == Some(me.lane_change.side) => {
            let own = plan.concerns.iter_mut().filter(|it| it.index as usize == me.spot.index);
            own.for_each(|it| it.gives_up = false);
        }
        Phase::Wants => {
            withdraw(me, before, outbox);
            give_up(me, plan);
        }
        Phase::Changes if told == Some(me.lane_change.side) => withdraw(me, before, outbox),
        Phase::Changes => {
            if !asks(&outbox.requests[before.requests..], me.motion.id, |it| matches!(it, Ask::Abort)) {
                outbox.requests.push(request(me, me.lane_change.urgency, Ask::Abort));
            }
        }
        // It is on its way back.
        Phase::Aborts => {}
    }
}

/// Withdraws what the driver has requested since `before`.
fn withdraw(me: &Me, before: Before, outbox: &mut Outbox) {
    let mut at = before.requests;
    while let Some(request) = outbox.requests.get(at) {
        if request.id == me.motion.id {
            outbox.requests.swap_remove(at);
        } else {
            at += 1;
        }
    }
}

/// The request to want a change to `side`, whatever speaks against it. `None` where a change to that side is not
/// allowed.
fn begin(scene: &Scene, moment: Moment, me: &Me, side: Side) -> Option<Request> {
    let attending = Attending::of(me, moment);
    let waypoint = waypoint(scene, me);
    let perception = look(scene, moment, me, &attending, &waypoint, &mut [0; 2]);
    let choice = Choice::whatever(&perception, &attending.model(me.style), side)?;
    let want = choice.want(perception.here().anticipated_speed);
    Some(request(me, choice.pressure as f32, Ask::Want(want)))
}

fn request(me: &Me, urgency: f32, ask: Ask) -> Request {
    Request { urgency, id: me.motion.id, chain: me.spot.chain, x: me.motion.x, ask }
}

/// Makes the driver give up the desired change.
fn give_up(me: &Me, plan: &mut Plan) {
    let index = me.spot.index as u32;
    if let Some(own) = plan.concerns.iter_mut().find(|it| it.index == index) {
        own.gives_up = true;
        return;
    }
    plan.concerns.push(Concern {
        index,
        last_place: me.lane_change.last_place,
        urgency: me.lane_change.urgency,
        gives_up: true,
        minds_offside: me.lane_change.minds_offside,
        rerouted: None,
    });
}

/// Gives a vehicle the kinematics `next`, after a way of `distance` [m], in place of those that its driver chose.
fn drive(
    scene: &Scene,
    me: &Me,
    (next, distance): (Kinematics, f64),
    (clock, before): (Clock, Before),
    plan: &mut Plan,
    outbox: &mut Outbox,
) {
    let Me { spot, motion, driver, .. } = *me;
    let own = plan.next[spot.index];
    let next = Kinematics { headway_relaxation: own.headway_relaxation, ..next };
    if next == own {
        return;
    }
    plan.next[spot.index] = next;
    if !driver.is_shadow {
        plan.distance += (next.x - own.x) / stretch(scene, spot);
    }
    // Neither kinematics nor the driver's model decided.
    if let Some(upkeep) = plan.upkeep.iter_mut().find(|it| it.index as usize == spot.index) {
        (upkeep.distance, upkeep.in_emergency) = (distance, false);
    }
    let mut at = before.driving;
    while let Some(event) = outbox.driving.get(at) {
        let counter = match event.kind {
            DrivingEventKind::EmergencyBraking => &mut outbox.counters.emergency_brakings,
            DrivingEventKind::HardBraking(_) => &mut outbox.counters.hard_brakings,
            _ => {
                at += 1;
                continue;
            }
        };
        if event.vehicle == motion.id {
            outbox.driving.swap_remove(at);
            *counter -= 1;
        } else {
            at += 1;
        }
    }
    if !driver.is_shadow && begins_to_brake_hard(motion, f64::from(next.acceleration), clock.dt) {
        outbox.note(scene, clock, spot, DrivingEventKind::HardBraking(BrakingCause::User));
    }
}
