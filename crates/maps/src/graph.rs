//! Which lanes follow each other, and which lie side by side.

use laneweave_network::{Lanelet, LaneletIndex};

use crate::drawing::{Drawing, Edge, Lane};

/// Fills in what lies around `lanelets`, which are those of `lanes` in the same order.
///
/// A lane follows another if it begins at the two points at which the other one ends. Lanes are neighbours if
/// they share a border and run along it in the same direction; of several neighbours on one side the first is
/// taken.
pub(crate) fn connect(drawing: &Drawing, lanes: &[Lane], lanelets: &mut [Lanelet]) {
    let starts = sorted(lanes, |lane| {
        let ((left, _), (right, _)) = (drawing.ends(lane.left), drawing.ends(lane.right));
        (left, right)
    });
    let left_edges = sorted(lanes, |lane| lane.left);
    let right_edges = sorted(lanes, |lane| lane.right);
    for (index, lane) in lanes.iter().enumerate() {
        let ((_, left_end), (_, right_end)) = (drawing.ends(lane.left), drawing.ends(lane.right));
        let here = LaneletIndex(index as u32);
        let beside = |edges: &[(Edge, LaneletIndex)], edge| with(edges, edge).find(|it| *it != here);
        let (left, right) = (beside(&right_edges, lane.left), beside(&left_edges, lane.right));
        let to_left = drawing.crossing(lane.left).to_left;
        let to_right = drawing.crossing(lane.right).to_right;
        let lanelet = &mut lanelets[index];
        lanelet.following = with(&starts, (left_end, right_end)).collect();
        (lanelet.left, lanelet.adjacent_left) = if to_left { (left, None) } else { (None, left) };
        (lanelet.right, lanelet.adjacent_right) = if to_right { (right, None) } else { (None, right) };
    }
}

/// Lanes by `key`, and in their own order where that is equal.
fn sorted<K: Ord>(lanes: &[Lane], key: impl Fn(&Lane) -> K) -> Vec<(K, LaneletIndex)> {
    let mut all: Vec<_> =
        lanes.iter().enumerate().map(|(index, lane)| (key(lane), LaneletIndex(index as u32))).collect();
    all.sort_unstable();
    all
}

/// The lanes with `key`.
fn with<K: Ord>(lanes: &[(K, LaneletIndex)], key: K) -> impl Iterator<Item = LaneletIndex> {
    let from = lanes.partition_point(|(it, _)| *it < key);
    lanes[from..].iter().take_while(move |(it, _)| *it == key).map(|(_, index)| *index)
}
