//! Vehicles that merge into a lane in front of a driver. They are not yet ahead on its lane, but it will stand behind
//! them.

use laneweave_network::ZoneKind;

use crate::junction::need::Survey;
use crate::junction::reservations::Reservation;
use crate::junction::waiting_priority::ZoneReservation;
use crate::right_of_way::applicant::Applicant;
use crate::right_of_way::approach::{LONG, earlier, leader_into, opposite};
use crate::right_of_way::survey::ROUNDING;
use crate::view::scene::Scene;

/// Whether all vehicles that go before the applicant into a merge have reservations that reach as far as the
/// applicant would go. If not, the applicant would stand within the zones behind a waiting vehicle. The merges are
/// those of its reservation and those that it has surveyed.
pub(crate) fn are_led_on(scene: &Scene, applicant: &Applicant, survey: &Survey) -> bool {
    not_led_on(scene, applicant, survey).next().is_none()
}

/// The vehicles that go before the applicant into a merge, and have no reservation that reaches as far as the applicant
/// would go.
pub(crate) fn not_led_on<'a>(
    scene: &'a Scene,
    applicant: &'a Applicant,
    survey: &'a Survey,
) -> impl Iterator<Item = &'a Reservation> {
    let clear = survey.extent - applicant.length;
    let is_merge = |hold: &&ZoneReservation| {
        matches!(scene.network.junctions.zones[hold.zone.at()].kind, ZoneKind::Merging(_))
    };
    let is_long = applicant.length >= LONG;
    let stays = move |to_merge: f64, hold: &ZoneReservation, other: &Reservation| {
        let ahead = leader_into(scene, to_merge, hold, other);
        ahead.is_some_and(|it| it.gap + other.left().max(0.0) < clear - ROUNDING)
    };
    let asked = survey.holds.iter().filter(is_merge).flat_map(move |hold| {
        opposite(scene, hold, is_long).filter(move |other| stays(hold.leave, hold, other))
    });
    let own = applicant.reservation.into_iter();
    let given =
        own.flat_map(|own| own.holds.iter().map(move |it| (own, it))).filter(move |it| is_merge(&it.1));
    asked.chain(given.flat_map(move |(own, hold)| {
        let others = earlier(scene, own, hold);
        others.filter(move |other| stays(hold.leave - own.travelled, hold, other))
    }))
}
