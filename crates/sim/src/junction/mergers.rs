//! Those who come from elsewhere into a lane before a driver: it does not see them on its way yet, and will stand behind them.

use laneweave_network::ZoneKind;

use super::heed::leader_into;
use super::passages::{Hold, Passage};
use super::survey::{ROUNDING, Survey};
use crate::scene::{Scene, Spot};

/// Whether all who go before the vehicle at `spot` into a merge, of its passage or of what it has surveyed, have passages that
/// lead them as far as it would go: else it would stand within the zones behind one who waits.
pub(crate) fn are_led_on(scene: &Scene, spot: Spot, survey: &Survey) -> bool {
    let motion = scene.motion(spot);
    let clear = survey.extent - f64::from(motion.length);
    let is_merge =
        |hold: &&Hold| matches!(scene.network.junctions.zones[hold.zone.at()].kind, ZoneKind::Merging(_));
    let is_led_on = |to_merge: f64, hold: &Hold, other: &Passage| {
        let ahead = leader_into(to_merge, hold, other);
        ahead.is_none_or(|it| it.gap + other.left().max(0.0) >= clear - ROUNDING)
    };
    let mut asked = survey.holds.iter().filter(is_merge);
    let own = scene.passage(spot);
    let mut given =
        own.into_iter().flat_map(|own| own.holds.iter().filter(is_merge).map(move |it| (own, it)));
    asked.all(|hold| {
        let mut others = scene.passages.order(hold.zone).filter(|(it, _)| it.side != hold.side);
        others.all(|(_, other)| is_led_on(hold.leave, hold, other))
    }) && given.all(|(own, hold)| {
        let before = scene.passages.order(hold.zone).take_while(|(_, it)| it.vehicle != motion.id);
        let mut others = before.filter(|(it, _)| it.side != hold.side);
        others.all(|(_, other)| is_led_on(hold.leave - own.travelled, hold, other))
    })
}
