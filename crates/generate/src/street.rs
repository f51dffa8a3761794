//! Streets: lanes along a path and against it, cut into lanelets.

use laneweave_maps::drawing::{Crossing, Edge, Surroundings};
use laneweave_network::{Classes, Id, Point, Pose};

use super::canvas::Canvas;
use super::path::Path;

/// Width of a lane in town [m]: RASt 06, from memory.
pub(super) const LANE_WIDTH: f64 = 3.25;
/// Length without lane changes before a junction [m]. Ours.
pub(super) const SOLID: f64 = 30.0;
/// A bus lane keeps so far from junctions, where others turn from its lane and into it [m]. Ours.
const BUS_LANE_ENDS: f64 = 60.0;
/// The shortest street between two junctions that has room for bus lanes [m].
pub(super) const SHORTEST_WITH_BUS_LANES: f64 = 200.0;
/// Approximate length of lanelets elsewhere [m].
const LANELET: f64 = 50.0;
/// Distance between points on slopes [m].
const SLOPE_STEP: f64 = 10.0;
/// Length to either side of its middle on which a bridge is level [m].
const LEVEL: f64 = 20.0;

/// The cross-section of a street, and its rules.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Profile {
    /// Lanes against the path, on its left.
    pub(super) against: usize,
    /// Lanes along the path, on its right.
    pub(super) along: usize,
    /// Lanes along the path that lie on its left. None if there are lanes against it.
    pub(super) left_of_path: usize,
    /// Width of a lane [m].
    pub(super) lane_width: f64,
    /// Length without lane changes before a junction [m].
    pub(super) solid: f64,
    /// Whether the slow one of several lanes is for buses, but not near junctions.
    pub(super) has_bus_lanes: bool,
    /// Height of its middle above its ends [m].
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
            has_bus_lanes: false,
            rise: 0.0,
            surroundings: Surroundings::Town,
            limit_kmh,
        }
    }

    /// Number of its lines, edges included.
    fn lines(&self) -> usize {
        self.against + self.along + 1
    }

    /// Offset of a line to the left of the path [m]; lines count from the left.
    fn offset(&self, line: usize) -> f64 {
        ((self.against + self.left_of_path) as f64 - line as f64) * self.lane_width
    }

    /// Where a street of this length between `ends` has bus lanes between two stations [m].
    fn bus_lanes(&self, [from, to]: [f64; 2], length: f64, ends: &[End; 2]) -> BusLanes {
        let left = |before: f64, end: &End| if *end == End::Junction { before } else { f64::INFINITY };
        let [to_first, to_last] = [left(from, &ends[0]), left(length - to, &ends[1])];
        let is_one = |lanes: usize, behind: f64, ahead: f64| {
            self.has_bus_lanes && lanes > 1 && behind.min(ahead) >= BUS_LANE_ENDS
        };
        BusLanes {
            along: is_one(self.along, to_first, to_last),
            against: is_one(self.against, to_last, to_first),
        }
    }

    /// Height of a street of this length at `station` [m]: it is steepest halfway up.
    fn height(&self, station: f64, length: f64) -> f64 {
        let middle = length / 2.0;
        let up = ((middle - (station - middle).abs()) / (middle - LEVEL)).clamp(0.0, 1.0);
        self.rise * up * up * (3.0 - 2.0 * up)
    }
}

/// The end of a street.
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
    pub(super) lanelet: Id,
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

/// Draws a street along `path` between two ends, and returns these ends.
pub(super) fn street(canvas: &mut Canvas, path: &Path, profile: &Profile, ends: [End; 2]) -> [Mouth; 2] {
    let cuts = cuts(path.length(), profile, &ends);
    let last = cuts.len() - 1;
    let mut draft = Draft { canvas, path, profile, shape: shape(path, profile) };
    let mut mouths = [Mouth::default(), Mouth::default()];
    let mut row = draft.row(0.0, &ends[0]);
    for piece in 0..last {
        let is_first = piece == 0;
        let is_last = piece + 1 == last;
        let stations = [cuts[piece], cuts[piece + 1]];
        let next = draft.row(stations[1], if is_last { &ends[1] } else { &End::Open });
        let solid = Solid {
            along: is_last && ends[1] == End::Junction,
            against: is_first && ends[0] == End::Junction,
        };
        let buses = profile.bus_lanes(stations, path.length(), &ends);
        let [begin, end] = draft.piece(stations, [&row, &next], solid, buses);
        if is_first {
            mouths[0] = begin;
        }
        if is_last {
            mouths[1] = end;
        }
        row = next;
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

/// Stations between its ends at which a street has points, for its bends and slopes.
fn shape(path: &Path, profile: &Profile) -> Vec<f64> {
    let mut stations = path.bends();
    if profile.rise != 0.0 {
        stations.extend((1..(path.length() / SLOPE_STEP) as usize).map(|it| it as f64 * SLOPE_STEP));
        stations.sort_by(f64::total_cmp);
    }
    stations
}

/// The directions in which the slow lane is for buses.
#[derive(Clone, Copy)]
struct BusLanes {
    along: bool,
    against: bool,
}

/// The directions in which lane changes are forbidden.
#[derive(Clone, Copy)]
struct Solid {
    along: bool,
    against: bool,
}

/// A street under construction.
struct Draft<'a> {
    canvas: &'a mut Canvas,
    path: &'a Path,
    profile: &'a Profile,
    shape: Vec<f64>,
}

impl Draft<'_> {
    /// The points across the street at `station`; if `end` is another road, the points of that road come first.
    fn row(&mut self, station: f64, end: &End) -> Vec<u32> {
        let given: &[u32] = if let End::Road(points) = end { points } else { &[] };
        let lines = 0..self.profile.lines();
        lines.map(|it| given.get(it).copied().unwrap_or_else(|| self.point(station, it))).collect()
    }

    fn point(&mut self, station: f64, line: usize) -> u32 {
        let at = self.path.beside(station, self.profile.offset(line));
        let height = self.profile.height(station, self.path.length());
        self.canvas.point(Point { z: at.z + height, ..at })
    }

    /// Draws the lanelets between two rows of points, and returns the end of the street there.
    fn piece(
        &mut self,
        [from, to]: [f64; 2],
        rows: [&Vec<u32>; 2],
        solid: Solid,
        buses: BusLanes,
    ) -> [Mouth; 2] {
        // A point too near to the next one would be a kink.
        const APART: f64 = 1.0;
        let between = |it: &&f64| **it > from + APART && **it < to - APART;
        let shape: Vec<f64> = self.shape.iter().filter(between).copied().collect();
        let Profile { against, surroundings, limit_kmh, .. } = *self.profile;
        let lines = self.profile.lines();
        let mut border = |line: usize| {
            let mut points = vec![rows[0][line]];
            points.extend(shape.iter().map(|it| self.point(*it, line)));
            points.push(rows[1][line]);
            let is_solid = if line < against { solid.against } else { solid.along };
            let is_edge = [0, against, lines - 1].contains(&line);
            let crossing = if is_edge || is_solid { Crossing::NEVER } else { Crossing::BOTH_WAYS };
            self.canvas.line(points, crossing)
        };
        let borders: Vec<u32> = (0..lines).map(&mut border).collect();
        let mut mouths = rows.map(|it| Mouth { across: it.clone(), ..Mouth::default() });
        let mut lane = |[left, right]: [usize; 2], reversed: bool| {
            let edges = [left, right].map(|it| Edge { border: borders[it], reversed });
            let lanelet = self.canvas.lane(edges, surroundings, limit_kmh);
            let is_slow = if reversed { right == 0 } else { right == lines - 1 };
            if is_slow && (if reversed { buses.against } else { buses.along }) {
                self.canvas.keep_for(lanelet, Classes::BUS_LANE);
            }
            let [first, last] = rows.map(|row| LaneEnd { lanelet, left: row[left], right: row[right] });
            let [begin, end] = &mut mouths;
            if reversed {
                begin.arriving.push(first);
                end.leaving.push(last);
            } else {
                begin.leaving.push(first);
                end.arriving.push(last);
            }
        };
        (against..lines - 1).for_each(|it| lane([it, it + 1], false));
        (0..against).rev().for_each(|it| lane([it + 1, it], true));
        mouths
    }
}

/// The pose at a place on the ground, east and north [m], in a direction [rad].
pub(super) fn pose(x: f64, y: f64, heading: f64) -> Pose {
    Pose { at: Point::new(x, y, 0.0), heading }
}
