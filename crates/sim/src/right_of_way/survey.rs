//! The survey of the junction ahead: where a driver has to stop without a reservation, and which reservation it
//! needs.

use std::cell::Cell;
use std::ops::ControlFlow;

use laneweave_network::{ChainIndex, Class, Crossing, LightIndex, Place, PlaceKind, Sign};

use crate::junction::need::{LINE_TO_ZONE, SPARE_SPACE, Survey};
use crate::junction::storage_section::StorageSection;
use crate::junction::waiting_priority::ZoneReservation;
use crate::right_of_way::applicant::Applicant;
use crate::right_of_way::storage_space::{Beyond, SPACE_SIGHT, space};
use crate::route::walk::Leg;
use crate::state::previous_lanes::PreviousLanes;
use crate::state::standstill::ROOM_AT_A_STOP;
use crate::view::scene::{Scene, Spot, Viewpoint};

/// A vehicle stops this far before a zone [m] (ours).
pub(crate) const BEFORE_A_ZONE: f64 = 1.0;
/// The first vehicle of a queue stands this far before a zone [m].
pub const STANDS_BEFORE_A_ZONE: f64 = BEFORE_A_ZONE + ROOM_AT_A_STOP;
/// A vehicle stops this far before a line [m] (ours).
const BEFORE_A_LINE: f64 = 0.3;
/// The first vehicle of a queue stands this far before a line [m].
pub const STANDS_BEFORE_A_LINE: f64 = BEFORE_A_LINE + ROOM_AT_A_STOP;
/// A reservation reaches this far beyond the last place within it [m]: more than the rounding of distances (ours).
const PAST_A_PLACE: f64 = 0.1;

/// A place on a driver's route where it may have to stop.
#[derive(Clone, Copy)]
pub(crate) struct Point {
    /// The front has to stay before this [m].
    pub(crate) stop: f64,
    pub(crate) what: What,
}

impl Point {
    /// `place` on a chain whose start is `base` ahead [m].
    fn of(place: &Place, base: f64) -> Point {
        let at = base + place.station;
        match place.what {
            PlaceKind::Sign(sign) => Point { stop: at - BEFORE_A_LINE, what: What::Sign(sign) },
            PlaceKind::Zone { crossing, end, merge, .. } => {
                let what = What::Zone(crossing, base + end, merge.map(|it| base + it));
                Point { stop: at - BEFORE_A_ZONE, what }
            }
        }
    }
}

#[derive(Clone, Copy)]
pub(crate) enum What {
    Sign(Sign),
    /// A zone, its end [m], and the place where the lanes merge, if they do [m].
    Zone(Crossing, f64, Option<f64>),
}

/// Visits the places on the route from `from`, in order, up to `until` [m]. `visit` may increase `until`. Returns how
/// far the route goes on [m].
fn points(
    scene: &Scene,
    from: Viewpoint,
    until: &Cell<f64>,
    mut visit: impl FnMut(Point, f64, ChainIndex) -> ControlFlow<()>,
) -> f64 {
    let junctions = &scene.network.junctions;
    let mut walk = scene.walk(from).within(until.get());
    while let Some(Leg { chain, start: base, .. }) = walk.next() {
        let places = &junctions.on(chain).places[..];
        let way_end = base + scene.navigator.end_of_way(from.destination, chain);
        let way_end = if way_end > 0.0 { way_end } else { f64::INFINITY };
        // A vehicle whose front is beyond a place has passed it.
        let passed = places.partition_point(|it| base + it.station <= 0.0);
        for place in &places[passed..] {
            let at = base + place.station;
            if at > way_end {
                return f64::INFINITY;
            }
            if at > until.get() {
                return until.get();
            }
            if !concerns(place, from.class) {
                continue;
            }
            if visit(Point::of(place, base), at, chain).is_break() {
                return at;
            }
        }
        if way_end < f64::INFINITY {
            return f64::INFINITY;
        }
        walk.look_on(until.get());
    }
    let (last, end) = (scene.network.chain(walk.at()), walk.end());
    if end >= until.get() {
        return until.get();
    }
    if !last.ends_for.has(from.class) {
        return f64::INFINITY;
    }
    end - last.length + last.driven_until(from.class.is_long())
}

/// Whether a place concerns vehicles of this kind, long or not.
fn concerns(place: &Place, class: Class) -> bool {
    match place.what {
        PlaceKind::Sign(_) => true,
        PlaceKind::Zone { touch, .. } => touch.concerns(class.is_long()),
    }
}

/// The nearest place within `until` [m] where the vehicle at `from` has to stop, beyond the `granted` [m] of its
/// reservation.
pub(crate) fn stop_ahead(scene: &Scene, from: Viewpoint, granted: f64, until: f64) -> Option<Point> {
    if granted >= until || is_far(scene, from, until) {
        return None;
    }
    let mut found = None;
    points(scene, from, &Cell::new(until), |point, at, _| {
        if at <= granted {
            return ControlFlow::Continue(());
        }
        found = Some(point);
        ControlFlow::Break(())
    });
    found
}

/// Whether there is a place within `until` [m] where the vehicle at `from` may have to stop.
pub(crate) fn is_place_ahead(scene: &Scene, from: Viewpoint, until: f64) -> bool {
    if is_far(scene, from, until) {
        return false;
    }
    let mut is_there = false;
    points(scene, from, &Cell::new(until), |_, _, _| {
        is_there = true;
        ControlFlow::Break(())
    });
    is_there
}

/// Whether there is no place within `until` [m] on any route.
#[inline]
pub(crate) fn is_far(scene: &Scene, from: Viewpoint, until: f64) -> bool {
    /// Rounding error of sums of lengths [m].
    const ROUNDING: f64 = 0.001;
    let length = scene.network.chain(from.chain).length;
    scene.network.junctions.free_way(from.chain, from.x, length) - ROUNDING > until
}

/// Whether a vehicle ahead has to stop before the vehicle at `from` comes to a place `distance` ahead [m].
pub(crate) fn stops_before(scene: &Scene, from: Viewpoint, distance: f64) -> bool {
    shield(scene, from, distance) < distance
}

/// How far ahead the vehicle in front can drive, as far as `until` [m].
fn shield(scene: &Scene, from: Viewpoint, until: f64) -> f64 {
    let mut first = from.ahead;
    for leg in scene.walk(from).within(until) {
        let Leg { chain, start, .. } = leg;
        // A vehicle that waits within the fork blocks all that come after it.
        if let Some(rear) = scene.waits_beside_in_fork(leg, from) {
            return start + rear;
        }
        let lane = &scene.lanes[chain.at()];
        let ahead = lane.motions()[first..].iter().zip(first..).find(|(it, _)| it.id != from.id);
        if let Some((motion, index)) = ahead {
            let reservation = scene.reservation(Spot { chain, index });
            return start + motion.x + reservation.map_or(0.0, |it| it.left().max(0.0));
        }
        first = 0;
    }
    f64::INFINITY
}

/// Surveys the reservation that the applicant needs next, beyond the `granted` [m] that it has. Returns whether it
/// needs one within `until` [m]. The survey ends at a light where the driver `is_held`.
pub(crate) fn survey(
    scene: &Scene,
    applicant: &Applicant,
    [granted, until]: [f64; 2],
    is_held: impl Fn(LightIndex, f64) -> bool,
    out: &mut Survey,
) -> bool {
    let Applicant { from, length, .. } = *applicant;
    out.lights.clear();
    out.holds.clear();
    out.has_stop_sign = false;
    let mut first: Option<f64> = None;
    let mut ends = false;
    let mut clear = f64::NEG_INFINITY;
    // The last place within the reservation: the vehicle no longer stops there.
    let mut last = f64::NEG_INFINITY;
    let mut next_stop = f64::INFINITY;
    // As far as the vehicle needs storage space: zones may be longer than the sight.
    let far = Cell::new(until + SPACE_SIGHT);
    let way_end = points(scene, from, &far, |point, at, _| {
        if at <= granted {
            return ControlFlow::Continue(());
        }
        if first.is_none() && at > until {
            return ControlFlow::Break(());
        }
        let start = *first.get_or_insert(point.stop);
        let is_apart = match point.what {
            _ if clear > f64::NEG_INFINITY => point.stop - ROOM_AT_A_STOP >= clear + length + SPARE_SPACE,
            _ => point.stop > start + LINE_TO_ZONE,
        };
        if is_apart {
            next_stop = point.stop - ROOM_AT_A_STOP;
            return ControlFlow::Break(());
        }
        last = at;
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
                out.holds.push(ZoneReservation { zone, side, enter: at, leave });
                clear = clear.max(end.min(merge.unwrap_or(f64::INFINITY)));
                far.set(far.get().max(clear + length + SPACE_SIGHT));
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
    out.extent = (clear + length).max(last + PAST_A_PLACE);
    out.needed = length + SPARE_SPACE;
    let limit = if next_stop < f64::INFINITY || way_end >= far.get() { next_stop } else { way_end };
    note_storage(scene, applicant, [clear, limit], out);
    true
}

/// Notes the storage section of the applicant after its reservation, and the space there. All zones end `clear` ahead
/// [m]; the space ends at `limit` ahead [m].
fn note_storage(scene: &Scene, applicant: &Applicant, [clear, limit]: [f64; 2], out: &mut Survey) {
    let from = applicant.from;
    let beyond = chain_at(scene, from, clear);
    (out.section, out.section_start) =
        (StorageSection::at(&scene.network.junctions, beyond.chain, clear - beyond.start), beyond.start);
    // A vehicle whose trip ends before the next place stands behind others that stop there.
    let place = next_place(scene, beyond, clear, from.class) - ROOM_AT_A_STOP;
    let limit = if place - clear >= out.needed { limit.min(place) } else { limit };
    out.most = (limit - clear).max(out.needed);
    let arrival = applicant.time_to(out.extent);
    out.space = space(scene, from, Beyond { section: out.section, stop: out.stop, clear, limit, arrival });
}

/// The chain on the route with the place `distance` ahead [m].
fn chain_at(scene: &Scene, from: Viewpoint, distance: f64) -> Leg {
    let legs = scene.walk(from).take_while(|it| it.before().is_none() || it.start <= distance);
    legs.last().unwrap_or(Leg { chain: from.chain, start: -from.x, passed: PreviousLanes::NONE })
}

/// The storage sections on which the vehicle at `from` would stand after the surveyed reservation, from its rear to
/// its front.
pub(crate) fn sections(
    scene: &Scene,
    from: Viewpoint,
    survey: &Survey,
) -> impl Iterator<Item = StorageSection> {
    let Survey { section, section_start, extent, .. } = *survey;
    let walk = scene.navigator.walk(scene.network, from.destination, section.chain, section_start);
    walk.within(extent).map(move |it| it.before().map_or(section, |_| StorageSection::first_of(it.chain)))
}

/// Whether the vehicle at `spot` stands where the vehicle at `from` would stand after the surveyed reservation, or
/// farther ahead, before the next place. If it drives off, the vehicles between them move up.
pub(crate) fn stands_beyond(scene: &Scene, from: Viewpoint, survey: &Survey, spot: Spot) -> bool {
    /// Largest number of chains that are searched.
    const MOST_CHAINS: usize = 24;
    let junctions = &scene.network.junctions;
    let next = |at: &StorageSection| {
        let next = scene.next(from.destination, at.chain).filter(|_| at.is_last(junctions));
        next.map(StorageSection::first_of)
    };
    let stands_on = StorageSection::at(junctions, spot.chain, scene.motion(spot).x);
    std::iter::successors(Some(survey.section), next).take(MOST_CHAINS).any(|it| it == stands_on)
}

/// Distance to the next place on `leg` beyond `distance` where drivers may have to stop [m].
fn next_place(scene: &Scene, leg: Leg, distance: f64, class: Class) -> f64 {
    let places = scene.network.junctions.on(leg.chain).places.iter();
    let stops = places.filter(|it| concerns(it, class)).map(|it| leg.start + Point::of(it, 0.0).stop);
    stops.filter(|it| *it > distance).fold(f64::INFINITY, f64::min)
}

/// Smaller differences of distances are rounding errors [m].
pub(crate) const ROUNDING: f64 = 0.5;

/// Where the vehicle at `spot`, whose chain begins `base` ahead, leaves the route of the vehicle at `from` [m];
/// infinite if it does not leave it.
pub(crate) fn parts(scene: &Scene, from: Viewpoint, spot: Spot, base: f64) -> f64 {
    let own = scene.next(from.destination, spot.chain);
    let theirs = scene.next(scene.driver(spot).goal.destination(), spot.chain);
    match theirs {
        Some(next) if theirs != own => {
            base + scene.network.chain(spot.chain).length + scene.network.chain(next).fork_clearance
        }
        _ => f64::INFINITY,
    }
}

#[cfg(test)]
pub(crate) mod tests;
