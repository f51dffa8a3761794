//! Vehicles that merge into a lane in front of a driver. They are not yet ahead on its lane, but it will stand behind
//! them.

use laneweave_network::ZoneKind;

use crate::junction::need::Survey;
use crate::junction::reservations::Reservation;
use crate::junction::waiting_priority::ZoneReservation;
use crate::right_of_way::applicant::Applicant;
use crate::right_of_way::approach::leader_into;
use crate::right_of_way::survey::ROUNDING;
use crate::view::scene::Scene;

/// Whether all vehicles that go before the applicant into a merge have reservations that reach as far as the
/// applicant would go. If not, the applicant would stand within the zones behind a waiting vehicle. The merges are
/// those of its reservation and those that it has surveyed.
pub(crate) fn are_led_on(scene: &Scene, applicant: &Applicant, survey: &Survey) -> bool {
    let clear = survey.extent - applicant.length;
    let is_merge = |hold: &&ZoneReservation| {
        matches!(scene.network.junctions.zones[hold.zone.at()].kind, ZoneKind::Merging(_))
    };
    let is_led_on = |to_merge: f64, hold: &ZoneReservation, other: &Reservation| {
        let ahead = leader_into(to_merge, hold, other);
        ahead.is_none_or(|it| it.gap + other.left().max(0.0) >= clear - ROUNDING)
    };
    let mut asked = survey.holds.iter().filter(is_merge);
    let mut given = applicant
        .reservation
        .into_iter()
        .flat_map(|own| own.holds.iter().filter(is_merge).map(move |it| (own, it)));
    asked.all(|hold| {
        let mut others = scene.reservations.order(hold.zone).filter(|(it, _)| it.side != hold.side);
        others.all(|(_, other)| is_led_on(hold.leave, hold, other))
    }) && given.all(|(own, hold)| {
        let before =
            scene.reservations.order(hold.zone).take_while(|(_, it)| it.vehicle != applicant.from.id);
        let mut others = before.filter(|(it, _)| it.side != hold.side);
        others.all(|(_, other)| is_led_on(hold.leave - own.travelled, hold, other))
    })
}
