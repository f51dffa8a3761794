//! Which lanes conflict: those that have common area, seen from above.

use laneweave_network::{Id, LaneletIndex, Polygon};
use rayon::prelude::*;
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use crate::problem::Problem;

/// Maximum of conflicts of one lane, so that lanes drawn on top of each other do not take quadratic time. The ramps
/// of the largest junction have far fewer.
const MAXIMUM_CONFLICTS: usize = 256;
/// Maximum of other lanes that are checked for a conflict with one lane.
const MAXIMUM_CANDIDATES: usize = 8192;

/// Places of lanes, by where they lie.
type Index = RTree<GeomWithData<Rectangle<[f64; 2]>, u32>>;

/// The conflicts of lanes.
pub(crate) struct Conflicts {
    /// For each lane those with which it has common area, in order.
    pub(crate) with: Vec<Vec<LaneletIndex>>,
    /// Lanes with more others than are checked.
    pub(crate) crowded: Vec<LaneletIndex>,
}

impl Conflicts {
    /// The problems of the lanes with more others than are checked, given the element and line of each.
    pub(crate) fn problems(&self, place: impl Fn(LaneletIndex) -> (Id, Option<usize>)) -> Vec<Problem> {
        let problem = |it: &LaneletIndex| {
            let (id, line) = place(*it);
            Problem {
                element: format!("lanelet {id}"),
                line,
                what: "it overlaps so many other lanelets that not all conflicts between them are known"
                    .into(),
                remedy: "delete lanelets that were drawn twice".into(),
            }
        };
        self.crowded.iter().map(problem).collect()
    }
}

/// The conflicts of lanes, given the area of each.
///
/// Lanes that `are_joined`, beside each other or one after the other, do not conflict. Heights do not count.
pub(crate) fn conflicts(
    outlines: &[Option<Polygon>],
    are_joined: impl Fn(usize, usize) -> bool + Sync,
) -> Conflicts {
    let boxes = outlines.iter().enumerate().filter_map(|(index, outline)| {
        let [low, high] = outline.as_ref()?.bounds();
        Some(GeomWithData::new(Rectangle::from_corners(low, high), index as u32))
    });
    let index: Index = RTree::bulk_load(boxes.collect());
    // Each pair is checked once, from the lane that comes first.
    let later: Vec<(Vec<LaneletIndex>, bool)> = (0..outlines.len())
        .into_par_iter()
        .map(|here| {
            let Some(outline) = &outlines[here] else { return (Vec::new(), false) };
            let [low, high] = outline.bounds();
            let around = index.locate_in_envelope_intersecting(AABB::from_corners(low, high));
            let candidates: Vec<usize> =
                around.map(|it| it.data as usize).filter(|it| *it > here).take(MAXIMUM_CANDIDATES).collect();
            let shares_ground = |there: &&usize| {
                let other = outlines[**there].as_ref();
                !are_joined(here, **there) && other.is_some_and(|other| outline.overlaps(other))
            };
            let sharing = candidates.iter().filter(shares_ground).take(MAXIMUM_CONFLICTS);
            let sharing: Vec<LaneletIndex> = sharing.map(|it| LaneletIndex(*it as u32)).collect();
            let is_crowded = candidates.len() == MAXIMUM_CANDIDATES || sharing.len() == MAXIMUM_CONFLICTS;
            (sharing, is_crowded)
        })
        .collect();
    let mut with = vec![Vec::new(); outlines.len()];
    let mut crowded = Vec::new();
    for (here, (theirs, is_crowded)) in later.into_iter().enumerate() {
        theirs.iter().for_each(|it| with[it.at()].push(LaneletIndex(here as u32)));
        with[here].extend(theirs);
        crowded.extend(is_crowded.then_some(LaneletIndex(here as u32)));
    }
    with.iter_mut().for_each(|it| it.sort_unstable());
    Conflicts { with, crowded }
}
