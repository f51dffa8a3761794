//! Lanes that end or begin beside others: tapers, and square ends.

use super::element::Built;
use super::hazard::Hazard;
use super::mouth::{Mouth, Span, knot};
use super::stretch::{Pen, Stretch};

/// Length of tapers [m].
const TAPER: [f64; 2] = [30.0, 200.0];
/// Length of tapers right before a light, and from there to its stop line [m].
const SHORT_TAPER: [f64; 2] = [8.0, 30.0];
const STORAGE: [f64; 2] = [8.0, 20.0];
/// Angle by which such a lane turns off behind the light [rad].
const TURN: [f64; 2] = [0.5, 1.1];
/// Length with lane changes before a lane ends, and length of the unchanged road [m].
const BEFORE: [f64; 2] = [50.0, 150.0];
const AFTER: [f64; 2] = [40.0, 80.0];
/// Maximum of lanes of a road with a lane that opens.
const MOST_LANES: usize = 3;

/// A lane of several narrows to nothing.
pub(super) fn narrowing(pen: &mut Pen, mouth: &Mouth) -> Option<Built> {
    if mouth.is_two_way() || mouth.lanes() < 2 {
        return None;
    }
    let mouth = pen.straight(mouth, BEFORE);
    let length = pen.dice.between(TAPER[0], TAPER[1]);
    let stretch = Stretch::onward(&mouth, pen.gentle(&mouth, length));
    let mut offsets: Vec<f64> = mouth.knots.iter().map(|it| it.offset).collect();
    let last = offsets.len() - 1;
    if pen.dice.chance(0.4) {
        offsets[0] = offsets[1];
    } else {
        offsets[last] = offsets[last - 1];
    }
    let ease = pen.taper();
    let narrow = pen.draw(&stretch.to(&offsets, ease));
    let hazard = if mouth.is_ahead() { Hazard::Taper } else { Hazard::OpeningLane };
    Some(Built::road(pen.straight(&narrow, AFTER), hazard))
}

/// A further lane opens from nothing.
pub(super) fn opening(pen: &mut Pen, mouth: &Mouth) -> Option<Built> {
    if mouth.is_two_way() || mouth.lanes() >= MOST_LANES {
        return None;
    }
    let mouth = pen.straight(mouth, AFTER);
    let length = pen.dice.between(TAPER[0], TAPER[1]);
    let (wide, _) = opened(pen, &mouth, length);
    let hazard = if mouth.is_ahead() { Hazard::OpeningLane } else { Hazard::Taper };
    Some(Built::road(pen.straight(&wide, BEFORE), hazard))
}

/// A further lane opens over a few metres, right before a light; beyond, it turns off.
pub(super) fn opening_at_light(pen: &mut Pen, mouth: &Mouth) -> Option<Built> {
    if mouth.is_two_way() || !mouth.is_ahead() || mouth.lanes() >= MOST_LANES {
        return None;
    }
    let mouth = pen.straight(&mouth.clone().at_most(50.0), AFTER);
    let length = pen.dice.between(SHORT_TAPER[0], SHORT_TAPER[1]);
    let (wide, side) = opened(pen, &mouth, length);
    let line = pen.straight(&wide, STORAGE);
    let [beyond, _] = pen.light_behind(&line);
    let off = pen.turning_off(&beyond, side, TURN, 20.0);
    let lanes = beyond.lanes();
    let rest = beyond.only(if side > 0.0 { 1..lanes } else { 0..lanes - 1 });
    Some(Built { mouths: vec![pen.straight(&rest, AFTER), off], hazard: Some(Hazard::OpeningAtLight) })
}

/// Draws a further lane that opens over this length [m] on the left, or on the right; returns also its side, which is
/// negative on the right.
fn opened(pen: &mut Pen, mouth: &Mouth, length: f64) -> (Mouth, f64) {
    let path = pen.gentle(mouth, length);
    let (lanes, width, ease) = (mouth.lanes(), mouth.lane_width(), pen.taper());
    let [left, right] = mouth.reach();
    let mut wider = mouth.clone();
    let mut offsets: Vec<f64> = mouth.knots.iter().map(|it| it.offset).collect();
    let is_left = pen.dice.chance(0.4);
    if is_left {
        wider.knots.insert(0, mouth.knots[0]);
        offsets.insert(0, left + width);
    } else {
        wider.knots.push(mouth.knots[lanes]);
        offsets.push(right - width);
    }
    wider.spans = (0..=lanes).map(|it| Span { left: it, right: it + 1, ahead: mouth.is_ahead() }).collect();
    let wide = pen.draw(&Stretch::onward(&wider, path).to(&offsets, ease));
    (wide, if is_left { 1.0 } else { -1.0 })
}

/// A lane of several has a square end; in the opposite direction, it begins with one.
pub(super) fn blunt(pen: &mut Pen, mouth: &Mouth) -> Option<Built> {
    if mouth.is_two_way() {
        return None;
    }
    let on_left = pen.dice.chance(0.4);
    let lanes = mouth.lanes();
    if mouth.is_ahead() {
        if lanes < 2 {
            return None;
        }
        let mouth = pen.straight(mouth, BEFORE);
        let rest = if on_left { mouth.only(1..lanes) } else { mouth.only(0..lanes - 1) };
        return Some(Built::road(pen.straight(&rest, AFTER), Hazard::BluntLaneDrop));
    }
    if lanes >= MOST_LANES {
        return None;
    }
    let mut wider = pen.straight(mouth, AFTER);
    let width = wider.lane_width();
    let [left, right] = wider.reach();
    if on_left {
        let further = knot(&mut pen.canvas, wider.pose, left + width);
        wider.knots.insert(0, further);
    } else {
        let further = knot(&mut pen.canvas, wider.pose, right - width);
        wider.knots.push(further);
    }
    wider.spans = (0..=lanes).map(|it| Span { left: it, right: it + 1, ahead: false }).collect();
    Some(Built::road(pen.straight(&wider, BEFORE), Hazard::BluntLaneDrop))
}
