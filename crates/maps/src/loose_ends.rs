//! Lanes that end, or begin, at points of other lanes and are not connected to them.

use std::collections::{HashMap, HashSet};

use laneweave_network::{Lanelet, turn};

use crate::drawing::{Drawing, Edge, Lane};
use crate::graph::Node;
use crate::problem::Problem;

/// Directions that differ by less than this continue each other [rad].
const STRAIGHT_ON: f64 = 0.5;

/// No vehicle needs less width than this [m].
const NARROW: f64 = 1.0;

/// Maximum of lanes, or borders, at one point that are compared with each lane there.
const MAXIMUM_SHARING: usize = 32;

/// An end, or a start, of a lane: its points on the left and on the right.
type Corners = (u32, u32);

/// The lanes that lead nowhere, or to which nothing leads, although they touch other lanes there. `lanelets` and
/// `nodes` belong to `lanes`.
pub(crate) fn loose_ends(
    drawing: &Drawing,
    lanes: &[Lane],
    lanelets: &[Lanelet],
    nodes: &[Node],
) -> Vec<Problem> {
    let starts: Vec<Corners> = lanes.iter().map(|it| drawing.starts(it.left, it.right)).collect();
    let ends: Vec<Corners> = lanes.iter().map(|it| drawing.finishes(it.left, it.right)).collect();
    let first_heading = |it: usize| lanelets[it].centre.heading(0.0);
    let last_heading = |it: usize| lanelets[it].centre.heading(lanelets[it].length());
    // A narrower end is that of a lane that opens or closes.
    let is_wide = |corners: Corners| {
        let [left, right] = [corners.0, corners.1].map(|it| &drawing.points[it as usize]);
        left.distance(right) > NARROW
    };
    let all = || 0..lanes.len();
    let last: Vec<usize> = all().filter(|it| nodes[*it].following.is_empty() && is_wide(ends[*it])).collect();
    let first: Vec<usize> =
        all().filter(|it| nodes[*it].previous.is_empty() && is_wide(starts[*it])).collect();
    let inner = inner_points(
        drawing,
        lanes,
        last.iter().map(|it| ends[*it]).chain(first.iter().map(|it| starts[*it])),
    );
    let (by_start, by_end) = (by_corner(&starts), by_corner(&ends));
    let goes_on = |from: usize, to: usize| turn(last_heading(from), first_heading(to)).abs() < STRAIGHT_ON;
    let problem = |lane: usize, (what, remedy): (&str, &str)| Problem {
        element: format!("lanelet {}", lanes[lane].id),
        line: lanes[lane].line,
        what: what.into(),
        remedy: remedy.into(),
    };
    let flaw = |lane: usize, own: Corners, is_half_met: bool, [half_met, inside]: [Flaw; 2]| {
        let flaw = if is_half_met { Some(half_met) } else { is_inside(&inner, own).then_some(inside) };
        flaw.map(|it| problem(lane, it))
    };
    let after = last.into_iter().filter_map(|lane| {
        let mut there = at_corner(&by_start, &starts, ends[lane]).filter(|it| *it != lane);
        flaw(lane, ends[lane], there.any(|it| goes_on(lane, it)), ENDS)
    });
    let before = first.into_iter().filter_map(|lane| {
        let mut there = at_corner(&by_end, &ends, starts[lane]).filter(|it| *it != lane);
        flaw(lane, starts[lane], there.any(|it| goes_on(it, lane)), BEGINS)
    });
    after.chain(before).collect()
}

/// What is wrong, and its remedy.
type Flaw = (&'static str, &'static str);

/// A lane ends where it meets another one half, or inside of a border.
const ENDS: [Flaw; 2] = [
    (
        "it ends at only one of the two points at which another lanelet begins, so it leads nowhere",
        BOTH_POINTS,
    ),
    ("it ends in the middle of a border of another lanelet, so it leads nowhere", SPLIT),
];
/// The same where it begins.
const BEGINS: [Flaw; 2] = [
    (
        "it begins at only one of the two points at which another lanelet ends, so nothing leads there",
        BOTH_POINTS,
    ),
    ("it begins in the middle of a border of another lanelet, so nothing leads there", SPLIT),
];
const BOTH_POINTS: &str = "let both of its borders meet those of the other one there, and where lanes join or part, draw a lanelet for each \
                           of them between both points";
const SPLIT: &str =
    "split the other lanelet there, and let one of its parts begin or end at the same two points";

/// Lanes by each of the two points of their starts, or ends.
fn by_corner(corners: &[Corners]) -> HashMap<(u32, bool), Vec<usize>> {
    let mut lanes: HashMap<(u32, bool), Vec<usize>> = HashMap::new();
    for (lane, (left, right)) in corners.iter().enumerate() {
        for key in [(*left, true), (*right, false)] {
            let there = lanes.entry(key).or_default();
            if there.len() < MAXIMUM_SHARING {
                there.push(lane);
            }
        }
    }
    lanes
}

/// The lanes of which just one corner is that on the same side of `own`.
fn at_corner<'a>(
    lanes: &'a HashMap<(u32, bool), Vec<usize>>,
    corners: &'a [Corners],
    own: Corners,
) -> impl Iterator<Item = usize> + 'a {
    let there =
        [(own.0, true), (own.1, false)].into_iter().filter_map(|it| lanes.get(&it)).flatten().copied();
    there.filter(move |it| corners[*it] != own)
}

/// For each of some points the borders of lanes that run through it, and neither begin nor end there.
fn inner_points(
    drawing: &Drawing,
    lanes: &[Lane],
    corners: impl Iterator<Item = Corners>,
) -> HashMap<u32, Vec<u32>> {
    let wanted: HashSet<u32> = corners.flat_map(|it| [it.0, it.1]).collect();
    let used: HashSet<u32> =
        lanes.iter().flat_map(|it| [it.left, it.right]).map(|it: Edge| it.border).collect();
    let mut borders: HashMap<u32, Vec<u32>> = HashMap::new();
    for border in used {
        let points = &drawing.borders[border as usize].points;
        for point in points.iter().take(points.len() - 1).skip(1).filter(|it| wanted.contains(it)) {
            let there = borders.entry(*point).or_default();
            if there.len() < MAXIMUM_SHARING {
                there.push(border);
            }
        }
    }
    borders
}

/// Whether both corners lie inside one border.
fn is_inside(inner: &HashMap<u32, Vec<u32>>, (left, right): Corners) -> bool {
    let borders = |point: u32| inner.get(&point).map_or(&[][..], Vec::as_slice);
    left != right && borders(left).iter().any(|it| borders(right).contains(it))
}
