//! Junctions of streets of both directions, at any angle from 60 to 120°.

use laneweave_network::Id;
use std::f64::consts::{FRAC_PI_2, PI};

use super::element::Built;
use super::hazard::Hazard;
use super::mouth::{Mouth, onward};
use super::stretch::Pen;
use crate::canvas::Canvas;
use crate::control::{light, yielding};
use crate::junction::Borders;
use crate::street::LaneEnd;

/// The angle between streets [rad].
const ANGLE: [f64; 2] = [1.05, 2.09];
/// Radius of the outer edge of turns to the right [m].
const RADIUS: [f64; 2] = [6.0, 12.0];
/// Length of arms [m].
pub(super) const ARM: [f64; 2] = [25.0, 60.0];
/// Limit on the paths over a junction [km/h].
const LIMIT: f64 = 50.0;

/// A street where it meets a junction.
pub(super) struct Arm {
    /// Its direction, seen from the junction [rad].
    pub(super) heading: f64,
    /// The lane that ends at the junction.
    pub(super) arriving: LaneEnd,
    /// The lane that begins there.
    pub(super) leaving: LaneEnd,
}

/// A junction of three or four arms: with lights, with a street with priority, or without a rule.
pub(super) fn junction(pen: &mut Pen, mouth: &Mouth) -> Option<Built> {
    if !mouth.is_two_way() {
        return None;
    }
    let mouth = &pen.straight(mouth, ARM).at_most(LIMIT);
    let angle = pen.dice.between(ANGLE[0], ANGLE[1]);
    let half = angle.min(PI - angle) / 2.0;
    let setback = (mouth.breadth() / 2.0 + pen.dice.between(RADIUS[0], RADIUS[1])) / libm::tan(half);
    // Directions of the arms, seen along the road: straight on, to the left, to the right.
    let mut turns = vec![0.0, angle, angle - PI];
    if pen.dice.chance(0.5) {
        turns.remove(pen.dice.count(0, 2));
    }
    let mut arms = vec![own_arm(mouth)?];
    let mut mouths = Vec::new();
    for turn in &turns {
        let (arm, outer) = new_arm(pen, mouth, *turn, [setback, setback], ARM)?;
        arms.push(arm);
        mouths.push(outer);
    }
    let ways = ways(&mut pen.canvas, &arms, mouth.limit_kmh);
    let hazard = pen.dice.pick(&[Hazard::Lights, Hazard::Priority, Hazard::PlainJunction]);
    match hazard {
        Hazard::Lights => arms.iter().for_each(|it| light(&mut pen.canvas, &it.arriving)),
        Hazard::Priority => priority(&mut pen.canvas, &arms, &ways),
        _ => {}
    }
    Some(Built { mouths, hazard: Some(hazard) })
}

/// The arm on which the road arrives.
pub(super) fn own_arm(mouth: &Mouth) -> Option<Arm> {
    let (arriving, leaving) = (mouth.lane_end(true)?, mouth.lane_end(false)?);
    Some(Arm { heading: mouth.pose.heading + PI, arriving, leaving })
}

/// Draws an arm at this angle to the road, of a `length` in this range [m], and also returns its outer end. The two
/// setbacks [m] are: from the mouth to the middle of the junction, and from there to the beginning of the arm.
pub(super) fn new_arm(
    pen: &mut Pen,
    mouth: &Mouth,
    turn: f64,
    setbacks: [f64; 2],
    length: [f64; 2],
) -> Option<(Arm, Mouth)> {
    let middle = onward(mouth.pose, setbacks[0], turn);
    let pose = onward(middle, setbacks[1], 0.0);
    let inner = Mouth::two_way(&mut pen.canvas, pose, 0.0, mouth.width());
    let outer = pen.straight(&inner, length);
    let lanelets = outer.lanelets.clone();
    let inner = Mouth { lanelets, ..inner };
    let (arriving, leaving) = (inner.lane_end(false)?, inner.lane_end(true)?);
    Some((Arm { heading: pose.heading, arriving, leaving }, outer))
}

/// Draws the paths between all arms, and returns them by the arm from which they come.
fn ways(canvas: &mut Canvas, arms: &[Arm], limit_kmh: f64) -> Vec<Vec<Id>> {
    let mut borders = Borders::default();
    let mut ways = Vec::new();
    for (from, arm) in arms.iter().enumerate() {
        let others = arms.iter().enumerate().filter(|it| it.0 != from).map(|it| it.1);
        let way = |to: &Arm| {
            let headings = [arm.heading + PI, to.heading];
            borders.connector(canvas, [arm.arriving, to.leaving], headings, limit_kmh)
        };
        ways.push(others.map(way).collect());
    }
    ways
}

/// The street of the road has priority: its arm, and the opposite one if there is one.
fn priority(canvas: &mut Canvas, arms: &[Arm], ways: &[Vec<Id>]) {
    let of = |number: usize| {
        let own = std::iter::once(arms[number].arriving.lanelet);
        own.chain(ways[number].iter().copied()).collect::<Vec<Id>>()
    };
    let is_main = |it: &usize| {
        let turn = arms[*it].heading - arms[0].heading;
        libm::cos(turn).abs() > libm::cos(FRAC_PI_2 / 3.0)
    };
    let (main, others): (Vec<usize>, Vec<usize>) = (0..arms.len()).partition(is_main);
    let first: Vec<Id> = main.into_iter().flat_map(of).collect();
    for number in others {
        yielding(canvas, &[arms[number].arriving], first.clone(), of(number));
    }
}
