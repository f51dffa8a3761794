//! Whether a driver may pass now.

use laneweave_models::braking::is_secure;
use laneweave_models::follow::Ahead;
use laneweave_models::yielding::MARGIN;
use laneweave_network::{Precedence, ZoneKind};

use crate::junction::need::Survey;
use crate::junction::reservations::Reservation;
use crate::junction::waiting::Turn;
use crate::junction::waiting::{WaitingPriority, ZoneReservation};
use crate::right_of_way::applicant::Applicant;
use crate::right_of_way::approach::{LONG, leader_into, lets_go};
use crate::right_of_way::oncoming::lag;
use crate::right_of_way::turns::{clears, is_out_before};
use crate::state::clock::Clock;
use crate::view::scene::Scene;

/// Why a driver may not pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Hindrance {
    /// A light is not green.
    Light,
    /// It has not stopped yet, as a sign asks.
    Sign,
    /// It could not leave the zones again.
    Space,
    /// It would fill a ring.
    Roundabout,
    /// Others go first: it claims its turn.
    Others,
}

/// Of the gap that one leaves in a queue, who is out of patience does without this much [m] (ours).
const CLOSES_UP: f64 = 0.5;
/// Standstill at a stop sign [m/s], and how near to the line [m].
const STOPPED: f64 = 0.3;
const AT_THE_LINE: f64 = 4.0;
/// Room that who gives way leaves for one who goes first [m] (ours); a ring has room for others anyway.
const ROOM_FOR_ANOTHER: f64 = 7.0;
/// Who comes from the side that does not go first has waited for this long before it takes its turn [s] (ours): so ends
/// a standoff in which everybody gives way to somebody.
const STANDOFF: f64 = 4.0;

/// Who asks.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Asking {
    pub(crate) priority: WaitingPriority,
    /// Time since it first asked [s].
    pub(crate) waited: f64,
    /// When it asks.
    pub(crate) clock: Clock,
}

impl Asking {
    /// Of who first asked in step `since`.
    pub(crate) fn of(applicant: &Applicant, since: u32, clock: Clock) -> Asking {
        let waited = clock.since(since);
        let is_patient = waited < applicant.style.yielding.patience;
        let priority =
            WaitingPriority { is_patient, since, id: applicant.from.id, is_long: applicant.length >= LONG };
        Asking { priority, waited, clock }
    }

    /// How much less room than usual it needs [m]: out of patience one closes up.
    pub(crate) fn squeezes_into(&self) -> f64 {
        if self.priority.is_patient { 0.0 } else { CLOSES_UP }
    }
}

/// Whether the applicant may pass what it has surveyed.
///
/// # Errors
/// What hinders it.
pub(crate) fn may_pass(
    scene: &Scene,
    applicant: &Applicant,
    survey: &Survey,
    asking: Asking,
) -> Result<(), Hindrance> {
    let speed = applicant.speed;
    if !survey.lights.iter().all(|(light, at)| lets_go(scene, *light, *at, speed)) {
        return Err(Hindrance::Light);
    }
    if survey.has_stop_sign && (speed > STOPPED || survey.stop > AT_THE_LINE) {
        return Err(Hindrance::Sign);
    }
    let (Scene { reservations, lanes, .. }, way) = (*scene, [applicant.from.chain, survey.section.chain]);
    if reservations.roundabouts.is_closed(reservations, lanes, way, asking.priority, survey.needed) {
        return Err(Hindrance::Roundabout);
    }
    // Not for ever: those who go first may all wait for who would take the room.
    let leaves_room = asking.priority.is_patient && !reservations.roundabouts.is_entered(way);
    let space = survey.space - reservations.requested_before(survey.section, asking.priority);
    let needed = survey.needed - asking.squeezes_into();
    let lacks = |spare: f64| space < (needed + spare).min(survey.most);
    let yields_room =
        || leaves_room && lacks(ROOM_FOR_ANOTHER) && survey.holds.iter().any(|it| gives_way(scene, it));
    if lacks(0.0) || yields_room() {
        return Err(Hindrance::Space);
    }
    if survey.holds.iter().all(|hold| may_hold(scene, applicant, hold, asking)) {
        Ok(())
    } else {
        Err(Hindrance::Others)
    }
}

/// Whether somebody comes on the other side of a zone who goes first.
fn gives_way(scene: &Scene, hold: &ZoneReservation) -> bool {
    let (zone, side) = (&scene.network.junctions.zones[hold.zone.at()], 1 - hold.side);
    let waits = || scene.reservations.priority(hold.zone, side).is_some();
    let passes = || scene.reservations.order(hold.zone).any(|(it, _)| it.side == side);
    let comes = || lag(scene, hold.zone, &zone.sides[usize::from(side)]) < f64::INFINITY;
    zone.precedence == Precedence::Side(side) && (waits() || passes() || comes())
}

fn may_hold(scene: &Scene, applicant: &Applicant, hold: &ZoneReservation, asking: Asking) -> bool {
    let zone = &scene.network.junctions.zones[hold.zone.at()];
    let other_side = 1 - hold.side;
    let matters = |is_long: bool| zone.touch.is_of([asking.priority.is_long, is_long]);
    let turn = scene.reservations.priority(hold.zone, other_side).filter(|it| matters(it.priority.is_long));
    let waits_for = |it: &Turn| {
        goes_first(zone.precedence, other_side, it.priority, asking)
            && !is_out_before(scene, applicant, hold, it)
    };
    if turn.is_some_and(|it| waits_for(&it)) {
        return false;
    }
    let others = scene.reservations.order(hold.zone).filter(|(it, _)| it.side != hold.side);
    let mut others = others.filter(|(_, other)| matters(other.length >= LONG));
    let fits = match zone.kind {
        ZoneKind::Merging(_) => {
            others.next_back().is_none_or(|(_, other)| follows(applicant, hold, other, asking.clock.dt))
        }
        ZoneKind::Crossing => others.all(|(_, other)| clears(scene, applicant, hold, other)),
    };
    fits && accepts_lag(scene, applicant, hold, asking)
}

/// Whether who claims a turn on the other side goes before who asks.
fn goes_first(precedence: Precedence, other_side: u8, priority: WaitingPriority, asking: Asking) -> bool {
    let came_first = priority < asking.priority;
    if !priority.is_patient || !asking.priority.is_patient {
        return came_first;
    }
    match precedence {
        Precedence::Arrival => came_first,
        Precedence::Side(side) => side == other_side,
        Precedence::FromTheRight(side) if asking.waited < STANDOFF => side == other_side,
        Precedence::FromTheRight(side) => side == other_side && came_first,
    }
}

/// Whether there is room enough behind `other`, who goes first into the merge.
fn follows(applicant: &Applicant, hold: &ZoneReservation, other: &Reservation, dt: f64) -> bool {
    let Some(ahead) = leader_into(hold.leave, hold, other) else { return true };
    ahead.gap >= applicant.style.safety.min_gap && is_secure(applicant.speed, ahead, dt)
}

/// The nearest of those who go first into the merges of what was surveyed, as the applicant would follow it.
pub(crate) fn leader_of(scene: &Scene, survey: &Survey) -> Option<Ahead> {
    let zone = |hold: &ZoneReservation| &scene.network.junctions.zones[hold.zone.at()];
    let merges = survey.holds.iter().filter(|it| matches!(zone(it).kind, ZoneKind::Merging(_)));
    let last = |hold: &ZoneReservation| {
        let others = scene.reservations.order(hold.zone).filter(|(it, _)| it.side != hold.side);
        others.map(|it| it.1).next_back().and_then(|other| leader_into(hold.leave, hold, other))
    };
    merges.filter_map(last).reduce(|a, b| if b.gap < a.gap { b } else { a })
}

/// Whether those who go first on the other side are far enough.
fn accepts_lag(scene: &Scene, applicant: &Applicant, hold: &ZoneReservation, asking: Asking) -> bool {
    let zone = &scene.network.junctions.zones[hold.zone.at()];
    let other_side = 1 - hold.side;
    let needed = || applicant.time_to(hold.leave);
    let lag = || lag(scene, hold.zone, &zone.sides[usize::from(other_side)]);
    match zone.precedence {
        Precedence::Side(side) if side == other_side && asking.priority.is_patient => {
            applicant.style.yielding.accepts(lag(), needed(), asking.waited)
        }
        Precedence::FromTheRight(side) if side == other_side && asking.waited < STANDOFF => {
            lag() >= needed() + MARGIN
        }
        _ => true,
    }
}
