//! The circulating lanes of a roundabout, which traffic on the right drives counter-clockwise, its entries and exits.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_6, PI, TAU};

use laneweave_maps::drawing::{Crossing, Edge, Surroundings};
use laneweave_network::{Id, Point, Pose};

use super::canvas::Canvas;
use super::control::yielding;
use super::junction::{Arm, Borders};
use super::path::Path;
use super::street::LaneEnd;

/// Radius of the middle of the ring [m], by its lanes. With one lane it is 34.5 m across; small roundabouts have 26 to
/// 45 m (FGSV, Merkblatt für die Anlage von Kreisverkehren, from memory). With two lanes it is 55 m across, of 46 to
/// 67 m (NCHRP Report 672, from memory).
const RADIUS: [f64; 2] = [15.0, 23.0];
/// Width of a circulating lane [m]. Ours.
const LANE_WIDTH: f64 = 4.5;
/// Entries and exits touch the smallest circle of one lane at this angle before and after the middle of their arm
/// [rad]. Larger circles are touched at the same distances. Ours.
const TOUCH: f64 = FRAC_PI_6;
/// Factor of these distances with two lanes: the arms are wider. Ours.
const WIDER: [f64; 2] = [1.0, 1.3];
/// Least length between the entry of an arm and the exit of the next one, on the middle of the ring [m]. Ours.
const BETWEEN: f64 = 7.8;
/// Speed limit on the ring [km/h]. Ours.
const SPEED_LIMIT: f64 = 30.0;
/// Distance from the middle of the ring to the end of the arms, beyond the radius [m], by its lanes, so that entries
/// and exits bend with a radius of about 11 m.
const SETBACK: [f64; 2] = [8.5, 13.0];

/// The ring of a roundabout.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ring {
    /// Its middle: east and north [m].
    pub(super) middle: (f64, f64),
    /// Radius of the middle between its edges [m].
    pub(super) radius: f64,
    /// Entries and exits touch it at this angle before and after the middle of their arm [rad].
    pub(super) touch: f64,
    /// Number of lanes: 1 or 2.
    pub(super) lanes: usize,
}

impl Ring {
    /// The ring of the usual shape with this radius [m].
    pub(super) fn usual(middle: (f64, f64), radius: f64, lanes: usize) -> Ring {
        Ring { middle, radius, touch: TOUCH * WIDER[lanes - 1] * RADIUS[0] / radius, lanes }
    }

    /// The smallest radius at which this many arms fit around it [m].
    pub(super) fn usual_radius(arms: usize, lanes: usize) -> f64 {
        let in_front_of_an_arm = 2.0 * TOUCH * WIDER[lanes - 1] * RADIUS[0];
        RADIUS[lanes - 1].max(arms as f64 * (in_front_of_an_arm + BETWEEN) / TAU)
    }

    /// Distance from the middle of the ring to the end of its arms [m].
    pub(super) fn setback(&self) -> f64 {
        self.radius + SETBACK[self.lanes - 1]
    }

    /// Radius of a line along the ring [m]; lines count from the inner one.
    fn line(&self, number: usize) -> f64 {
        self.radius + (number as f64 - self.lanes as f64 / 2.0) * LANE_WIDTH
    }

    /// A place on the ring, and the direction of travel there.
    fn at(&self, angle: f64, radius: f64) -> Pose {
        let (x, y) = self.middle;
        let at = Point::new(x + radius * libm::cos(angle), y + radius * libm::sin(angle), 0.0);
        Pose { at, heading: angle + FRAC_PI_2 }
    }
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

/// The usual ring of one lane, with arms at right angles.
pub(super) fn usual_ring(middle: (f64, f64)) -> Ring {
    Ring::usual(middle, RADIUS[0], 1)
}

/// Draws a ring at which streets along the compass meet.
pub(super) fn compass_ring(canvas: &mut Canvas, wanted: Ring, arms: &[Arm]) {
    let arm = |it: &Arm| RingArm {
        heading: it.towards.heading(),
        arriving: it.arriving.clone(),
        leaving: it.leaving.clone(),
    };
    let arms: Vec<RingArm> = arms.iter().map(arm).collect();
    ring(canvas, wanted, &arms);
}

/// Draws a ring with its entries and exits; its arms are given counter-clockwise. Entering vehicles give way. Of
/// fewer lanes than the ring has, those of an arm lead from and to the outer ones.
pub(super) fn ring(canvas: &mut Canvas, ring: Ring, arms: &[RingArm]) {
    // Where exits leave and entries arrive, counter-clockwise.
    let angles: Vec<f64> =
        arms.iter().flat_map(|it| [it.heading - ring.touch, it.heading + ring.touch]).collect();
    let mut row = |angle: &f64| -> Vec<u32> {
        (0..=ring.lanes).map(|it| canvas.point(ring.at(*angle, ring.line(it)).at)).collect()
    };
    let points: Vec<Vec<u32>> = angles.iter().map(&mut row).collect();
    // In front of each arm, then on to the next one.
    let pieces: Vec<Vec<Id>> = (0..angles.len())
        .map(|it| {
            let next = (it + 1) % angles.len();
            let turn = (angles[next] - angles[it]).rem_euclid(TAU);
            let is_between_arms = it % 2 == 1;
            piece(canvas, ring, [&points[it], &points[next]], [angles[it], turn], is_between_arms)
        })
        .collect();
    let mut borders = Borders::default();
    for (number, arm) in arms.iter().enumerate() {
        let (leaving, arriving) = (2 * number, 2 * number + 1);
        let on_piece = |it: usize, lane: usize| LaneEnd {
            lanelet: pieces[it][lane],
            left: points[it][lane],
            right: points[it][lane + 1],
        };
        let tangent = |it: usize| angles[it] + FRAC_PI_2;
        let outer = |lanes: &[LaneEnd]| ring.lanes.saturating_sub(lanes.len())..ring.lanes;
        for (lane, from) in arm.leaving.iter().zip(outer(&arm.leaving)) {
            let headings = [tangent(leaving), arm.heading];
            borders.connector(canvas, [on_piece(leaving, from), *lane], headings, SPEED_LIMIT);
        }
        let mut gives_way = |(lane, onto): (&LaneEnd, usize)| {
            let headings = [arm.heading + PI, tangent(arriving)];
            [
                lane.lanelet,
                borders.connector(canvas, [*lane, on_piece(arriving, onto)], headings, SPEED_LIMIT),
            ]
        };
        let ways: Vec<[Id; 2]> = arm.arriving.iter().zip(outer(&arm.arriving)).map(&mut gives_way).collect();
        if !ways.is_empty() {
            let before = &pieces[(leaving + pieces.len() - 1) % pieces.len()];
            let first = [&before[..], &pieces[leaving]].concat();
            yielding(canvas, &arm.arriving, first, ways.concat());
        }
    }
}

/// Draws a piece of the ring between two rows of points, from `angle` on through a `turn`. Vehicles may change lanes
/// between arms only. Returns the lanelets, from the inner one.
fn piece(
    canvas: &mut Canvas,
    ring: Ring,
    [begin, end]: [&Vec<u32>; 2],
    [angle, turn]: [f64; 2],
    is_between_arms: bool,
) -> Vec<Id> {
    let mut edge = |line: usize| {
        let radius = ring.line(line);
        let path = Path::arc(ring.at(angle, radius), radius, turn);
        let mut points = vec![begin[line]];
        points.extend(path.bends().iter().map(|it| canvas.point(path.beside(*it, 0.0))));
        points.push(end[line]);
        let is_edge = [0, ring.lanes].contains(&line);
        let crossing = if is_edge || !is_between_arms { Crossing::NEVER } else { Crossing::BOTH_WAYS };
        Edge { border: canvas.line(points, crossing), reversed: false }
    };
    let edges: Vec<Edge> = (0..=ring.lanes).map(&mut edge).collect();
    let pairs = edges.windows(2);
    pairs.map(|it| canvas.lane([it[0], it[1]], Surroundings::Town, SPEED_LIMIT)).collect()
}
