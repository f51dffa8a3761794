//! Forks: lanes that part inside of the map, and roads that begin or end at one place at its edge.

use super::branch::{Course, Joint};
use super::element::Built;
use super::hazard::Hazard;
use super::mouth::Mouth;
use super::stretch::{Ease, Pen, Stretch};
use crate::path::Path;

/// Length with lane changes before lanes part [m], and lengths without before and after [m].
const WINDOW: [f64; 2] = [12.0, 60.0];
const TINY: [f64; 2] = [2.0, 12.0];
const BEFORE: [f64; 2] = [50.0, 150.0];
const AFTER: [f64; 2] = [10.0, 50.0];
/// Angle by which roads turn away from each other [rad].
const TURN: [f64; 2] = [0.3, 0.7];
/// Length over which lanes come together at the edge of the map [m].
const TOGETHER: [f64; 2] = [30.0, 80.0];

/// Lanes with a short stretch for lane changes, which then part.
pub(super) fn short_window(pen: &mut Pen, mouth: &Mouth) -> Option<Built> {
    parting(pen, mouth, WINDOW, Hazard::ShortWindow)
}

/// The same with a stretch on which hardly anybody can change lanes in time.
pub(super) fn tiny_window(pen: &mut Pen, mouth: &Mouth) -> Option<Built> {
    parting(pen, mouth, TINY, Hazard::TinyWindow)
}

fn parting(pen: &mut Pen, mouth: &Mouth, window: [f64; 2], hazard: Hazard) -> Option<Built> {
    if mouth.is_two_way() || mouth.lanes() < 2 || !mouth.is_ahead() {
        return None;
    }
    let before = solid(pen, mouth, BEFORE);
    let window = pen.straight(&before, window);
    let end = solid(pen, &window, AFTER);
    let at = pen.dice.count(1, end.lanes() - 1);
    let left = away(pen, &end.only(0..at), 1.0);
    let right = away(pen, &end.only(at..end.lanes()), -1.0);
    Some(Built { mouths: vec![left, right], hazard: Some(hazard) })
}

fn solid(pen: &mut Pen, mouth: &Mouth, [from, to]: [f64; 2]) -> Mouth {
    let length = pen.dice.between(from, to);
    pen.draw(&Stretch::onward(mouth, Path::straight(mouth.pose, length)).solid())
}

/// A road that turns away to the left, or to the right where `side` is negative.
fn away(pen: &mut Pen, lanes: &Mouth, side: f64) -> Mouth {
    let angle = side * pen.dice.between(TURN[0], TURN[1]);
    let legs = [pen.dice.between(15.0, 30.0), pen.dice.between(30.0, 60.0)];
    pen.side_road(&lanes.clone().at_most(70.0), Course { joint: Joint::Parts, angle, legs })
}

/// Two or three roads of one lane that begin at one place at the edge of the map; in the opposite direction they end
/// there.
pub(super) fn from_edge(pen: &mut Pen, edge: &Mouth) -> Option<Built> {
    let lane = edge.only(0..1);
    let mut mouths = vec![away(pen, &lane, 1.0), away(pen, &lane, -1.0)];
    if pen.dice.chance(0.4) {
        mouths.push(pen.straight(&lane, [50.0, 100.0]));
    }
    let hazard = if edge.is_ahead() { Hazard::EdgeFork } else { Hazard::EdgeMerge };
    Some(Built { mouths, hazard: Some(hazard) })
}

/// Lanes that all end at one place at the edge of the map; in the opposite direction they begin there.
pub(super) fn to_edge(pen: &mut Pen, mouth: &Mouth) -> Option<Built> {
    if mouth.is_two_way() || mouth.lanes() < 2 {
        return None;
    }
    let length = pen.dice.between(TOGETHER[0], TOGETHER[1]);
    let half = mouth.lane_width() / 2.0;
    let mut apart = mouth.clone();
    apart.knots = (0..mouth.lanes()).flat_map(|it| mouth.of(it)).collect();
    for (lane, span) in apart.spans.iter_mut().enumerate() {
        (span.left, span.right) = (2 * lane, 2 * lane + 1);
    }
    let offsets = [half, -half].repeat(mouth.lanes());
    let stretch = Stretch::onward(&apart, Path::straight(apart.pose, length));
    pen.draw(&stretch.to(&offsets, Ease::Smooth));
    let hazard = if mouth.is_ahead() { Hazard::EdgeMerge } else { Hazard::EdgeFork };
    Some(Built { mouths: Vec::new(), hazard: Some(hazard) })
}

/// A street of both directions that becomes two roads of one direction.
pub(super) fn divided(pen: &mut Pen, mouth: &Mouth) -> Option<Built> {
    let mouths = [(0, 1.0), (1, -1.0)].map(|(lane, side)| away(pen, &mouth.only(lane..lane + 1), side));
    Some(Built { mouths: mouths.to_vec(), hazard: None })
}
