//! Mouths: cross-sections at which elements are joined.

use laneweave_network::{Id, Point, Pose};

use crate::canvas::Canvas;
use crate::street::LaneEnd;

/// A point of a cross-section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Knot {
    pub(super) point: u32,
    /// Its offset to the left of the pose [m].
    pub(super) offset: f64,
}

/// A lane between two lines of a cross-section; lines are given by the numbers of their points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Span {
    /// Its line on the left, seen along the road, not along the lane.
    pub(super) left: usize,
    /// Its line on the right.
    pub(super) right: usize,
    /// Whether traffic drives along the road, not against it.
    pub(super) ahead: bool,
}

/// A cross-section of a road, seen in its drawing direction.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Mouth {
    /// Its middle, and the direction of the road.
    pub(super) pose: Pose,
    /// Its points; two points of neighbouring lanes may be one.
    pub(super) knots: Vec<Knot>,
    /// Its lanes, from left to right.
    pub(super) spans: Vec<Span>,
    /// The lanelets that end or begin here, one for each lane; none at the edge of the map.
    pub(super) lanelets: Vec<Id>,
    /// Speed limit [km/h].
    pub(super) limit_kmh: f64,
}

/// The form of a new cross-section.
#[derive(Clone, Copy, Debug)]
pub(super) struct Width {
    /// Width of a lane [m].
    pub(super) lane: f64,
    /// Speed limit [km/h].
    pub(super) limit_kmh: f64,
}

impl Mouth {
    /// Lanes of one direction.
    pub(super) fn one_way(canvas: &mut Canvas, pose: Pose, lanes: usize, ahead: bool, width: Width) -> Mouth {
        let offset = |line: usize| (lanes as f64 / 2.0 - line as f64) * width.lane;
        let knots = (0..=lanes).map(|it| knot(canvas, pose, offset(it))).collect();
        let spans = (0..lanes).map(|it| Span { left: it, right: it + 1, ahead }).collect();
        Mouth { pose, knots, spans, lanelets: Vec::new(), limit_kmh: width.limit_kmh }
    }

    /// A lane in each direction; they share an area of the width `overlap` [m].
    pub(super) fn two_way(canvas: &mut Canvas, pose: Pose, overlap: f64, width: Width) -> Mouth {
        let mut knots: Vec<Knot> = Vec::new();
        for offset in two_way_offsets(width.lane, overlap) {
            let known = knots.iter().find(|it| it.offset == offset).copied();
            knots.push(known.unwrap_or_else(|| knot(canvas, pose, offset)));
        }
        let spans = vec![Span { left: 0, right: 1, ahead: false }, Span { left: 2, right: 3, ahead: true }];
        Mouth { pose, knots, spans, lanelets: Vec::new(), limit_kmh: width.limit_kmh }
    }

    /// Whether lanes of both directions meet here.
    pub(super) fn is_two_way(&self) -> bool {
        self.spans.iter().any(|it| it.ahead != self.spans[0].ahead)
    }

    /// Whether traffic of the first lane drives along the road.
    pub(super) fn is_ahead(&self) -> bool {
        self.spans[0].ahead
    }

    /// Number of lanes.
    pub(super) fn lanes(&self) -> usize {
        self.spans.len()
    }

    /// Width of the first lane [m].
    pub(super) fn lane_width(&self) -> f64 {
        let Span { left, right, .. } = self.spans[0];
        self.knots[left].offset - self.knots[right].offset
    }

    /// Width and limit of the road.
    pub(super) fn width(&self) -> Width {
        Width { lane: self.lane_width(), limit_kmh: self.limit_kmh }
    }

    /// How far its outermost points lie to the left, and to the right [m].
    pub(super) fn reach(&self) -> [f64; 2] {
        let offsets = || self.knots.iter().map(|it| it.offset);
        [offsets().fold(f64::MIN, f64::max), offsets().fold(f64::MAX, f64::min)]
    }

    /// Its width [m].
    pub(super) fn breadth(&self) -> f64 {
        let [left, right] = self.reach();
        left - right
    }

    /// The points of a lane, left and right along the road.
    pub(super) fn of(&self, lane: usize) -> [Knot; 2] {
        let Span { left, right, .. } = self.spans[lane];
        [self.knots[left], self.knots[right]]
    }

    /// The first lane that ends here, or begins here, seen along the lane.
    pub(super) fn lane_end(&self, ahead: bool) -> Option<LaneEnd> {
        let lane = self.spans.iter().position(|it| it.ahead == ahead)?;
        let [left, right] = self.of(lane).map(|it| it.point);
        let [left, right] = if ahead { [left, right] } else { [right, left] };
        Some(LaneEnd { lanelet: *self.lanelets.get(lane)?, left, right })
    }

    /// The cross-section of some of its lanes only, its pose in their middle; lanes of no width are left out.
    pub(super) fn only(&self, lanes: std::ops::Range<usize>) -> Mouth {
        let mut mouth = Mouth { knots: Vec::new(), spans: Vec::new(), lanelets: Vec::new(), ..self.clone() };
        for lane in lanes {
            let [left, right] = self.of(lane);
            if left.point == right.point {
                continue;
            }
            let place = mouth.knots.len();
            // Lanes of one direction beside each other share the line between them.
            let shares = !self.is_two_way() && mouth.knots.last() == Some(&left);
            mouth.knots.extend(if shares { vec![right] } else { vec![left, right] });
            let first = place - usize::from(shares);
            mouth.spans.push(Span { left: first, right: first + 1, ahead: self.spans[lane].ahead });
            mouth.lanelets.extend(self.lanelets.get(lane));
        }
        mouth.centred()
    }

    fn centred(mut self) -> Mouth {
        let [left, right] = self.reach();
        let middle = (left + right) / 2.0;
        self.pose = beside(self.pose, middle);
        self.knots.iter_mut().for_each(|it| it.offset -= middle);
        self
    }

    /// The same cross-section with another speed limit [km/h].
    pub(super) fn at_most(self, limit_kmh: f64) -> Mouth {
        Mouth { limit_kmh: self.limit_kmh.min(limit_kmh), ..self }
    }
}

/// Offsets of the lines of a lane against the road and of one along it, both `lane` wide, which share an area of the
/// width `overlap` [m].
pub(super) fn two_way_offsets(lane: f64, overlap: f64) -> [f64; 4] {
    let out = lane - overlap / 2.0;
    // Adding zero leaves no negative zero.
    [out, -overlap / 2.0 + 0.0, overlap / 2.0, -out]
}

/// A new point to the left of a pose.
pub(super) fn knot(canvas: &mut Canvas, pose: Pose, offset: f64) -> Knot {
    Knot { point: canvas.point(beside(pose, offset).at), offset }
}

/// The pose `offset` to the left of another one [m].
pub(super) fn beside(pose: Pose, offset: f64) -> Pose {
    let Pose { at, heading } = pose;
    let (sine, cosine) = (libm::sin(heading), libm::cos(heading));
    Pose { at: Point::new(at.x - offset * sine, at.y + offset * cosine, at.z), heading }
}

/// The pose `length` ahead, then turned by `turn` [m, rad].
pub(super) fn onward(pose: Pose, length: f64, turn: f64) -> Pose {
    let Pose { at, heading } = pose;
    let (x, y) = (at.x + length * libm::cos(heading), at.y + length * libm::sin(heading));
    Pose { at: Point::new(x, y, at.z), heading: heading + turn }
}
