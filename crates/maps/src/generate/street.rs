//! Streets: lanes along a path and against it, cut into lanelets.

use laneweave_network::{Point, Pose};

use super::canvas::Canvas;
use super::path::Path;
use crate::drawing::{Crossing, Edge, Surroundings};

/// Width of a lane in town [m]: RASt 06, from memory.
pub(super) const LANE_WIDTH: f64 = 3.25;
/// Before a junction lanes are not changed on so many metres. Ours.
pub(super) const SOLID: f64 = 30.0;
/// About how long lanelets are elsewhere [m].
const LANELET: f64 = 50.0;
/// Slopes have a point every so many metres.
const SLOPE_STEP: f64 = 10.0;
/// On so many metres to either side of its middle a bridge is level [m].
const LEVEL: f64 = 20.0;

/// What a street has across, and what holds on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Profile {
    /// Lanes against the path, on its left.
    pub(super) against: usize,
    /// Lanes along the path, on its right.
    pub(super) along: usize,
    /// Lanes along the path that lie on its left. None where there are lanes against it.
    pub(super) left_of_path: usize,
    /// Width of a lane [m].
    pub(super) lane_width: f64,
    /// Lanes are not changed on so many metres before a junction.
    pub(super) solid: f64,
    /// How high its middle lies above its ends [m].
    pub(super) rise: f64,
    pub(super) surroundings: Surroundings,
    pub(super) limit_kmh: f64,
}

impl Profile {
    /// A level street in town.
    pub(super) fn street(against: usize, along: usize, limit_kmh: f64) -> Profile {
        Profile {
            against,
            along,
            left_of_path: 0,
            lane_width: LANE_WIDTH,
            solid: SOLID,
            rise: 0.0,
            surroundings: Surroundings::Town,
            limit_kmh,
        }
    }

    /// How many lines it has, edges among them.
    fn lines(&self) -> usize {
        self.against + self.along + 1
    }

    /// How far a line lies to the left of the path [m]; lines count from the left.
    fn offset(&self, line: usize) -> f64 {
        ((self.against + self.left_of_path) as f64 - line as f64) * self.lane_width
    }

    /// How high a street of this length lies at `station` [m]: steepest halfway up.
    fn height(&self, station: f64, length: f64) -> f64 {
        let middle = length / 2.0;
        let up = ((middle - (station - middle).abs()) / (middle - LEVEL)).clamp(0.0, 1.0);
        self.rise * up * up * (3.0 - 2.0 * up)
    }
}

/// What is at the end of a street.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum End {
    /// The end of the map.
    Open,
    /// A junction.
    Junction,
    /// Another road, through these points, from left to right along the path; further lanes begin, or end, there.
    Road(Vec<u32>),
}

/// A lane where it ends at a junction, or begins there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LaneEnd {
    pub(super) lanelet: i64,
    /// The ends of its borders.
    pub(super) left: u32,
    pub(super) right: u32,
}

/// One end of a street: its lanes, from left to right in their own direction.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Mouth {
    /// Lanes that end here.
    pub(super) arriving: Vec<LaneEnd>,
    /// Lanes that begin here.
    pub(super) leaving: Vec<LaneEnd>,
    /// All points across, from left to right along the path.
    pub(super) across: Vec<u32>,
}

/// Draws a street along `path` between two ends, and returns what it is like there.
pub(super) fn street(canvas: &mut Canvas, path: &Path, profile: &Profile, ends: [End; 2]) -> [Mouth; 2] {
    let length = path.length();
    let cuts = cuts(length, profile, &ends);
    let mut shape = path.bends();
    if profile.rise != 0.0 {
        shape.extend((1..(length / SLOPE_STEP) as usize).map(|it| it as f64 * SLOPE_STEP));
        shape.sort_by(f64::total_cmp);
    }
    let last = cuts.len() - 1;
    let mut rows: Vec<Vec<u32>> = Vec::with_capacity(cuts.len());
    for (number, station) in cuts.iter().enumerate() {
        let given: &[u32] = match (&ends, number) {
            ([End::Road(points), _], 0) => points,
            ([_, End::Road(points)], number) if number == last => points,
            _ => &[],
        };
        let mut point = |line| point(canvas, path, profile, *station, line);
        rows.push(
            (0..profile.lines()).map(|it| given.get(it).copied().unwrap_or_else(|| point(it))).collect(),
        );
    }
    let is_solid = |piece: usize| Solid {
        along: ends[1] == End::Junction && piece + 1 == last,
        against: ends[0] == End::Junction && piece == 0,
    };
    let mut mouths = [Mouth::default(), Mouth::default()];
    for piece in 0..last {
        // A point too near to the one before it would be a kink.
        let between = |it: &&f64| **it > cuts[piece] + 1.0 && **it < cuts[piece + 1] - 1.0;
        let shape: Vec<f64> = shape.iter().filter(between).copied().collect();
        let rows = [&rows[piece], &rows[piece + 1]];
        let [along, against] = lanelets(canvas, path, profile, rows, &shape, is_solid(piece));
        if piece == 0 {
            mouths[0] = Mouth { leaving: along.begin, arriving: against.end, across: rows[0].clone() };
        }
        if piece + 1 == last {
            mouths[1] = Mouth { leaving: against.begin, arriving: along.end, across: rows[1].clone() };
        }
    }
    mouths
}

/// Stations at which the lanelets of a street begin and end.
fn cuts(length: f64, profile: &Profile, ends: &[End; 2]) -> Vec<f64> {
    // A short street keeps a third for either end.
    let solid = |end: &End| if *end == End::Junction { profile.solid.min(length / 3.0) } else { 0.0 };
    let (from, to) = (solid(&ends[0]), length - solid(&ends[1]));
    let pieces = ((to - from) / LANELET).round().max(1.0);
    let mut cuts: Vec<f64> = (from > 0.0).then_some(0.0).into_iter().collect();
    cuts.extend((0..pieces as usize).map(|it| from + (to - from) * it as f64 / pieces));
    cuts.push(to);
    cuts.extend((to < length).then_some(length));
    cuts
}

fn point(canvas: &mut Canvas, path: &Path, profile: &Profile, station: f64, line: usize) -> u32 {
    let at = path.beside(station, profile.offset(line));
    canvas.point(Point { z: at.z + profile.height(station, path.length()), ..at })
}

/// In which directions lanes are not changed.
#[derive(Clone, Copy)]
struct Solid {
    along: bool,
    against: bool,
}

/// Where the lanelets of one direction begin and end.
struct Lanes {
    begin: Vec<LaneEnd>,
    end: Vec<LaneEnd>,
}

/// Draws the lanelets between two rows of points: along the path, and against it.
fn lanelets(
    canvas: &mut Canvas,
    path: &Path,
    profile: &Profile,
    rows: [&Vec<u32>; 2],
    shape: &[f64],
    solid: Solid,
) -> [Lanes; 2] {
    let borders: Vec<u32> = (0..profile.lines())
        .map(|line| {
            let mut points = vec![rows[0][line]];
            points.extend(shape.iter().map(|it| point(canvas, path, profile, *it, line)));
            points.push(rows[1][line]);
            let is_solid = if line < profile.against { solid.against } else { solid.along };
            let is_edge = [0, profile.against, profile.lines() - 1].contains(&line);
            let crossing = if is_edge || is_solid { Crossing::NEVER } else { Crossing::BOTH_WAYS };
            canvas.line(points, crossing)
        })
        .collect();
    let mut lanes = |lines: Vec<[usize; 2]>, reversed: bool| {
        let mut drawn = Lanes { begin: Vec::new(), end: Vec::new() };
        let [begin, end] = if reversed { [rows[1], rows[0]] } else { rows };
        for [left, right] in lines {
            let edges = [left, right].map(|it| Edge { border: borders[it], reversed });
            let lanelet = canvas.lane(edges, profile.surroundings, profile.limit_kmh);
            let lane_end = |row: &[u32]| LaneEnd { lanelet, left: row[left], right: row[right] };
            drawn.begin.push(lane_end(begin));
            drawn.end.push(lane_end(end));
        }
        drawn
    };
    let along = lanes((profile.against..profile.lines() - 1).map(|it| [it, it + 1]).collect(), false);
    let against = lanes((0..profile.against).rev().map(|it| [it + 1, it]).collect(), true);
    [along, against]
}

/// The pose at a place on the ground, east and north [m], in a direction [rad].
pub(super) fn pose(x: f64, y: f64, heading: f64) -> Pose {
    Pose { at: Point::new(x, y, 0.0), heading }
}
