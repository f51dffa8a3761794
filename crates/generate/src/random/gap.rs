//! Roads that end where others begin, without a connection; and streets that turn back.

use std::f64::consts::PI;

use laneweave_maps::drawing::{Crossing, Edge, Surroundings};
use laneweave_network::Pose;

use super::element::Built;
use super::hazard::Hazard;
use super::mouth::{Mouth, two_way_offsets};
use super::queue::elsewhere;
use super::stretch::{Ease, Pen, Stretch};
use crate::path::Path;

/// Length of the road before and after [m].
const AROUND: [f64; 2] = [30.0, 80.0];
/// The new road begins so far beside the old one, in widths of a lane, and so far ahead [m].
const BESIDE: [f64; 2] = [0.4, 0.8];
const AHEAD: [f64; 2] = [-2.0, 2.0];
/// Distance between the directions of a street that turns back [m], and the length over which they part [m].
const MEDIAN: [f64; 2] = [1.0, 5.0];
const PARTING: [f64; 2] = [15.0, 30.0];
/// Number of straight pieces of the borders of the turn.
const PIECES: usize = 12;

/// A road ends, and another one begins at the same place, a little to the side: nobody can drive from one to the other.
pub(super) fn gap(pen: &mut Pen, mouth: &Mouth) -> Option<Built> {
    if mouth.is_two_way() || !mouth.is_ahead() {
        return None;
    }
    let end = pen.straight(mouth, AROUND);
    let left = pen.dice.sign() * pen.dice.between(BESIDE[0], BESIDE[1]) * end.lane_width();
    let ahead = pen.dice.between(AHEAD[0], AHEAD[1]);
    let begin = elsewhere(pen, &end, [left, ahead]);
    Some(Built { mouths: vec![pen.straight(&begin, AROUND)], hazard: Some(Hazard::Gap) })
}

/// A street of both directions ends with a lane that turns back.
pub(super) fn turn_back(pen: &mut Pen, mouth: &Mouth) -> Option<Built> {
    if !mouth.is_two_way() || mouth.spans[0].ahead {
        return None;
    }
    let road = pen.straight(&mouth.clone().at_most(30.0), AROUND);
    let median = pen.dice.between(MEDIAN[0], MEDIAN[1]);
    let path = Path::straight(road.pose, pen.dice.between(PARTING[0], PARTING[1]));
    let offsets = two_way_offsets(road.lane_width(), -median);
    let parted = Mouth { knots: (0..2).flat_map(|it| road.of(it)).collect(), ..road.clone() };
    let spans = vec![
        super::mouth::Span { left: 0, right: 1, ahead: false },
        super::mouth::Span { left: 2, right: 3, ahead: true },
    ];
    let end = pen.draw(&Stretch::onward(&Mouth { spans, ..parted }, path).to(&offsets, Ease::Smooth));
    let (arrives, leaves) = (end.lane_end(true)?, end.lane_end(false)?);
    let inner = half_circle(pen, end.pose, median / 2.0, [arrives.left, leaves.left]);
    let outer = half_circle(pen, end.pose, median / 2.0 + road.lane_width(), [arrives.right, leaves.right]);
    let edges = [inner, outer].map(|border| Edge { border, reversed: false });
    pen.canvas.lane(edges, Surroundings::Country, 30.0);
    Some(Built { mouths: Vec::new(), hazard: Some(Hazard::TurnBack) })
}

/// A border around the end of a street, from a point on its right to one on its left.
fn half_circle(pen: &mut Pen, end: Pose, radius: f64, [from, to]: [u32; 2]) -> u32 {
    let start = super::mouth::beside(end, -radius);
    let path = Path::arc(start, radius, PI);
    let mut points = vec![from];
    let stations = (1..PIECES).map(|it| path.length() * it as f64 / PIECES as f64);
    points.extend(stations.map(|it| pen.canvas.point(path.beside(it, 0.0))));
    points.push(to);
    pen.canvas.line(points, Crossing::NEVER)
}
