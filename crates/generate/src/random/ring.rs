//! Roundabouts of one lane with three or four arms.

use std::f64::consts::{PI, TAU};

use super::element::Built;
use super::hazard::Hazard;
use super::junction::{ARM, Arm, new_arm, own_arm};
use super::mouth::{Mouth, onward};
use super::stretch::Pen;
use crate::ring::{Ring, RingArm, ring};

/// Radius of the middle of the circulating lane [m].
const RADIUS: [f64; 2] = [10.0, 20.0];
/// From the circulating lane to the end of the arms [m].
const SETBACK: f64 = 8.5;
/// Entries and exits touch a small roundabout at the first angle beside the middle of their arm, and a large one at
/// the second [rad]. Ours.
const TOUCH: [f64; 2] = [0.66, 0.52];
/// Angle by which arms deviate from even directions [rad].
const ASIDE: f64 = 0.08;
/// Length of arms with hardly any room [m].
const SHORT: [f64; 2] = [6.0, 15.0];
/// The road before the roundabout [m].
const BEFORE: [f64; 2] = [25.0, 60.0];

/// A roundabout.
pub(super) fn roundabout(pen: &mut Pen, mouth: &Mouth) -> Option<Built> {
    let mouths = drawn(pen, mouth, ARM)?;
    Some(Built { mouths, hazard: Some(Hazard::Roundabout) })
}

/// A roundabout whose arms begin at the edge of the map, with room for hardly more than one vehicle each.
pub(super) fn short_arms(pen: &mut Pen, mouth: &Mouth) -> Option<Built> {
    drawn(pen, mouth, SHORT)?;
    Some(Built { mouths: Vec::new(), hazard: Some(Hazard::ShortArms) })
}

fn drawn(pen: &mut Pen, mouth: &Mouth, length: [f64; 2]) -> Option<Vec<Mouth>> {
    if !mouth.is_two_way() {
        return None;
    }
    let mouth = &pen.straight(mouth, BEFORE).at_most(50.0);
    let radius = pen.dice.between(RADIUS[0], RADIUS[1]);
    let touch = if radius < 15.0 { TOUCH[0] } else { TOUCH[1] };
    let number = pen.dice.count(3, 4);
    let setback = radius + SETBACK;
    let mut arms = vec![own_arm(mouth)?];
    let mut mouths = Vec::new();
    for arm in 1..number {
        let aside = pen.dice.between(-ASIDE, ASIDE);
        let turn = arm as f64 * TAU / number as f64 - PI + aside;
        let (arm, outer) = new_arm(pen, mouth, turn, [setback, setback], length)?;
        arms.push(arm);
        mouths.push(outer);
    }
    let middle = onward(mouth.pose, setback, 0.0).at;
    let arm =
        |it: Arm| RingArm { heading: it.heading, arriving: vec![it.arriving], leaving: vec![it.leaving] };
    let arms: Vec<RingArm> = arms.into_iter().map(arm).collect();
    ring(&mut pen.canvas, Ring { middle: (middle.x, middle.y), radius, touch, lanes: 1 }, &arms);
    Some(mouths)
}
