//! When those who wait can have their turn. Who is out of a zone before another who claims it could be there takes
//! nothing from it, and need not wait for it: so those who come from opposite sides go together, and a junction is used
//! while who has waited longest is held up elsewhere in it. Estimates err, and many small delays add up; so nobody goes
//! before who is out of patience.

use laneweave_models::yielding::time_to_cover;
use laneweave_network::{ZoneIndex, ZoneKind};

use crate::junction::need::SPARE_SPACE;
use crate::junction::reservations::Reservation;
use crate::junction::waiting::Turn;
use crate::junction::waiting::{WaitingPriority, ZoneReservation};
use crate::right_of_way::applicant::Applicant;
use crate::right_of_way::approach::LONG;
use crate::view::scene::Scene;

/// An earlier one on the other side may be in a crossing this long after one could enter it [s] (ours): one approaches
/// while it clears.
const APPROACHES: f64 = 1.5;
/// Who has its turn lets another go who is out of its way so soon after it could be there itself [s] (ours).
const COURTESY: f64 = 1.0;

/// The turns that the applicant claims on all zones that it `holds` with its reservation.
pub(crate) fn turns(
    scene: &Scene,
    applicant: &Applicant,
    holds: &[ZoneReservation],
    priority: WaitingPriority,
) -> impl Iterator<Item = (ZoneIndex, u8, Turn)> {
    let held_up = holds.iter().map(|it| held_up(scene, applicant, it, priority)).fold(0.0, f64::max);
    holds.iter().map(move |it| {
        let begins = held_up + arrival(scene, applicant, it);
        (it.zone, it.side, Turn { priority, begins })
    })
}

/// Whether the applicant, if it goes now, is out of a zone before it would be in the way of who has its `turn` there,
/// and is patient.
pub(crate) fn is_out_before(
    scene: &Scene,
    applicant: &Applicant,
    hold: &ZoneReservation,
    turn: &Turn,
) -> bool {
    let out = applicant.time_to(departure(scene, hold, applicant.length));
    turn.priority.is_patient && out <= turn.begins + COURTESY
}

/// Whether `other` will be out of the crossing by the time that the applicant gets there.
pub(crate) fn clears(
    scene: &Scene,
    applicant: &Applicant,
    hold: &ZoneReservation,
    other: &Reservation,
) -> bool {
    clearance(scene, hold, other) <= arrival(scene, applicant, hold)
}

/// How much later than now those who have reservations let the applicant begin its way to a zone [s].
fn held_up(scene: &Scene, applicant: &Applicant, hold: &ZoneReservation, priority: WaitingPriority) -> f64 {
    let touch = scene.network.junctions.zones[hold.zone.at()].touch;
    let others = scene.reservations.order(hold.zone).filter(|(it, _)| it.side != hold.side);
    let matters = |other: &Reservation| touch.is_of([priority.is_long, other.length >= LONG]);
    let clearances = others.filter(|(_, it)| matters(it)).map(|(_, it)| clearance(scene, hold, it));
    clearances.fold(0.0, f64::max) - arrival(scene, applicant, hold)
}

/// Time until the applicant can be in a zone, and others have to be out of it [s].
fn arrival(scene: &Scene, applicant: &Applicant, hold: &ZoneReservation) -> f64 {
    if is_merge(scene, hold) {
        applicant.time_to(hold.leave)
    } else {
        applicant.time_to(hold.enter) + APPROACHES
    }
}

/// Time until `other` is out of the way of who would hold the other side of a zone [s].
fn clearance(scene: &Scene, hold: &ZoneReservation, other: &Reservation) -> f64 {
    other.across(hold).map_or(0.0, |it| {
        let distance = departure(scene, it, other.length) - other.travelled;
        time_to_cover(distance, other.speed, other.desired)
    })
}

/// Where the front of a vehicle is when others can go through the zone, or follow it into the merge [m].
fn departure(scene: &Scene, hold: &ZoneReservation, length: f64) -> f64 {
    if is_merge(scene, hold) { hold.leave + length + SPARE_SPACE } else { hold.leave }
}

fn is_merge(scene: &Scene, hold: &ZoneReservation) -> bool {
    matches!(scene.network.junctions.zones[hold.zone.at()].kind, ZoneKind::Merging(_))
}
