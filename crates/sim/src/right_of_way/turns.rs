//! The turns of waiting drivers. A vehicle that leaves a zone before another one with an earlier turn can enter it
//! does not delay that one, and need not wait. So vehicles from opposite sides pass together, and the junction is
//! used while the longest-waiting driver is delayed in another zone. Estimates have errors, and many small delays add
//! up. Therefore no vehicle goes before a driver who is out of patience.

use laneweave_models::yielding::time_to_cover;
use laneweave_network::{ZoneIndex, ZoneKind};

use crate::junction::need::{SPARE_SPACE, Survey};
use crate::junction::reservations::Reservation;
use crate::junction::waiting_priority::WaitingTurn;
use crate::junction::waiting_priority::{WaitingPriority, ZoneReservation};
use crate::right_of_way::applicant::Applicant;
use crate::right_of_way::approach::opposite;
use crate::right_of_way::survey::ROUNDING;
use crate::view::scene::Scene;

/// An earlier vehicle on the other side may occupy a crossing until this long after the applicant could reach it [s]
/// (ours): the applicant approaches while the crossing clears.
const APPROACHES: f64 = 1.5;
/// A driver with an earlier turn lets another go that leaves the zone at most this long after the driver could enter
/// it [s] (ours). None on the way into a roundabout.
const COURTESY: f64 = 1.0;

/// The turns that the applicant requests in all zones that it has surveyed.
pub(crate) fn turns(
    scene: &Scene,
    applicant: &Applicant,
    survey: &Survey,
    priority: WaitingPriority,
) -> impl Iterator<Item = (ZoneIndex, u8, WaitingTurn)> {
    let enters = scene.reservations.roundabouts.is_entry(applicant.from.chain);
    let is_within = applicant.waits_within_a_zone(scene, survey.stop);
    let held_up = survey.holds.iter().map(|it| held_up(scene, applicant, it, priority)).fold(0.0, f64::max);
    survey.holds.iter().map(move |it| {
        let begins = held_up + arrival(scene, applicant, it);
        (it.zone, it.side, WaitingTurn { priority, begins, enters, is_within })
    })
}

/// Whether the applicant, if it goes now, leaves a zone before it delays the driver whose `turn` it is. False if that
/// driver is out of patience.
pub(crate) fn is_out_before(
    scene: &Scene,
    applicant: &Applicant,
    hold: &ZoneReservation,
    turn: &WaitingTurn,
) -> bool {
    let out = applicant.time_to(departure(scene, hold, applicant.length));
    let courtesy = if scene.reservations.roundabouts.is_entry(applicant.from.chain) { 0.0 } else { COURTESY };
    turn.priority.is_patient && out <= turn.begins + courtesy
}

/// Whether `other` will have left the crossing when the applicant arrives.
pub(crate) fn clears(
    scene: &Scene,
    applicant: &Applicant,
    hold: &ZoneReservation,
    other: &Reservation,
) -> bool {
    clearance(scene, applicant, hold, other) <= arrival(scene, applicant, hold)
}

/// Delay of the applicant's arrival at a zone by vehicles with reservations [s].
fn held_up(scene: &Scene, applicant: &Applicant, hold: &ZoneReservation, priority: WaitingPriority) -> f64 {
    let clearances = opposite(scene, hold, priority.is_long).map(|it| clearance(scene, applicant, hold, it));
    clearances.fold(0.0, f64::max) - arrival(scene, applicant, hold)
}

/// Time until the applicant can be in a zone and others must have left it [s].
fn arrival(scene: &Scene, applicant: &Applicant, hold: &ZoneReservation) -> f64 {
    if is_merge(scene, hold) {
        applicant.time_to(hold.leave)
    } else {
        applicant.time_to(hold.enter) + APPROACHES
    }
}

/// Time until `other` no longer blocks the applicant on the other side of a zone [s]. At a roundabout, where
/// reservations are returned in part, it is infinite if its reservation does not lead it out of the zone.
fn clearance(scene: &Scene, applicant: &Applicant, hold: &ZoneReservation, other: &Reservation) -> f64 {
    let is_round = scene.reservations.roundabouts.touches(applicant.from.chain);
    other.across(hold).map_or(0.0, |it| {
        if is_round && other.extent < it.leave - ROUNDING {
            return f64::INFINITY;
        }
        let distance = departure(scene, it, other.length) - other.travelled;
        time_to_cover(distance, other.speed, other.desired)
    })
}

/// Position of a vehicle's front when others can pass the zone, or follow it into the merge [m].
fn departure(scene: &Scene, hold: &ZoneReservation, length: f64) -> f64 {
    if is_merge(scene, hold) { hold.leave + length + SPARE_SPACE } else { hold.leave }
}

fn is_merge(scene: &Scene, hold: &ZoneReservation) -> bool {
    matches!(scene.network.junctions.zones[hold.zone.at()].kind, ZoneKind::Merging(_))
}
