//! Ramps: a lane joins the road at an angle, runs beside it and narrows to nothing; or the reverse.

use super::branch::{Course, Joint};
use super::element::Built;
use super::hazard::Hazard;
use super::mouth::{Mouth, Span, knot};
use super::stretch::{Pen, Stretch};

/// Length over which the lane narrows to nothing, or opens [m].
const TAPER: [f64; 2] = [40.0, 200.0];
/// Length of the lane beside the road at its full width [m]; often zero.
const BESIDE: [f64; 2] = [10.0, 100.0];
/// Length of the road beside the ramp, and beyond [m].
const ALONG: [f64; 2] = [60.0, 90.0];
const BEYOND: [f64; 2] = [40.0, 70.0];
/// Angle of ramps [rad].
const TURN: [f64; 2] = [0.25, 0.7];

/// A lane comes beside the road, and narrows to nothing.
pub(super) fn closing(pen: &mut Pen, mouth: &Mouth) -> Option<Built> {
    let on_left = side(pen, mouth)?;
    let road = pen.straight(mouth, ALONG);
    let wide = widened(pen, &road, on_left);
    let ramp = lane(&wide, on_left);
    let course = course(pen, Joint::Comes, on_left);
    let outer = pen.side_road(&ramp.at_most(70.0), course);
    let wide = if pen.dice.chance(0.5) { pen.straight(&wide, BESIDE) } else { wide };
    let offsets = merged(&wide, on_left);
    let stretch = taper(pen, &wide);
    let ease = pen.taper();
    let narrow = pen.draw(&stretch.to(&offsets, ease));
    let hazard = if mouth.is_ahead() { Hazard::OnRamp } else { Hazard::OffRamp };
    Some(Built { mouths: vec![pen.straight(&narrow, BEYOND), outer], hazard: Some(hazard) })
}

/// A lane opens beside the road, and leads away.
pub(super) fn opening(pen: &mut Pen, mouth: &Mouth) -> Option<Built> {
    let on_left = side(pen, mouth)?;
    let road = pen.straight(mouth, BEYOND);
    let (wide, offsets) = unopened(&road, on_left);
    let stretch = taper(pen, &wide);
    let ease = pen.taper();
    let wide = pen.draw(&stretch.to(&offsets, ease));
    let wide = if pen.dice.chance(0.5) { pen.straight(&wide, BESIDE) } else { wide };
    let course = course(pen, Joint::Parts, on_left);
    let outer = pen.side_road(&lane(&wide, on_left).at_most(70.0), course);
    let lanes = wide.lanes();
    let rest = if on_left { wide.only(1..lanes) } else { wide.only(0..lanes - 1) };
    let hazard = if mouth.is_ahead() { Hazard::OffRamp } else { Hazard::OnRamp };
    Some(Built { mouths: vec![pen.straight(&rest, ALONG), outer], hazard: Some(hazard) })
}

/// The side of the ramp: mostly on the right of traffic. None at a road of both directions.
fn side(pen: &mut Pen, mouth: &Mouth) -> Option<bool> {
    let is_usual = pen.dice.chance(0.8);
    (!mouth.is_two_way()).then_some(mouth.is_ahead() != is_usual)
}

fn taper(pen: &mut Pen, wide: &Mouth) -> Stretch {
    let length = pen.dice.between(TAPER[0], TAPER[1]);
    Stretch::onward(wide, pen.gentle(wide, length))
}

fn course(pen: &mut Pen, joint: Joint, on_left: bool) -> Course {
    let angle = pen.dice.between(TURN[0], TURN[1]) * if on_left { 1.0 } else { -1.0 };
    Course { joint, angle, legs: [pen.dice.between(15.0, 25.0), pen.dice.between(40.0, 60.0)] }
}

/// The outermost lane on a side.
fn lane(wide: &Mouth, on_left: bool) -> Mouth {
    let last = wide.lanes() - 1;
    if on_left { wide.only(0..1) } else { wide.only(last..last + 1) }
}

fn spans(road: &Mouth) -> Vec<Span> {
    (0..=road.lanes()).map(|it| Span { left: it, right: it + 1, ahead: road.is_ahead() }).collect()
}

/// The road with a further lane as wide as the others.
fn widened(pen: &mut Pen, road: &Mouth, on_left: bool) -> Mouth {
    let mut wide = Mouth { spans: spans(road), ..road.clone() };
    let [left, right] = road.reach();
    let at = if on_left { left + road.lane_width() } else { right - road.lane_width() };
    let further = knot(&mut pen.canvas, road.pose, at);
    wide.knots.insert(if on_left { 0 } else { wide.knots.len() }, further);
    wide
}

/// The road with a further lane that has no width yet, and the offsets at which it has its full width.
fn unopened(road: &Mouth, on_left: bool) -> (Mouth, Vec<f64>) {
    let mut wide = Mouth { spans: spans(road), ..road.clone() };
    let [left, right] = road.reach();
    let (place, from) = if on_left { (0, 0) } else { (road.knots.len(), road.knots.len() - 1) };
    wide.knots.insert(place, road.knots[from]);
    let mut offsets: Vec<f64> = road.knots.iter().map(|it| it.offset).collect();
    offsets.insert(place, if on_left { left + road.lane_width() } else { right - road.lane_width() });
    (wide, offsets)
}

/// The offsets at which the outermost lane has no width.
fn merged(wide: &Mouth, on_left: bool) -> Vec<f64> {
    let mut offsets: Vec<f64> = wide.knots.iter().map(|it| it.offset).collect();
    let last = offsets.len() - 1;
    if on_left {
        offsets[0] = offsets[1];
    } else {
        offsets[last] = offsets[last - 1];
    }
    offsets
}
