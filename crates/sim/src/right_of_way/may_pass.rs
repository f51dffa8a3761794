//! The conditions under which a driver may pass a junction now.

use laneweave_models::braking::is_secure;
use laneweave_models::follow::Ahead;
use laneweave_models::yielding::MARGIN;
use laneweave_network::{ChainIndex, Precedence, Reach, Zone, ZoneKind};

use crate::junction::need::Survey;
use crate::junction::reservations::Reservation;
use crate::junction::waiting_priority::WaitingTurn;
use crate::junction::waiting_priority::{WaitingPriority, ZoneReservation};
use crate::right_of_way::applicant::Applicant;
use crate::right_of_way::approach::{LONG, leader_into, lets_go, opposite};
use crate::right_of_way::oncoming::lag;
use crate::right_of_way::turns::{clears, is_out_before};
use crate::state::clock::Clock;
use crate::view::scene::Scene;

/// Why a driver may not pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PassHindrance {
    /// A light is not green.
    Light,
    /// It has not stopped yet at a stop sign.
    Sign,
    /// There is no storage space beyond the zones.
    Space,
    /// It would fill a roundabout.
    Roundabout,
    /// A vehicle that lacks storage space may have to stand within its zones, or one stands within those of a
    /// roundabout. Nobody knows for how long, so it has no turn there.
    Blocked,
    /// Others go first; it waits for its turn.
    Others,
}

/// A driver who is out of patience leaves this much less of the usual gap in a queue [m] (ours).
const CLOSES_UP: f64 = 0.5;
/// Speed below which a vehicle has stopped at a stop sign [m/s], and its largest distance to the line [m].
const STOPPED: f64 = 0.3;
const AT_THE_LINE: f64 = 4.0;
/// Storage space that a yielding driver leaves for a vehicle with priority [m] (ours). It leaves none where it enters
/// a roundabout, which keeps space for others anyway.
const ROOM_FOR_ANOTHER: f64 = 7.0;
/// A driver who has to yield to the right goes by waiting time after it has waited this long [s] (ours). This ends a
/// deadlock in which every driver yields to another.
const STANDOFF: f64 = 4.0;

/// Drivers with priority let others merge that are in their way for at most this long [s] (ours).
const LET_IN: f64 = 1.5;

/// The waiting priority and the waiting time of a driver who asks to pass.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Asking {
    pub(crate) priority: WaitingPriority,
    /// Time since its first request [s].
    pub(crate) waited: f64,
    /// Time of this request.
    pub(crate) clock: Clock,
}

impl Asking {
    /// The applicant's first request was in step `since`.
    pub(crate) fn of(applicant: &Applicant, since: u32, clock: Clock) -> Asking {
        let waited = clock.since(since);
        let is_patient = waited < applicant.style.yielding.patience;
        let priority =
            WaitingPriority { is_patient, since, id: applicant.from.id, is_long: applicant.length >= LONG };
        Asking { priority, waited, clock }
    }

    /// How much less storage space than usual it needs [m]: a driver who is out of patience leaves a smaller gap.
    pub(crate) fn squeezes_into(&self) -> f64 {
        if self.priority.is_patient { 0.0 } else { CLOSES_UP }
    }
}

/// Checks whether the applicant may pass the zones that it has surveyed.
///
/// # Errors
/// The reason why it may not pass.
pub(crate) fn may_pass(
    scene: &Scene,
    applicant: &Applicant,
    survey: &Survey,
    asking: Asking,
) -> Result<(), PassHindrance> {
    let speed = applicant.speed;
    if !survey.lights.iter().all(|(light, at)| lets_go(scene, *light, *at, speed)) {
        return Err(PassHindrance::Light);
    }
    if survey.has_stop_sign && (speed > STOPPED || survey.stop > AT_THE_LINE) {
        return Err(PassHindrance::Sign);
    }
    let (Scene { reservations, lanes, .. }, way) = (*scene, [applicant.from.chain, survey.section.chain]);
    let is_entering = || survey.holds.iter().any(|it| goes_on_through(scene, applicant, it));
    if reservations.roundabouts.is_closed(reservations, lanes, way, asking.priority, survey.needed)
        && !is_entering()
    {
        return Err(PassHindrance::Roundabout);
    }
    // An impatient driver leaves no space: the vehicles with priority may all wait for the driver who would take it.
    let leaves_room = asking.priority.is_patient && !reservations.roundabouts.is_entered(way);
    let space = survey.space - reservations.requested_before(survey.section, asking.priority);
    let needed = survey.needed - asking.squeezes_into();
    let lacks = |spare: f64| space < (needed + spare).min(survey.most);
    let yields_room =
        || leaves_room && lacks(ROOM_FOR_ANOTHER) && survey.holds.iter().any(|it| gives_way(scene, it));
    if needs_space(scene, survey, way) && (lacks(0.0) || yields_room()) {
        return Err(PassHindrance::Space);
    }
    if survey.holds.iter().any(|hold| is_blocked(scene, applicant, hold, asking)) {
        return Err(PassHindrance::Blocked);
    }
    let waits_within = applicant.waits_within_a_zone(scene, survey.stop);
    if survey.holds.iter().all(|hold| may_hold(scene, applicant, hold, asking, waits_within)) {
        Ok(())
    } else {
        Err(PassHindrance::Others)
    }
}

/// Whether a vehicle needs storage space beyond the zones to pass them on its `way`. Around a roundabout, and where it
/// only merges into one, it needs none: that is never full.
fn needs_space(scene: &Scene, survey: &Survey, way: [ChainIndex; 2]) -> bool {
    let Scene { network, reservations, .. } = *scene;
    let kind = |it: &ZoneReservation| network.junctions.zones[it.zone.at()].kind;
    let only_merges = || survey.holds.iter().all(|it| matches!(kind(it), ZoneKind::Merging(_)));
    !(reservations.roundabouts.is_on(way[0]) || reservations.roundabouts.is_entered(way) && only_merges())
}

/// Whether a vehicle with priority comes, waits or passes on the other side of a zone.
fn gives_way(scene: &Scene, hold: &ZoneReservation) -> bool {
    let (zone, side) = (&scene.network.junctions.zones[hold.zone.at()], 1 - hold.side);
    let waits = || scene.reservations.priority(hold.zone, side).is_some();
    let passes = || scene.reservations.order(hold.zone).any(|(it, _)| it.side == side);
    let comes = || lag(scene, hold.zone, &zone.sides[usize::from(side)]) < f64::INFINITY;
    zone.precedence == Precedence::Side(side) && (waits() || passes() || comes())
}

/// Whether a vehicle that lacks storage space may have to stand within a crossing, in the way of the other side, or
/// stands within one of a roundabout.
fn is_blocked(scene: &Scene, applicant: &Applicant, hold: &ZoneReservation, asking: Asking) -> bool {
    let zone = &scene.network.junctions.zones[hold.zone.at()];
    let is_round = scene.reservations.roundabouts.touches(applicant.from.chain);
    let stays = |other: &Reservation| other.lacks_space || is_round && other.stands_in(hold);
    zone.kind == ZoneKind::Crossing && opposite(scene, hold, asking.priority.is_long).any(stays)
}

/// Whether the applicant may have one of the zones. Without it, it may have to stand where it `waits_within` a zone.
fn may_hold(
    scene: &Scene,
    applicant: &Applicant,
    hold: &ZoneReservation,
    asking: Asking,
    waits_within: bool,
) -> bool {
    let zone = &scene.network.junctions.zones[hold.zone.at()];
    let other_side = 1 - hold.side;
    let matters = |it: &WaitingTurn| zone.touch.is_of([asking.priority.is_long, it.priority.is_long]);
    let turn = scene.reservations.priority(hold.zone, other_side).filter(matters);
    // A roundabout clears itself: who waits on it, or on the way out, keeps out whoever waits to enter.
    let enters = || scene.reservations.roundabouts.is_entry(applicant.from.chain);
    let clears_it = |it: &WaitingTurn| it.enters && !asking.priority.is_patient && !enters();
    // Nor does a junction lock if whoever would stand within it comes before those who are out of patience outside.
    let clears_junction = |it: &WaitingTurn| !it.priority.is_patient && !it.is_within && waits_within;
    let waits_for = |it: &WaitingTurn| {
        goes_first(zone.precedence, other_side, it.priority, asking)
            && !is_out_before(scene, applicant, hold, it)
            && !clears_it(it)
            && !clears_junction(it)
    };
    let is_first = goes_on_through(scene, applicant, hold);
    if !is_first && turn.is_some_and(|it| waits_for(&it)) {
        return false;
    }
    let mut others = opposite(scene, hold, asking.priority.is_long);
    let fits = match zone.kind {
        ZoneKind::Merging(_) => {
            others.next_back().is_none_or(|it| follows(scene, applicant, hold, it, asking.clock.dt))
        }
        ZoneKind::Crossing => others.all(|it| clears(scene, applicant, hold, it)),
    };
    fits && (is_first || accepts_lag(scene, applicant, hold, asking))
}

/// Whether the applicant is on its way through a merge of which the zone of `hold` is another part. Whoever comes from
/// the other side goes after it there, and so in all of the merge.
fn goes_on_through(scene: &Scene, applicant: &Applicant, hold: &ZoneReservation) -> bool {
    let zone = |it: &ZoneReservation| &scene.network.junctions.zones[it.zone.at()];
    let chains = |it: &Zone| it.sides.map(|it| it.chain);
    let is_part = |it: &Zone| matches!(it.kind, ZoneKind::Merging(_)) && chains(it) == chains(zone(hold));
    let own = applicant.reservation.into_iter().flat_map(|it| &it.holds);
    own.map(zone).any(is_part)
}

/// Whether the driver who waits for its turn on the other side goes before the asking driver.
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

/// Whether the gap behind `other`, which goes first into the merge, is large enough.
fn follows(
    scene: &Scene,
    applicant: &Applicant,
    hold: &ZoneReservation,
    other: &Reservation,
    dt: f64,
) -> bool {
    let Some(ahead) = leader_into(scene, hold.leave, hold, other) else { return true };
    ahead.gap >= applicant.style.follow.jam_gap() && is_secure(applicant.speed, ahead, dt)
}

/// The nearest vehicle that goes first into a surveyed merge, as a vehicle that is long or not would follow it.
pub(crate) fn leader_of(scene: &Scene, survey: &Survey, is_long: bool) -> Option<Ahead> {
    let zone = |hold: &ZoneReservation| &scene.network.junctions.zones[hold.zone.at()];
    let merges = survey.holds.iter().filter(|it| matches!(zone(it).kind, ZoneKind::Merging(_)));
    let last = |hold: &ZoneReservation| {
        let last = opposite(scene, hold, is_long).next_back();
        last.and_then(|other| leader_into(scene, hold.leave, hold, other))
    };
    merges.filter_map(last).reduce(|a, b| if b.gap < a.gap { b } else { a })
}

/// Whether the lag to vehicles with priority on the other side is long enough. Where lanes merge into a roundabout, it
/// is the time until such a vehicle is where they become one, and drivers with priority brake a little for others
/// (limited priority, Troutbeck and Kako 1999).
fn accepts_lag(scene: &Scene, applicant: &Applicant, hold: &ZoneReservation, asking: Asking) -> bool {
    let zone = &scene.network.junctions.zones[hold.zone.at()];
    let other_side = 1 - hold.side;
    let reach = zone.sides[usize::from(other_side)];
    let yielding = &applicant.style.yielding;
    let needed = || applicant.time_to(hold.leave);
    let lag = |start: f64| lag(scene, hold.zone, &Reach { start, ..reach });
    match zone.precedence {
        Precedence::Side(side) if side == other_side && asking.priority.is_patient => {
            if !scene.reservations.roundabouts.is_entry(applicant.from.chain) {
                return yielding.accepts(lag(reach.start), needed(), asking.waited);
            }
            let start = match zone.kind {
                ZoneKind::Merging(stations) => stations[usize::from(other_side)],
                ZoneKind::Crossing => reach.start,
            };
            yielding.accepts_at_roundabout(lag(start), needed() - LET_IN, asking.waited)
        }
        Precedence::FromTheRight(side) if side == other_side && asking.waited < STANDOFF => {
            lag(reach.start) >= needed() + MARGIN
        }
        _ => true,
    }
}

#[cfg(test)]
mod tests {
    use laneweave_generate::own_maps;
    use laneweave_network::ZoneIndex;

    use super::*;
    use crate::right_of_way::survey::tests::{regulated, standing};
    use crate::route::navigate::Navigator;
    use crate::state::some_style::some_style;
    use crate::view::snapshot::Snapshot;

    #[test]
    fn who_is_on_its_way_through_a_merge_goes_on_through_it_and_through_no_other() {
        let (_, drawing) = own_maps().unwrap().into_iter().find(|it| it.0 == "roundabout.osm").unwrap();
        let network = regulated(&drawing);
        let (navigator, styles) = (Navigator::new(&network), [some_style()]);
        let snapshot = Snapshot::new(&network, [standing()]);
        let scene = snapshot.scene(&network, &navigator, &styles);
        let applicant = Applicant::at(&scene, snapshot.spot(1).unwrap());
        let zones = (0..network.junctions.zones.len() as u32).map(ZoneIndex);
        let merges: Vec<ZoneIndex> = zones
            .filter(|it| matches!(network.junctions.zones[it.at()].kind, ZoneKind::Merging(_)))
            .collect();
        let hold = |zone: ZoneIndex| ZoneReservation { zone, side: 0, enter: 10.0, leave: 20.0 };
        let mut others = 0;
        for held in &merges {
            let mut own = Reservation::default();
            own.holds = vec![hold(*held)];
            let applicant = Applicant { reservation: Some(&own), ..applicant };
            assert!(goes_on_through(&scene, &applicant, &hold(*held)), "{held:?}");
            let lanes = |it: &ZoneIndex| network.junctions.zones[it.at()].sides.map(|it| it.chain);
            for other in merges.iter().filter(|it| lanes(it) != lanes(held)) {
                assert!(!goes_on_through(&scene, &applicant, &hold(*other)), "{held:?} {other:?}");
                others += 1;
            }
        }
        assert!(others > 0, "{} merges", merges.len());
        // Without a reservation it is not on its way at all.
        assert!(!goes_on_through(&scene, &applicant, &hold(merges[0])));
    }
}
