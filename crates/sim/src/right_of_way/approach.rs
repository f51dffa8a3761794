//! What a driver reacts to at a junction while it drives on.

use laneweave_models::braking::stays_secure;
use laneweave_models::follow::Ahead;
use laneweave_network::{ChainIndex, LightIndex, LightState, Precedence, Sign, Touch, Zone, ZoneKind};

use crate::junction::reservations::Reservation;
use crate::junction::waiting_priority::ZoneReservation;
use crate::right_of_way::survey::{BEFORE_A_ZONE, Point, What, is_far, parts, stop_ahead, stops_before};
use crate::state::lane::Kinematics;
use crate::state::standstill::ROOM_AT_A_STOP;
use crate::state::standstill::STANDS;
use crate::state::standstill::STANDSTILL;
use crate::view::scene::{Scene, Spot, Viewpoint, nearer};

/// Vehicles of at least this length take up both lanes of a tight bend [m] (ours).
pub(crate) const LONG: f64 = 7.0;
/// A driver stops at a light that turns yellow if braking at most this hard is enough [m/s²] (ours; usual in the
/// design of yellow times).
pub const STOPS_AT_YELLOW: f64 = 3.0;
/// Drivers ask for their reservation so early that they need not brake harder than this [m/s²], and this much earlier
/// [s] (ours).
const GENTLE: f64 = 1.5;
const EARLY: f64 = 1.5;
/// They ask at this distance at the latest [m].
const NEAR: f64 = 10.0;
/// At a roundabout they ask just before they would have to brake, with the braking with which they do [m/s²], and this
/// much earlier [s] and [m] (ours). A driver with priority has a place in the order of a zone from then on. So it keeps
/// others waiting no longer than it has to, and these judge the gap before it.
const BRAKES: f64 = 2.0;
const EARLY_AT_A_ROUNDABOUT: f64 = 0.5;
const NEAR_AT_A_ROUNDABOUT: f64 = 2.0;
/// Drivers who give way to a roundabout look for a gap from this distance and the way of a step before their line on
/// [m], and come to it so that they can stop (ours: with it one follows another into it after 2.7 s, HCM 6: 2.6 s, from
/// memory).
const LOOKS_FROM: f64 = 4.0;
/// A reservation ends this far before a zone from which on it is revoked [m], so that the driver has to ask for that
/// zone again.
const BEFORE_REVOKED: f64 = 0.2;
/// A vehicle that is nearer to a zone may be in it before its reservation of it is revoked [m].
const NEARLY_IN: f64 = 0.5;

/// What a driver reacts to at a junction.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Junction {
    /// Distance from the front to the place where it has to stop [m].
    pub(crate) stop: Option<f64>,
    /// The vehicle that it follows into a merge.
    pub(crate) leader: Option<FirstIntoMerge>,
    /// It waits for a reservation.
    pub(crate) asks: bool,
    /// It waits at the next light until that changes.
    pub(crate) is_held: bool,
    /// The part of its reservation that it cannot use now begins here, measured from the start of the reservation
    /// [m]. Either a light on its route is no longer green and it can stop there, or the vehicle stands and a vehicle
    /// without a reservation is in front of it.
    pub(crate) revokes_from: Option<f64>,
}

/// A vehicle that goes into a merge before the driver. It may still be on another road.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FirstIntoMerge {
    /// Itself, as a leader: as far ahead as it will be on the common lane.
    pub(crate) ahead: Ahead,
    /// Distance from the own front to the place where the driver can wait for it before the merge [m]; 0 if it is past
    /// that.
    pub(crate) stop: f64,
}

/// How far ahead a driver on `chain` at `speed` [m/s] reacts to junctions [m]: at a roundabout before it would have to
/// brake in the next step.
#[inline]
pub(crate) fn sight(scene: &Scene, chain: ChainIndex, speed: f64) -> f64 {
    if scene.reservations.roundabouts.touches(chain) {
        speed * speed / (2.0 * BRAKES) + (EARLY_AT_A_ROUNDABOUT + scene.dt) * speed + NEAR_AT_A_ROUNDABOUT
    } else {
        speed * speed / (2.0 * GENTLE) + EARLY * speed + NEAR
    }
}

/// Whether the driver at `spot` is far from all junctions and has no reservation. Then it has nothing to react to.
#[inline]
pub(crate) fn is_nothing_near(scene: &Scene, spot: Spot) -> bool {
    let until = sight(scene, spot.chain, scene.motion(spot).speed);
    is_far(scene, scene.viewpoint(spot), until) && scene.reservation(spot).is_none()
}

/// What the driver at `spot` reacts to.
#[inline]
pub(crate) fn look(scene: &Scene, spot: Spot) -> Junction {
    if is_nothing_near(scene, spot) {
        return Junction::default();
    }
    look_closely(scene, spot, sight(scene, spot.chain, scene.motion(spot).speed))
}

/// What the driver at `spot` reacts to within `until` [m].
#[inline(never)]
fn look_closely(scene: &Scene, spot: Spot, until: f64) -> Junction {
    let (motion, driver) = (scene.motion(spot), scene.driver(spot));
    let mut junction = Junction::default();
    let mut granted = 0.0;
    if let Some(reservation) = scene.reservation(spot) {
        yield_to_earlier(scene, spot, reservation, &mut junction);
        junction.revokes_from = to_revoke(scene, reservation, motion.speed);
        if junction.revokes_from.is_none() && motion.speed < STANDSTILL {
            junction.revokes_from =
                cut_off_from(scene, spot, reservation).or_else(|| held_up_from(scene, spot, reservation));
        }
        // A revoked part is no longer used.
        let left = junction.revokes_from.map_or(reservation.left(), |from| from - reservation.travelled);
        granted = left.max(0.0);
    }
    if let Some(Point { stop, what }) = stop_ahead(scene, scene.viewpoint(spot), granted, until) {
        junction.stop = Some(junction.stop.map_or(stop, |it| it.min(stop)));
        // A driver who has to leave the lane before the place does not ask.
        let keeps_lane = scene.lane_change(spot).last_place >= motion.x + stop;
        let is_settled = !driver.phase.is_between_lanes();
        let may_ask = !driver.is_shadow && is_settled && junction.revokes_from.is_none() && keeps_lane;
        let is_entry = scene.reservations.roundabouts.is_entry(spot.chain);
        let looks = stop - motion.speed * scene.dt < LOOKS_FROM || !is_entry || !gives_way(scene, &what);
        junction.asks = may_ask && looks && is_first(scene, scene.viewpoint(spot), stop);
        junction.is_held =
            matches!(what, What::Sign(Sign::Light(it)) if !lets_go(scene, it, stop, motion.speed));
    }
    junction
}

/// Whether a driver has to give way at a place.
fn gives_way(scene: &Scene, what: &What) -> bool {
    match what {
        What::Sign(sign) => *sign == Sign::Line,
        What::Zone(crossing, ..) => match scene.network.junctions.zones[crossing.zone.at()].precedence {
            Precedence::Side(side) | Precedence::FromTheRight(side) => side != crossing.side,
            Precedence::Arrival => false,
        },
    }
}

/// Whether no vehicle ahead has to stop before a place `stop` metres ahead, or stands there at a roundabout.
fn is_first(scene: &Scene, from: Viewpoint, stop: f64) -> bool {
    let is_round = || scene.reservations.roundabouts.touches(from.chain);
    let stands_before = || scene.ahead(from).is_some_and(|it| it.gap < stop && it.speed < STANDSTILL);
    !(stops_before(scene, from, stop) || is_round() && stands_before())
}

/// Whether a driver at `speed` [m/s] passes a light whose stopping place is `at` metres ahead.
pub(crate) fn lets_go(scene: &Scene, light: LightIndex, at: f64, speed: f64) -> bool {
    match scene.light(light) {
        LightState::Green => true,
        LightState::Yellow => !stops_gently(speed, at),
        LightState::Red => false,
    }
}

/// The vehicles with reservations on the other side of a zone that are in the way of one that is long or not, in the
/// order of the zone.
pub(crate) fn opposite<'a>(
    scene: &'a Scene,
    hold: &ZoneReservation,
    is_long: bool,
) -> impl DoubleEndedIterator<Item = &'a Reservation> {
    let (side, touch) = (hold.side, scene.network.junctions.zones[hold.zone.at()].touch);
    let all = scene.reservations.order(hold.zone);
    let others =
        all.filter(move |(it, other)| it.side != side && touch.is_of([is_long, other.length >= LONG]));
    others.map(|(_, other)| other)
}

/// Those of them that go before a vehicle with a `reservation`.
pub(crate) fn earlier<'a>(
    scene: &'a Scene,
    reservation: &'a Reservation,
    hold: &ZoneReservation,
) -> impl Iterator<Item = &'a Reservation> {
    let (side, touch) = (hold.side, scene.network.junctions.zones[hold.zone.at()].touch);
    let matters =
        move |other: &Reservation| touch.is_of([reservation.length, other.length].map(|it| it >= LONG));
    let is_own = move |other: &Reservation| other.vehicle == reservation.vehicle;
    let before =
        scene.reservations.order(hold.zone).take_while(move |(it, other)| !is_own(other) || it.side != side);
    let others = before.filter(move |(it, other)| it.side != side && !is_own(other) && matters(other));
    others.map(|(_, other)| other)
}

/// Makes the driver yield to vehicles that go before it through a zone.
fn yield_to_earlier(scene: &Scene, spot: Spot, reservation: &Reservation, junction: &mut Junction) {
    let is_round = scene.reservations.roundabouts.touches(spot.chain);
    for hold in &reservation.holds {
        let Zone { kind, .. } = scene.network.junctions.zones[hold.zone.at()];
        let mut others = earlier(scene, reservation, hold);
        match kind {
            ZoneKind::Merging(stations) => {
                let to_merge = hold.leave - reservation.travelled;
                let first = others.last().and_then(|it| leader_into(scene, to_merge, hold, it));
                let beside = || beside(scene, hold, stations, to_merge);
                let first = if is_round { nearer(first, beside()) } else { first };
                if let Some(ahead) = first
                    && junction.leader.is_none_or(|it| ahead.gap < it.ahead.gap)
                {
                    let stop = (hold.enter - reservation.travelled - BEFORE_A_ZONE).max(0.0);
                    junction.leader = Some(FirstIntoMerge { ahead, stop });
                }
            }
            ZoneKind::Crossing => {
                let distance = hold.enter - reservation.travelled;
                if distance > 0.0 && others.next().is_some() {
                    let stop = distance - BEFORE_A_ZONE;
                    junction.stop = Some(junction.stop.map_or(stop, |it| it.min(stop)));
                }
            }
        }
    }
}

/// Of the vehicles in the zone on the other side of a merge into a roundabout, the one before a driver in the zone, as
/// a leader. The driver is `to_merge` before the merge [m]. Drivers keep the order of a zone, so none is there, but
/// users need not.
fn beside(scene: &Scene, hold: &ZoneReservation, stations: [f64; 2], to_merge: f64) -> Option<Ahead> {
    if to_merge > hold.leave - hold.enter {
        return None;
    }
    let other_side = usize::from(1 - hold.side);
    let reach = &scene.network.junctions.zones[hold.zone.at()].sides[other_side];
    let ahead = |it: &Kinematics| {
        let theirs = stations[other_side] - it.x;
        let is_nearer = (reach.start..reach.end).contains(&it.x) && theirs < to_merge;
        is_nearer.then(|| it.ahead(to_merge - theirs - f64::from(it.length)))
    };
    let all = scene.motions(reach.chain).iter().filter_map(ahead);
    all.reduce(|a, b| if b.gap < a.gap { b } else { a })
}

/// The vehicle `other`, which goes first into the merge `to_merge` ahead [m], as a leader. Its gap follows from its
/// distance to the merge. Where lanes lead side by side through a bend, in which long vehicles touch, the outer one is
/// longer: a metre on one counts as many as the zone is longer on the other. Drivers on another road see its speed, not
/// its acceleration (ours).
pub(crate) fn leader_into(
    scene: &Scene,
    to_merge: f64,
    hold: &ZoneReservation,
    other: &Reservation,
) -> Option<Ahead> {
    let theirs = other.across(hold)?;
    let is_beside = scene.network.junctions.zones[hold.zone.at()].touch != Touch::Any;
    let scale = if is_beside { (hold.leave - hold.enter) / (theirs.leave - theirs.enter) } else { 1.0 };
    let gap = to_merge - scale * (theirs.leave - other.travelled + other.length);
    Some(Ahead::steady(gap, other.speed))
}

/// Where a vehicle without a reservation blocks the reservation of the driver at `spot`, measured from the start of
/// the reservation [m]. Such a vehicle may have changed lanes in front of the driver. It may wait for others that
/// wait for this reservation.
fn cut_off_from(scene: &Scene, spot: Spot, reservation: &Reservation) -> Option<f64> {
    let from = scene.viewpoint(spot);
    let leader =
        scene.leader_spot(from).filter(|it| scene.reservation(*it).is_none_or(|own| own.left() <= 0.0))?;
    let gap = scene.ahead(from)?.gap;
    let until = parts(scene, from, leader, gap - scene.motion(leader).rear());
    let zones = reservation.holds.iter().map(|it| it.enter - reservation.travelled);
    let next = zones.filter(|it| *it > gap.max(0.0)).fold(f64::INFINITY, f64::min);
    (next < f64::INFINITY && gap < until).then_some(reservation.travelled + gap.max(0.0))
}

/// Where the first zone begins that the driver at `spot`, who stands at a roundabout, has not entered yet, measured
/// from the start of its reservation [m], if it cannot use one of them now: a vehicle that goes before it there stands,
/// too, or its leader stands before that zone. These may wait for what the driver holds beyond. It returns all of these
/// zones. If it kept some, others would go after it there and before it elsewhere, and each would wait for the other.
/// For that reason drivers keep their places at other junctions, where zones do not lie one after the other.
fn held_up_from(scene: &Scene, spot: Spot, reservation: &Reservation) -> Option<f64> {
    if !scene.reservations.roundabouts.touches(spot.chain) {
        return None;
    }
    let standing = scene.ahead(scene.viewpoint(spot)).filter(|it| it.speed < STANDSTILL);
    let free = reservation.travelled + standing.map_or(f64::INFINITY, |it| it.gap);
    let is_held_up = |it: &ZoneReservation| {
        it.enter > free || earlier(scene, reservation, it).any(|other| other.speed < STANDSTILL)
    };
    let mut ahead = reservation.holds.iter().filter(|it| it.enter > reservation.travelled + NEARLY_IN);
    let first = ahead.clone().map(|it| it.enter - BEFORE_REVOKED).reduce(f64::min);
    first.filter(|_| ahead.any(is_held_up))
}

/// Where a driver stops for the first light that is no longer green, measured from the start of its reservation [m].
/// `None` if it cannot stop there comfortably and outside of all zones.
fn to_revoke(scene: &Scene, reservation: &Reservation, speed: f64) -> Option<f64> {
    let is_red = |it: &(LightIndex, f64)| it.1 > 0.0 && scene.light(it.0) != LightState::Green;
    let (_, at) = reservation.lights().find(is_red)?;
    let line = reservation.travelled + at;
    // The place where its front would stand.
    let zone = reservation.zone_over(line - ROOM_AT_A_STOP);
    let from = zone.map_or(line, |it| line.min(it - BEFORE_REVOKED));
    let stop = zone.map_or(line, |it| line.min(it - BEFORE_A_ZONE)) - reservation.travelled;
    let left = from - reservation.travelled;
    let slower = (speed - STOPS_AT_YELLOW * scene.dt).max(0.0);
    let is_secure = slower == 0.0 || stays_secure(speed, slower, Ahead::standing(stop), scene.dt);
    (left > 0.0 && is_secure && stops_gently(speed, stop.max(0.5 * left))).then_some(from)
}

/// Whether a driver at `speed` [m/s] can stop without hard braking for a place `at` metres ahead. It stops with room
/// before the place; a slow driver needs less.
fn stops_gently(speed: f64, at: f64) -> bool {
    /// The part of the way that is enough for a slow driver (ours).
    const SLOWLY: f64 = 0.25;
    let way = if speed < STANDS { at } else { (at - ROOM_AT_A_STOP).max(SLOWLY * at) };
    speed * speed <= 2.0 * STOPS_AT_YELLOW * way.max(0.0)
}
