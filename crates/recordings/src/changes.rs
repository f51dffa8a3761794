//! Lane changes: a vehicle's centre crosses the line between two lanes of one direction, and stays beyond it for at
//! least 0.8 s. Each change is counted once, at the crossing.

use laneweave_network::{Lanelet, LaneletIndex, Point, Side};

use crate::lanes;
use crate::matching::{Matched, Place};
use crate::moves::{Aside, Move};
pub use crate::purpose::RecordedChangeKind;
use crate::purpose::Ways;
use crate::recording::Track;
use crate::smooth;

/// Minimum time beyond the line for a lane change [s].
const STAY: f64 = 0.8;
/// To find the crossing, positions are smoothed over this time before and after [s].
const REACH: f64 = 0.25;
/// The crossing is searched within this time before and after the match's change of lanelets [s].
const SEARCH: f64 = 0.6;
/// A vehicle that is back within this time has come back [s].
const RETURN: f64 = 30.0;

/// An observed lane change.
#[derive(Clone, Debug, PartialEq)]
pub struct LaneChange {
    /// Id of the track.
    pub vehicle: i64,
    /// Index of the track in the recording.
    pub track: usize,
    /// When the centre crosses the line [s].
    pub time: f64,
    /// The lanelet that it leaves.
    pub from: LaneletIndex,
    /// The lanelet that it enters.
    pub to: LaneletIndex,
    /// The side.
    pub side: Side,
    /// Where the centre crosses the line [m].
    pub x: f64,
    /// Where the centre crosses the line [m].
    pub y: f64,
    /// Speed at the crossing [m/s].
    pub speed: f64,
    /// Whether the graph permits the change.
    pub along_graph: bool,
    /// Why it was made, as far as the later path shows.
    pub kind: RecordedChangeKind,
    /// Time after which it came back to the lane that it left, if within 30 s [s].
    pub returned_after: Option<f64>,
    /// Time for which the vehicle was observed after the crossing [s].
    pub seen_after: f64,
}

/// All lane changes of the vehicles of a recording, in order of tracks, then of time.
pub fn lane_changes(matched: &Matched<'_>) -> Vec<LaneChange> {
    let ways = Ways::new(matched.network.lanelets.len(), &matched.moves);
    let tracks = matched.recording.tracks.iter().zip(&matched.places).enumerate();
    tracks.flat_map(|(index, (track, places))| changes_of(matched, &ways, index, track, places)).collect()
}

/// The line between two lanes is crossed.
#[derive(Clone, Copy)]
struct Crossing {
    time: f64,
    x: f64,
    y: f64,
    speed: f64,
    from: LaneletIndex,
    to: LaneletIndex,
    aside: Aside,
    /// The lanelet in which the vehicle is last observed before it leaves the lanes of the map.
    last: LaneletIndex,
    /// The time of that [s].
    seen_until: f64,
}

fn changes_of(
    matched: &Matched<'_>,
    ways: &Ways<'_>,
    index: usize,
    track: &Track,
    places: &[Option<Place>],
) -> Vec<LaneChange> {
    let crossings = those_that_stay(crossings(matched, track, places));
    let mut changes: Vec<LaneChange> = Vec::with_capacity(crossings.len());
    for (number, crossing) in crossings.iter().enumerate() {
        let next = crossings.get(number + 1).filter(|it| it.aside.side != crossing.aside.side);
        let returned_after = next.map(|it| it.time - crossing.time).filter(|it| *it <= RETURN);
        changes.push(LaneChange {
            vehicle: track.id,
            track: index,
            time: crossing.time,
            from: crossing.from,
            to: crossing.to,
            side: crossing.aside.side,
            x: crossing.x,
            y: crossing.y,
            speed: crossing.speed,
            along_graph: crossing.aside.along_graph,
            kind: ways.kind(crossing.from, crossing.to, crossing.last),
            returned_after,
            seen_after: crossing.seen_until - crossing.time,
        });
    }
    changes
}

/// Removes crossings after which the vehicle does not stay, and the crossings back.
fn those_that_stay(crossings: Vec<Crossing>) -> Vec<Crossing> {
    let mut kept: Vec<Crossing> = Vec::with_capacity(crossings.len());
    for crossing in crossings {
        match kept.last() {
            Some(last) if crossing.time - last.time < STAY => {
                let came_back = last.aside.side != crossing.aside.side;
                kept.pop();
                kept.extend((!came_back).then_some(crossing));
            }
            _ => kept.push(crossing),
        }
    }
    kept.retain(|it| it.seen_until - it.time >= STAY);
    kept
}

/// All crossings of lines in order of time.
fn crossings(matched: &Matched<'_>, track: &Track, places: &[Option<Place>]) -> Vec<Crossing> {
    let step = matched.recording.step;
    let ends = ends(places);
    let mut crossings = Vec::new();
    for (at, pair) in places.windows(2).enumerate() {
        let [Some(before), Some(after)] = pair else { continue };
        if before.lanelet == after.lanelet {
            continue;
        }
        let found = matched.moves.get(before.lanelet, before.station, after.lanelet);
        let Some(Move::Aside(aside)) = found else { continue };
        let end = ends[at + 1];
        let last = places[end].unwrap_or(*after);
        let lanelets = [before, after].map(|it| &matched.network.lanelets[it.lanelet.at()]);
        let (frame, x, y) = moment(track, at, lanelets, step);
        crossings.push(Crossing {
            time: frame * step,
            x,
            y,
            speed: 0.5 * (track.states[at].speed + track.states[at + 1].speed),
            from: before.lanelet,
            to: after.lanelet,
            aside,
            last: last.lanelet,
            seen_until: track.states[end].frame as f64 * step,
        });
    }
    crossings
}

/// For each state the last one up to which all states have a place.
fn ends(places: &[Option<Place>]) -> Vec<usize> {
    let mut ends: Vec<usize> = (0..places.len()).collect();
    for at in (1..places.len()).rev() {
        if places[at].is_some() {
            ends[at - 1] = ends[at];
        }
    }
    ends
}

/// The frame, with a fraction, and the point [m] at which the smoothed centre crosses the line between two lanelets,
/// near the states `at` and `at + 1`, between which the match changes from one to the other.
fn moment(track: &Track, at: usize, [from, to]: [&Lanelet; 2], step: f64) -> (f64, f64, f64) {
    let states = &track.states;
    let is_near = |it: &usize| smooth::elapsed(&states[at], &states[*it], step).abs() <= SEARCH;
    let first = (0..at).rev().take_while(is_near).last().unwrap_or(at);
    let last = (at + 1..states.len()).take_while(is_near).last().unwrap_or(at + 1);
    let points: Vec<(f64, Point, f64)> = (first..=last)
        .map(|it| {
            let motion = smooth::motion(states, it, REACH, step);
            let point = Point::new(motion.x, motion.y, 0.0);
            (states[it].frame as f64, point, lead(from, to, &point))
        })
        .collect();
    let crossed = (0..points.len() - 1).filter(|it| points[*it].2 < 0.0 && points[*it + 1].2 >= 0.0);
    let nearest = crossed.min_by_key(|it| (first + it).abs_diff(at));
    let (segment, fraction) = nearest.map_or((at - first, 0.5), |it| {
        let (before, after) = (points[it].2, points[it + 1].2);
        (it, before / (before - after))
    });
    let ((frame, from, _), (next, to, _)) = (&points[segment], &points[segment + 1]);
    let point = from.towards(to, fraction);
    (frame + fraction * (next - frame), point.x, point.y)
}

/// How much further `point` is inside of `to` than of `from` [m]: zero on the line between them.
fn lead(from: &Lanelet, to: &Lanelet, point: &Point) -> f64 {
    let outside = |lanelet: &Lanelet| {
        lanes::foot(lanelet, point)
            .map_or(f64::INFINITY, |it| it.offset.abs() - 0.5 * lanelet.width(it.station))
    };
    outside(from) - outside(to)
}
