//! The circulating lane of a roundabout, which traffic on the right drives counter-clockwise, its entries and exits.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_6, PI, TAU};

use laneweave_maps::drawing::{Crossing, Edge, Surroundings};
use laneweave_network::{Point, Pose};

use super::canvas::Canvas;
use super::control::yielding;
use super::junction::{Arm, Borders};
use super::path::Path;
use super::street::LaneEnd;

/// Radius of the middle of the circulating lane [m]: with this lane 34.5 m across; small roundabouts have 26 to 45 m
/// (FGSV, Merkblatt für die Anlage von Kreisverkehren, from memory).
const RADIUS: f64 = 15.0;
/// Width of the circulating lane [m]. Ours.
const LANE_WIDTH: f64 = 4.5;
/// Entries and exits touch the circle at this angle before and after the middle of their arm [rad]. Ours.
const TOUCH: f64 = FRAC_PI_6;
/// Speed limit on the circulating lane [km/h]. Ours.
const SPEED_LIMIT: f64 = 30.0;
/// Distance from the middle to the end of the arms [m], so that entries and exits bend with a radius of about 11 m.
pub(super) const SETBACK: f64 = 23.5;

/// The circulating lane of a roundabout.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ring {
    /// Its middle: east and north [m].
    pub(super) middle: (f64, f64),
    /// Radius of the middle of its lane [m].
    pub(super) radius: f64,
    /// Entries and exits touch it at this angle before and after the middle of their arm [rad].
    pub(super) touch: f64,
}

/// A street where it meets a roundabout.
#[derive(Clone, Debug)]
pub(super) struct RingArm {
    /// Direction of the street, seen from the middle [rad].
    pub(super) heading: f64,
    /// Lanes that end at the roundabout.
    pub(super) arriving: Vec<LaneEnd>,
    /// Lanes that begin there.
    pub(super) leaving: Vec<LaneEnd>,
}

/// Draws the usual roundabout, with arms at right angles.
pub(super) fn usual_ring(canvas: &mut Canvas, middle: (f64, f64), arms: &[Arm]) {
    let arm = |it: &Arm| RingArm {
        heading: it.towards.heading(),
        arriving: it.arriving.clone(),
        leaving: it.leaving.clone(),
    };
    let arms: Vec<RingArm> = arms.iter().map(arm).collect();
    ring(canvas, Ring { middle, radius: RADIUS, touch: TOUCH }, &arms);
}

/// Draws a roundabout with its entries and exits; its arms are given counter-clockwise. Entering vehicles give way.
pub(super) fn ring(canvas: &mut Canvas, ring: Ring, arms: &[RingArm]) {
    let Ring { middle, radius, touch } = ring;
    // Where exits leave and entries arrive, counter-clockwise.
    let angles: Vec<f64> = arms.iter().flat_map(|it| [it.heading - touch, it.heading + touch]).collect();
    let points: Vec<[u32; 2]> = angles
        .iter()
        .map(|angle| [-0.5, 0.5].map(|it| canvas.point(on_ring(middle, *angle, radius + it * LANE_WIDTH).at)))
        .collect();
    // In front of each arm, then on to the next one.
    let pieces: Vec<i64> = (0..angles.len())
        .map(|it| {
            let next = (it + 1) % angles.len();
            let turn = (angles[next] - angles[it]).rem_euclid(TAU);
            piece(canvas, ring, [points[it], points[next]], angles[it], turn)
        })
        .collect();
    let mut borders = Borders::default();
    for (number, arm) in arms.iter().enumerate() {
        let (leaving, arriving) = (2 * number, 2 * number + 1);
        let on_piece = |it: usize| LaneEnd { lanelet: pieces[it], left: points[it][0], right: points[it][1] };
        let tangent = |it: usize| angles[it] + FRAC_PI_2;
        for lane in &arm.leaving {
            let headings = [tangent(leaving), arm.heading];
            borders.connector(canvas, [on_piece(leaving), *lane], headings, SPEED_LIMIT);
        }
        for lane in &arm.arriving {
            let headings = [arm.heading + PI, tangent(arriving)];
            let way_in = borders.connector(canvas, [*lane, on_piece(arriving)], headings, SPEED_LIMIT);
            let before = pieces[(leaving + pieces.len() - 1) % pieces.len()];
            yielding(canvas, &[*lane], vec![before, pieces[leaving]], vec![lane.lanelet, way_in]);
        }
    }
}

/// Draws a piece of the circulating lane between two pairs of points, inner and outer.
fn piece(canvas: &mut Canvas, ring: Ring, [begin, end]: [[u32; 2]; 2], angle: f64, turn: f64) -> i64 {
    let edges = [(0, -0.5), (1, 0.5)].map(|(side, out)| {
        let radius = ring.radius + out * LANE_WIDTH;
        let path = Path::arc(on_ring(ring.middle, angle, radius), radius, turn);
        let mut line = vec![begin[side]];
        line.extend(path.bends().iter().map(|it| canvas.point(path.beside(*it, 0.0))));
        line.push(end[side]);
        let border = canvas.line(line, Crossing::NEVER);
        Edge { border, reversed: false }
    });
    canvas.lane(edges, Surroundings::Town, SPEED_LIMIT)
}

/// A place on the circulating lane, and the direction of travel there.
fn on_ring((x, y): (f64, f64), angle: f64, radius: f64) -> Pose {
    let at = Point::new(x + radius * libm::cos(angle), y + radius * libm::sin(angle), 0.0);
    Pose { at, heading: angle + FRAC_PI_2 }
}
