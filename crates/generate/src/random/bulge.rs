//! Branches that bulge out and come back beside the lane that they have left.

use super::element::Built;
use super::hazard::Hazard;
use super::mouth::Mouth;
use super::stretch::{Ease, Pen, Stretch};
use crate::path::Path;

/// Length of the road before the fork [m].
const BEFORE: [f64; 2] = [40.0, 90.0];
/// Lengths over which the branch goes out and comes back, and over which it then stays beside the lane [m].
const OUT: [f64; 2] = [5.0, 12.0];
const BACK: [f64; 2] = [6.0, 20.0];
const BESIDE: [f64; 2] = [15.0, 40.0];
/// Its width there [m], and the space between the two lanes where it is out, and where it is back [m].
const WIDTH: [f64; 2] = [2.3, 2.9];
const SPACE_OUT: [f64; 2] = [0.1, 0.8];
const SPACE_BACK: [f64; 2] = [-0.4, 0.2];
/// Angle by which it turns away in the end [rad].
const TURN: [f64; 2] = [0.3, 0.7];

/// A narrow branch on one side of a lane, with a light for the lane.
pub(super) fn bulge(pen: &mut Pen, mouth: &Mouth) -> Option<Built> {
    if mouth.is_two_way() || !mouth.is_ahead() {
        return None;
    }
    let road = pen.straight(&mouth.clone().at_most(50.0), BEFORE);
    let side = pen.dice.sign();
    let lane = if side > 0.0 { 0 } else { road.lanes() - 1 };
    let branch = road.only(lane..lane + 1);
    let half = branch.lane_width() / 2.0;
    let width = pen.dice.between(WIDTH[0], WIDTH[1]);
    let mut offsets = |space: [f64; 2]| {
        let near = side * (half + pen.dice.between(space[0], space[1]));
        let far = near + side * width;
        [near.max(far), near.min(far)]
    };
    let (out, back) = (offsets(SPACE_OUT), offsets(SPACE_BACK));
    let lengths = [OUT, BACK, BESIDE].map(|it| pen.dice.between(it[0], it[1]));
    let mut drawn = branch;
    for (length, to) in lengths.into_iter().zip([out, back, back]) {
        // These offsets count from the middle of the lane, those of the branch from its own middle.
        let moved = beside(&drawn, &road.only(lane..lane + 1));
        let to = to.map(|it| it - moved);
        let path = Path::straight(drawn.pose, length);
        drawn = pen.draw(&Stretch::onward(&drawn, path).solid().to(&to, Ease::Smooth));
    }
    let off = pen.turning_off(&drawn, side, TURN, 20.0);
    let straight: f64 = lengths[..2].iter().sum();
    let line = pen.go_on(&road, Path::straight(road.pose, straight));
    let rest = pen.go_on(&line, Path::straight(line.pose, lengths[2]));
    Some(Built { mouths: vec![rest, off], hazard: Some(Hazard::Bulge) })
}

/// How far the middle of a branch lies to the left of the middle of its lane [m].
fn beside(branch: &Mouth, lane: &Mouth) -> f64 {
    let from = lane.pose;
    let (dx, dy) = (branch.pose.at.x - from.at.x, branch.pose.at.y - from.at.y);
    dy * libm::cos(from.heading) - dx * libm::sin(from.heading)
}
