//! Side roads: lanes that leave a road, or join it, at an angle.

use std::f64::consts::PI;

use laneweave_network::Pose;

use super::mouth::{Knot, Mouth, Span, onward};
use super::stretch::{Pen, Stretch, limit_of_bend};
use crate::path::Path;

/// Whether lanes part from a road in its drawing direction, or join it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Joint {
    Parts,
    Comes,
}

/// The shape of a side road.
#[derive(Clone, Copy, Debug)]
pub(super) struct Course {
    pub(super) joint: Joint,
    /// Angle to the left of the road in its drawing direction, seen from the joint outwards [rad].
    pub(super) angle: f64,
    /// From the joint to where its directions meet, and from there to its end [m].
    pub(super) legs: [f64; 2],
}

impl Pen {
    /// Draws a side road outwards from some lanes of a cross-section, and returns its outer end.
    pub(super) fn side_road(&mut self, at: &Mouth, course: Course) -> Mouth {
        let from = match course.joint {
            Joint::Parts => at.clone(),
            Joint::Comes => turned(at),
        };
        let turn = if course.joint == Joint::Parts { course.angle } else { -course.angle };
        let corner = onward(from.pose, course.legs[0], turn);
        let path = Path::between(from.pose, onward(corner, course.legs[1], 0.0));
        let radius = course.legs[0].min(course.legs[1]) / libm::tan(course.angle.abs() / 2.0);
        let from = from.at_most(limit_of_bend(radius));
        self.draw(&Stretch::onward(&from, path).solid())
    }
}

/// A cross-section seen in the opposite direction.
fn turned(mouth: &Mouth) -> Mouth {
    let last = mouth.knots.len() - 1;
    let knot = |it: &Knot| Knot { offset: -it.offset, ..*it };
    let span = |it: &Span| Span { left: last - it.right, right: last - it.left, ahead: !it.ahead };
    Mouth {
        pose: Pose { heading: mouth.pose.heading + PI, ..mouth.pose },
        knots: mouth.knots.iter().rev().map(knot).collect(),
        spans: mouth.spans.iter().rev().map(span).collect(),
        lanelets: mouth.lanelets.iter().rev().copied().collect(),
        limit_kmh: mouth.limit_kmh,
    }
}
