//! Strips: lanelets too narrow for a car beside a lane, with borders of their own.

use super::branch::{Course, Joint};
use super::element::Built;
use super::hazard::Hazard;
use super::mouth::{Mouth, Span, knot};
use super::stretch::{Pen, Stretch};
use crate::path::Path;

/// Width of a strip [m], its length [m], and its distance from the lane [m]; negative where they overlap.
const WIDTH: [f64; 2] = [0.5, 1.4];
const LENGTH: [f64; 2] = [50.0, 300.0];
const GAP: [f64; 2] = [-0.2, 0.5];
/// Distance before the end of a strip at which a road joins the lane [m].
const BEFORE_END: [f64; 2] = [3.0, 15.0];
/// The road before and after [m].
const AROUND: [f64; 2] = [25.0, 60.0];

/// A strip on the right of the road, sometimes with a road that joins on the left shortly before its end.
pub(super) fn strip(pen: &mut Pen, mouth: &Mouth) -> Option<Built> {
    let mouth = pen.straight(mouth, AROUND);
    let length = pen.dice.between(LENGTH[0], LENGTH[1]);
    if mouth.is_two_way() || pen.dice.chance(0.4) {
        let path = pen.gentle(&mouth, length);
        narrow_lanelet(pen, &mouth, path);
        let end = pen.go_on(&mouth, path);
        return Some(Built::road(pen.straight(&end, AROUND), Hazard::Strip));
    }
    narrow_lanelet(pen, &mouth, Path::straight(mouth.pose, length));
    let rest = pen.dice.between(BEFORE_END[0], BEFORE_END[1]);
    let joint = pen.go_on(&mouth, Path::straight(mouth.pose, length - rest));
    let angle = pen.dice.between(0.35, 0.8);
    let legs = [pen.dice.between(15.0, 25.0), pen.dice.between(30.0, 50.0)];
    let course = Course { joint: Joint::Comes, angle, legs };
    let side = pen.side_road(&joint.only(0..1).at_most(50.0), course);
    let end = pen.go_on(&joint, Path::straight(joint.pose, rest));
    Some(Built { mouths: vec![pen.straight(&end, AROUND), side], hazard: Some(Hazard::Strip) })
}

/// Draws the strip itself.
fn narrow_lanelet(pen: &mut Pen, mouth: &Mouth, path: Path) {
    let left = mouth.reach()[1] - pen.dice.between(GAP[0], GAP[1]);
    let right = left - pen.dice.between(WIDTH[0], WIDTH[1]);
    let knots = [left, right].map(|it| knot(&mut pen.canvas, mouth.pose, it)).to_vec();
    let ahead = mouth.spans[mouth.lanes() - 1].ahead;
    let spans = vec![Span { left: 0, right: 1, ahead }];
    let strip = Mouth { knots, spans, lanelets: Vec::new(), ..mouth.clone() };
    let length = pen.length;
    pen.draw(&Stretch::onward(&strip, path));
    // It lies along a road that counts.
    pen.length = length;
}
