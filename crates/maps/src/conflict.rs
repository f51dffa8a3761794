//! Which lanes get in each other's way: those that share ground, seen from above.

use laneweave_network::{LaneletIndex, Polygon};
use rayon::prelude::*;
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

/// With no more others than this a lane conflicts, so that lanes drawn on one heap do not take time with the square of
/// their number. The ramps of the largest junction do not come near.
pub(crate) const MAXIMUM_CONFLICTS: usize = 256;

/// Places of lanes, by where they lie.
type Index = RTree<GeomWithData<Rectangle<[f64; 2]>, u32>>;

/// For each lane those whose ground it shares, in order, given what each covers.
///
/// Lanes that `are_joined`, beside each other or one behind the other, do not conflict. Heights do not count.
pub(crate) fn conflicts(
    outlines: &[Option<Polygon>],
    are_joined: impl Fn(usize, usize) -> bool + Sync,
) -> Vec<Vec<LaneletIndex>> {
    let boxes = outlines.iter().enumerate().filter_map(|(index, outline)| {
        let [low, high] = outline.as_ref()?.bounds();
        Some(GeomWithData::new(Rectangle::from_corners(low, high), index as u32))
    });
    let index: Index = RTree::bulk_load(boxes.collect());
    // Each pair is looked at once, from the lane that comes first.
    let later: Vec<Vec<LaneletIndex>> = (0..outlines.len())
        .into_par_iter()
        .map(|here| {
            let Some(outline) = &outlines[here] else { return Vec::new() };
            let [low, high] = outline.bounds();
            let around = index.locate_in_envelope_intersecting(AABB::from_corners(low, high));
            let around = around.map(|it| it.data as usize).filter(|it| *it > here).take(MAXIMUM_CONFLICTS);
            let shares_ground = |there: &usize| {
                let other = outlines[*there].as_ref();
                !are_joined(here, *there) && other.is_some_and(|other| outline.overlaps(other))
            };
            around.filter(shares_ground).map(|it| LaneletIndex(it as u32)).collect()
        })
        .collect();
    let mut found = vec![Vec::new(); outlines.len()];
    for (here, theirs) in later.into_iter().enumerate() {
        theirs.iter().for_each(|it| found[it.at()].push(LaneletIndex(here as u32)));
        found[here].extend(theirs);
    }
    found.iter_mut().for_each(|it| it.sort_unstable());
    found
}
