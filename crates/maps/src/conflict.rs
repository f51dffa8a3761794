//! Which lanes get in each other's way: those that share ground, seen from above.

use laneweave_network::{LaneletIndex, Polygon};
use rayon::prelude::*;
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use crate::drawing::{Drawing, Lane};

/// With no more others than this a lane conflicts, so that lanes drawn on one heap do not take time with the square of
/// their number. The ramps of the largest junction do not come near.
const MAXIMUM_CONFLICTS: usize = 256;

/// Places of lanes, by where they lie.
type Index = RTree<GeomWithData<Rectangle<[f64; 2]>, u32>>;

/// For each lane those whose ground it shares, in order.
///
/// Lanes on either side of a border and lanes that follow on each other, in any direction, do not conflict; a two-way lane
/// conflicts with itself. Heights do not count.
pub(crate) fn conflicts(drawing: &Drawing, lanes: &[Lane]) -> Vec<Vec<LaneletIndex>> {
    let outlines: Vec<Option<Polygon>> = lanes.par_iter().map(|lane| drawing.outline(lane)).collect();
    let boxes = outlines.iter().enumerate().filter_map(|(index, outline)| {
        let [low, high] = outline.as_ref()?.bounds();
        Some(GeomWithData::new(Rectangle::from_corners(low, high), index as u32))
    });
    let index: Index = RTree::bulk_load(boxes.collect());
    // Each pair is looked at once, from the lane that comes first.
    let later: Vec<Vec<LaneletIndex>> = (0..lanes.len())
        .into_par_iter()
        .map(|here| {
            let Some(outline) = &outlines[here] else { return Vec::new() };
            let [low, high] = outline.bounds();
            let around = index.locate_in_envelope_intersecting(AABB::from_corners(low, high));
            let around = around.map(|it| it.data as usize).filter(|it| *it > here).take(MAXIMUM_CONFLICTS);
            let shares_ground = |there: &usize| {
                !are_joined(drawing, &lanes[here], &lanes[*there])
                    && outlines[*there].as_ref().is_some_and(|other| outline.overlaps(other))
            };
            around.filter(shares_ground).map(|it| LaneletIndex(it as u32)).collect()
        })
        .collect();
    let mut found = vec![Vec::new(); lanes.len()];
    for (here, theirs) in later.into_iter().enumerate() {
        theirs.iter().for_each(|it| found[it.at()].push(LaneletIndex(here as u32)));
        found[here].extend(theirs);
    }
    for (here, (conflicts, lane)) in found.iter_mut().zip(lanes).enumerate() {
        if lane.is_two_way {
            conflicts.push(LaneletIndex(here as u32));
        }
        conflicts.sort_unstable();
    }
    found
}

/// Whether two lanes lie on either side of a border, or one begins or ends where the other does in some direction of travel.
fn are_joined(drawing: &Drawing, a: &Lane, b: &Lane) -> bool {
    let is_beside = a.left == b.right || a.right == b.left;
    let is_opposite = a.left == b.left.reversed() || a.right == b.right.reversed();
    let start = |lane: &Lane| drawing.starts(lane.left, lane.right);
    let finish = |lane: &Lane| drawing.finishes(lane.left, lane.right);
    let turned = |(left, right): (u32, u32)| (right, left);
    is_beside
        || is_opposite
        || finish(a) == start(b)
        || finish(b) == start(a)
        || finish(a) == turned(finish(b))
        || start(a) == turned(start(b))
}
