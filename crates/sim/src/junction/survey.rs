//! What a driver sees of the junction ahead: where it has to stop without a passage, and what passage it needs.

use std::ops::ControlFlow;

use laneweave_network::{ChainIndex, Crossing, LightIndex, Place, PlaceKind, Sign};

use super::passages::Hold;
use super::refuge::Refuge;
use crate::accelerate::ROOM_AT_A_STOP;
use crate::scene::{Scene, Spot, Viewpoint};

/// How far before a zone a vehicle stops [m] (ours).
pub(super) const BEFORE_A_ZONE: f64 = 1.0;
/// How far before a zone the first of a queue stands [m].
pub const STANDS_BEFORE_A_ZONE: f64 = BEFORE_A_ZONE + ROOM_AT_A_STOP;
/// How far before a line it stops [m] (ours).
const BEFORE_A_LINE: f64 = 0.3;
/// How far before a line the first of a queue stands [m].
pub const STANDS_BEFORE_A_LINE: f64 = BEFORE_A_LINE + ROOM_AT_A_STOP;
/// Room that a vehicle needs beyond the zones beside its length [m] (ours).
pub(crate) const SPARE_ROOM: f64 = 2.0;
/// A line belongs to the zones that follow within this [m] (ours).
const LINE_TO_ZONE: f64 = 30.0;
/// So far beyond the zones a vehicle is looked for that might leave no room [m] (ours).
const ROOM_SIGHT: f64 = 120.0;
/// Braking that is expected of who is beyond the zones [m/s²] (ours).
const EXPECTED_BRAKING: f64 = 4.0;

/// What passage a driver needs. Distances are those from its front [m].
#[derive(Clone, Debug)]
pub(crate) struct Survey {
    /// Where it stops without.
    pub(crate) stop: f64,
    /// Lights, with the places where their drivers stop.
    pub(crate) lights: Vec<(LightIndex, f64)>,
    /// It has to stop first, whoever comes.
    pub(crate) has_stop_sign: bool,
    /// Sides of zones.
    pub(crate) holds: Vec<Hold>,
    /// Where its front has to get for the rear to be out of all zones.
    pub(crate) extent: f64,
    /// Where it can stand then.
    pub(crate) refuge: Refuge,
    /// Room that it needs there.
    pub(crate) needed: f64,
    /// Room that there is.
    pub(crate) room: f64,
    /// Room that there would be on an empty road.
    pub(crate) most: f64,
}

impl Default for Survey {
    fn default() -> Survey {
        Survey {
            stop: 0.0,
            lights: Vec::new(),
            has_stop_sign: false,
            holds: Vec::new(),
            extent: 0.0,
            refuge: Refuge::first_of(ChainIndex(0)),
            needed: 0.0,
            room: 0.0,
            most: 0.0,
        }
    }
}

/// A place on a driver's way where it may have to stop.
#[derive(Clone, Copy)]
pub(crate) struct Point {
    /// Where the front has to stay behind [m].
    pub(crate) stop: f64,
    pub(super) what: What,
}

impl Point {
    /// `place` on a chain whose start is `base` ahead [m].
    fn of(place: &Place, base: f64) -> Point {
        let at = base + place.station;
        match place.what {
            PlaceKind::Sign(sign) => Point { stop: at - BEFORE_A_LINE, what: What::Sign(sign) },
            PlaceKind::Zone { crossing, end, merge } => {
                let what = What::Zone(crossing, base + end, merge.map(|it| base + it));
                Point { stop: at - BEFORE_A_ZONE, what }
            }
        }
    }
}

#[derive(Clone, Copy)]
pub(super) enum What {
    Sign(Sign),
    /// A zone, its end, and the place where the lanes become one, if they do [m].
    Zone(Crossing, f64, Option<f64>),
}

/// Visits the places on the way of who looks `from`, in order, up to `until` [m]. Returns how far the way goes on.
fn points(
    scene: &Scene,
    from: Viewpoint,
    until: f64,
    mut visit: impl FnMut(Point, f64, ChainIndex) -> ControlFlow<()>,
) -> f64 {
    let junctions = &scene.network.junctions;
    let (mut chain, mut base) = (from.chain, -from.x);
    loop {
        let places = &junctions.on(chain).places[..];
        let trip_end = base + scene.navigator.trip_end(from.destination, chain);
        let trip_end = if trip_end > 0.0 { trip_end } else { f64::INFINITY };
        // Who has its front beyond a place has passed it.
        let passed = places.partition_point(|it| base + it.station <= 0.0);
        for place in &places[passed..] {
            let at = base + place.station;
            if at > trip_end {
                return f64::INFINITY;
            }
            if at > until {
                return until;
            }
            if visit(Point::of(place, base), at, chain).is_break() {
                return at;
            }
        }
        if trip_end < f64::INFINITY {
            return f64::INFINITY;
        }
        base += scene.network.chain(chain).length;
        if base > until {
            return until;
        }
        match scene.next(from.destination, chain) {
            Some(next) => chain = next,
            None if scene.network.chain(chain).is_lane_drop => return base,
            None => return f64::INFINITY,
        }
    }
}

/// The nearest place ahead within `until` [m] where who looks `from` has to stop without a further passage than the
/// `granted` [m] it has. None if a vehicle ahead has to stop first.
pub(crate) fn stop_ahead(scene: &Scene, from: Viewpoint, granted: f64, until: f64) -> Option<Point> {
    if granted >= until {
        return None;
    }
    let until = until.min(shield(scene, from, until));
    if is_far(scene, from, until) {
        return None;
    }
    let mut found = None;
    points(scene, from, until, |point, at, _| {
        if at <= granted {
            return ControlFlow::Continue(());
        }
        found = Some(point);
        ControlFlow::Break(())
    });
    found
}

/// Whether there is a place within `until` [m] where who looks `from` might have to stop.
pub(crate) fn is_place_ahead(scene: &Scene, from: Viewpoint, until: f64) -> bool {
    if is_far(scene, from, until) {
        return false;
    }
    let mut is_there = false;
    points(scene, from, until, |_, _, _| {
        is_there = true;
        ControlFlow::Break(())
    });
    is_there
}

/// Whether there is no place within `until` [m], whichever way one goes.
#[inline]
pub(super) fn is_far(scene: &Scene, from: Viewpoint, until: f64) -> bool {
    /// Sums of lengths are not told apart closer than this [m].
    const ROUNDING: f64 = 0.001;
    let length = scene.network.chain(from.chain).length;
    scene.network.junctions.free_way(from.chain, from.x, length) - ROUNDING > until
}

/// How far the way of the vehicle ahead is free [m]: who is behind it need not look further.
fn shield(scene: &Scene, from: Viewpoint, until: f64) -> f64 {
    let (mut chain, mut index, mut base) = (from.chain, from.ahead, -from.x);
    if let Some(rear) = scene.waits_beside_in_fork(from) {
        return rear - from.x;
    }
    loop {
        let lane = &scene.lanes[chain.at()];
        let ahead = lane.motions()[index..].iter().zip(index..).find(|(it, _)| it.id != from.id);
        if let Some((motion, index)) = ahead {
            let passage = scene.passage(Spot { chain, index });
            return base + motion.x + passage.map_or(0.0, |it| it.left().max(0.0));
        }
        base += scene.network.chain(chain).length;
        let Some(next) = scene.next(from.destination, chain).filter(|_| base < until) else {
            return f64::INFINITY;
        };
        // Who waits within the fork is in the way of all that come after.
        if let Some(rear) = scene.waits_in_fork(chain, next, from.id) {
            return base + rear;
        }
        (chain, index) = (next, 0);
    }
}

/// Surveys the passage that the vehicle of `length` [m] that looks `from` needs next, beyond the `granted` [m] it has. Returns
/// whether there is one within `until` [m]. Nothing is surveyed beyond a light so far ahead that `is_held` there.
pub(crate) fn survey(
    scene: &Scene,
    from: Viewpoint,
    length: f64,
    [granted, until]: [f64; 2],
    is_held: impl Fn(LightIndex, f64) -> bool,
    out: &mut Survey,
) -> bool {
    out.lights.clear();
    out.holds.clear();
    out.has_stop_sign = false;
    let mut first: Option<f64> = None;
    let mut ends = false;
    let mut clear = f64::NEG_INFINITY;
    let mut next_stop = f64::INFINITY;
    let far = until + ROOM_SIGHT;
    let way_end = points(scene, from, far, |point, at, _| {
        if at <= granted {
            return ControlFlow::Continue(());
        }
        if first.is_none() && at > until {
            return ControlFlow::Break(());
        }
        let start = *first.get_or_insert(point.stop);
        let is_apart = match point.what {
            _ if clear > f64::NEG_INFINITY => point.stop - ROOM_AT_A_STOP >= clear + length + SPARE_ROOM,
            _ => point.stop > start + LINE_TO_ZONE,
        };
        if is_apart {
            next_stop = point.stop - ROOM_AT_A_STOP;
            return ControlFlow::Break(());
        }
        match point.what {
            What::Sign(Sign::Light(light)) => {
                out.lights.push((light, point.stop));
                ends = is_held(light, point.stop);
                if ends {
                    return ControlFlow::Break(());
                }
            }
            What::Sign(Sign::Stop) => out.has_stop_sign |= point.stop < start + LINE_TO_ZONE,
            What::Sign(Sign::Line) => {}
            What::Zone(crossing, end, merge) => {
                let leave = merge.unwrap_or(end + length);
                let Crossing { zone, side } = crossing;
                out.holds.push(Hold { zone, side, enter: at, leave });
                clear = clear.max(end.min(merge.unwrap_or(f64::INFINITY)));
            }
        }
        ControlFlow::Continue(())
    });
    let Some(start) = first else { return false };
    out.stop = start;
    if ends {
        out.holds.clear();
        out.extent = f64::NEG_INFINITY;
        return true;
    }
    let clear = if clear > f64::NEG_INFINITY { clear } else { start + BEFORE_A_ZONE };
    out.extent = clear + length;
    out.needed = length + SPARE_ROOM;
    let beyond = chain_at(scene, from, clear);
    out.refuge = Refuge::at(&scene.network.junctions, beyond.0, clear - beyond.1);
    let limit = if next_stop < f64::INFINITY || way_end >= far { next_stop } else { way_end };
    // Whose trip ends before the next place is behind others who stop there.
    let place = next_place(scene, beyond, clear) - ROOM_AT_A_STOP;
    let limit = if place - clear >= out.needed { limit.min(place) } else { limit };
    out.most = (limit - clear).max(out.needed);
    out.room = room(scene, from, out.refuge, clear, limit);
    true
}

/// The chain on the way on which the place `distance` ahead lies, and how far ahead its start is [m].
fn chain_at(scene: &Scene, from: Viewpoint, distance: f64) -> (ChainIndex, f64) {
    let (mut chain, mut start) = (from.chain, -from.x);
    loop {
        let end = start + scene.network.chain(chain).length;
        let Some(next) = scene.next(from.destination, chain).filter(|_| end <= distance) else {
            return (chain, start);
        };
        (chain, start) = (next, end);
    }
}

/// Where the vehicle that looks `from` would stand after the passage that it surveyed, back to front.
pub(crate) fn refuges(scene: &Scene, from: Viewpoint, survey: &Survey) -> impl Iterator<Item = Refuge> {
    let (rear, front) = (survey.refuge, survey.extent);
    let (_, start) = chain_at(scene, from, front - survey.needed + SPARE_ROOM);
    let next = move |(at, start): &(Refuge, f64)| {
        let end = start + scene.network.chain(at.chain).length;
        let next = scene.next(from.destination, at.chain).filter(|_| end < front)?;
        Some((Refuge::first_of(next), end))
    };
    std::iter::successors(Some((rear, start)), next).map(|(at, _)| at)
}

/// How far ahead the next place is, beyond `distance` but on the chain that starts so far ahead, where drivers may have to
/// stop [m].
fn next_place(scene: &Scene, (chain, start): (ChainIndex, f64), distance: f64) -> f64 {
    let places = scene.network.junctions.on(chain).places.iter();
    let stops = places.map(|it| start + Point::of(it, 0.0).stop);
    stops.filter(|it| *it > distance).fold(f64::INFINITY, f64::min)
}

/// Distances are not told apart closer than this [m].
pub(super) const ROUNDING: f64 = 0.5;

/// Where the vehicle at `spot`, whose chain begins `base` ahead, parts from the way of who looks `from` [m]; infinite if it
/// goes on along it.
pub(super) fn parts(scene: &Scene, from: Viewpoint, spot: Spot, base: f64) -> f64 {
    let own = scene.next(from.destination, spot.chain);
    let theirs = scene.next(scene.car(spot).goal.destination(), spot.chain);
    match theirs {
        Some(next) if theirs != own => {
            base + scene.network.chain(spot.chain).length + scene.network.chain(next).fork_clearance
        }
        _ => f64::INFINITY,
    }
}

/// Room from `clear` on [m], which lies on `refuge`, to `limit` or to where the vehicles that are out of the zones can all have
/// stopped; none if somebody ahead who is not out of them, and of the way, has no passage out.
fn room(scene: &Scene, from: Viewpoint, refuge: Refuge, clear: f64, limit: f64) -> f64 {
    const NONE: f64 = f64::NEG_INFINITY;
    if scene.waits_beside_in_fork(from).is_some() {
        return NONE;
    }
    let (mut chain, mut index, mut base) = (from.chain, from.ahead, -from.x);
    let mut taken = scene.passages.kept_on(refuge);
    let mut end = f64::INFINITY;
    loop {
        let lane = &scene.lanes[chain.at()];
        for (motion, index) in lane.motions()[index..].iter().zip(index..) {
            let rear = base + motion.rear();
            if motion.id == from.id {
                continue;
            }
            if rear > limit || rear > clear + ROOM_SIGHT {
                return end.min(limit.min(clear + ROOM_SIGHT) - taken) - clear;
            }
            let passage = scene.passages.of(lane.minds()[index].passage, motion.id);
            let gets_to = rear + passage.map_or(0.0, |it| it.left().max(0.0));
            if rear >= clear {
                // Whose passage leads beyond the room does not stop in it.
                if gets_to < limit {
                    let stops_at = rear + motion.speed * motion.speed / (2.0 * EXPECTED_BRAKING);
                    end = end.min(stops_at.max(gets_to) - taken);
                    taken += f64::from(motion.length) + SPARE_ROOM;
                }
                continue;
            }
            if gets_to < clear.min(parts(scene, from, Spot { chain, index }, base)) - ROUNDING {
                return NONE;
            }
        }
        base += scene.network.chain(chain).length;
        match scene.next(from.destination, chain) {
            Some(next) if base < clear + ROOM_SIGHT => {
                if base < clear && scene.waits_in_fork(chain, next, from.id).is_some() {
                    return NONE;
                }
                (chain, index) = (next, 0);
            }
            _ => return end.min(limit.min(clear + ROOM_SIGHT) - taken) - clear,
        }
    }
}
