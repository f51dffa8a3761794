//! Entrances and exits close behind each other, whose lanes fork, join and cross over a few metres.

use std::f64::consts::PI;

use super::element::Built;
use super::hazard::Hazard;
use super::mouth::{Mouth, onward};
use super::stretch::Pen;
use crate::junction::Borders;

/// Length of the road before and after [m].
const AROUND: [f64; 2] = [40.0, 90.0];
/// Length between an entrance and the exit behind it [m].
const BETWEEN: [f64; 2] = [2.5, 11.0];
/// Angles of entrances and exits [rad].
const ANGLE: [f64; 2] = [0.5, 1.1];
/// From the place where an entrance begins to turn to the road: along it, and beside it [m].
const FROM: [[f64; 2]; 2] = [[18.0, 30.0], [9.0, 16.0]];
/// Length of the road that leads to an entrance [m].
const LEADS: [f64; 2] = [40.0, 80.0];

/// A road joins a lane, and another one leaves it less than a vehicle's length behind.
pub(super) fn merge_then_exit(pen: &mut Pen, mouth: &Mouth) -> Option<Built> {
    let road = before(pen, mouth, 1)?;
    let side = pen.dice.sign();
    let comes = pen.turning_in(&road, side, ANGLE);
    let between = pen.straight(&road, BETWEEN);
    let leaves = off(pen, &between, side);
    let on = pen.straight(&between, AROUND);
    Some(Built { mouths: vec![on, comes, leaves], hazard: Some(Hazard::MergeExit) })
}

/// An entrance leads to both of two lanes; right behind it the inner lane is left across the outer one.
pub(super) fn shared_entrance(pen: &mut Pen, mouth: &Mouth) -> Option<Built> {
    let road = before(pen, mouth, 2)?;
    let lanes = road.lanes();
    let between = pen.straight(&road, BETWEEN);
    let side = pen.dice.sign();
    let [along, beside] = FROM.map(|it| pen.dice.between(it[0], it[1]));
    let middle = onward(road.pose, -along, -side * PI / 2.0);
    let turn = side * pen.dice.between(0.1, 0.6);
    let start = onward(middle, beside + road.breadth() / 2.0, side * PI / 2.0 + turn);
    let length = pen.dice.between(LEADS[0], LEADS[1]);
    let edge_pose = onward(start, -length, 0.0);
    let edge = Mouth::one_way(&mut pen.canvas, edge_pose, 1, true, road.width());
    let arrives = pen.go_on(&edge, crate::path::Path::straight(edge_pose, length)).lane_end(true)?;
    let mut borders = Borders::default();
    let begins = Mouth { lanelets: (0..lanes).map(|it| between.lanelets[it]).collect(), ..road.clone() };
    for lane in if side > 0.0 { lanes - 2..lanes } else { 0..2 } {
        let leaves = begins.only(lane..lane + 1).lane_end(true)?;
        let headings = [start.heading, road.pose.heading];
        borders.connector(&mut pen.canvas, [arrives, leaves], headings, road.limit_kmh.min(50.0));
    }
    // The entrance is on the right where `side` is positive, and so is the exit.
    let inner = if side > 0.0 { lanes - 2 } else { 1 };
    let leaves = off(pen, &between.only(inner..inner + 1), -side);
    let on = pen.straight(&between, AROUND);
    Some(Built { mouths: vec![on, leaves], hazard: Some(Hazard::SharedEntrance) })
}

/// The left one of two lanes is left to the right, and the right one to the left, one behind the other.
pub(super) fn crossing_exits(pen: &mut Pen, mouth: &Mouth) -> Option<Built> {
    let road = before(pen, mouth, 2)?;
    let (first, second) = (road.only(0..1), road.lanes() - 1);
    let right = off(pen, &first, -1.0);
    let between = pen.straight(&road, BETWEEN);
    let left = off(pen, &between.only(second..second + 1), 1.0);
    let on = pen.straight(&between, AROUND);
    Some(Built { mouths: vec![on, right, left], hazard: Some(Hazard::CrossingExits) })
}

/// The road before, if it has enough lanes of one direction.
fn before(pen: &mut Pen, mouth: &Mouth, least: usize) -> Option<Mouth> {
    let is_fit = !mouth.is_two_way() && mouth.is_ahead() && mouth.lanes() >= least;
    is_fit.then(|| pen.straight(&mouth.clone().at_most(50.0), AROUND))
}

fn off(pen: &mut Pen, lanes: &Mouth, side: f64) -> Mouth {
    let leg = pen.dice.between(8.0, 20.0);
    pen.turning_off(lanes, side, ANGLE, leg)
}
