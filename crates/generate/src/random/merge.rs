//! Roads that join a lane, or leave it, without a lane of their own.

use super::branch::{Course, Joint};
use super::element::Built;
use super::hazard::Hazard;
use super::mouth::Mouth;
use super::stretch::Pen;

/// Length of the road on the side of the joint where the other road lies, and on the opposite side [m].
const ALONG: [f64; 2] = [60.0, 90.0];
const BEYOND: [f64; 2] = [20.0, 60.0];
/// Angle of the other road [rad].
const TURN: [f64; 2] = [0.25, 1.0];

/// A road of one lane joins the outermost lane, or leaves it, on either side.
pub(super) fn merge(pen: &mut Pen, mouth: &Mouth) -> Option<Built> {
    if mouth.is_two_way() {
        return None;
    }
    let joint = pen.dice.pick(&[Joint::Comes, Joint::Parts]);
    let before = if joint == Joint::Comes { ALONG } else { BEYOND };
    let at = pen.straight(mouth, before);
    let side = pen.dice.sign();
    let lane = if side > 0.0 { 0 } else { at.lanes() - 1 };
    let angle = side * pen.dice.between(TURN[0], TURN[1]);
    let legs = [pen.dice.between(15.0, 30.0), pen.dice.between(40.0, 60.0)];
    let other = pen.side_road(&at.only(lane..lane + 1), Course { joint, angle, legs });
    let road = pen.straight(&at, if joint == Joint::Comes { BEYOND } else { ALONG });
    let comes = mouth.is_ahead() == (joint == Joint::Comes);
    let hazard = Some(if comes { Hazard::Merge } else { Hazard::Fork });
    Some(Built { mouths: vec![road, other], hazard })
}
