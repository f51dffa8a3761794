//! A map as it is drawn: points, borders through them, and lanes between borders.

use laneweave_network::{DrivingSide, Lanelet, Network, Point, Polygon, Polyline};
use rayon::prelude::*;

use crate::conflict::conflicts;
use crate::contents::Contents;
use crate::error::MapError;
use crate::format::Map;
use crate::graph::{self, Graph};
use crate::problem::Problem;
use crate::rule::Rule;
use crate::shape::{Flaw, Shape};

/// The roads of a map file: borders that lanes share, as yet without a graph.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    pub(crate) points: Vec<Point>,
    pub(crate) borders: Vec<Border>,
    pub(crate) lanes: Vec<Lane>,
    pub(crate) rules: Vec<Rule>,
    pub(crate) driving_side: DrivingSide,
}

/// A line between lanes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Border {
    /// Places in [`Drawing::points`].
    pub(crate) points: Vec<u32>,
    /// Its visible form.
    pub(crate) paint: Paint,
    /// The directions in which it may be crossed, seen along its points.
    pub(crate) crossing: Crossing,
}

/// The visible form of a border.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Paint {
    /// A line, or another physical border.
    Painted,
    /// Nothing: it is in the map only.
    Virtual,
}

/// In which directions a border may be crossed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Crossing {
    pub(crate) to_left: bool,
    pub(crate) to_right: bool,
}

impl Crossing {
    pub(crate) const NEVER: Crossing = Crossing { to_left: false, to_right: false };
    pub(crate) const BOTH_WAYS: Crossing = Crossing { to_left: true, to_right: true };

    /// The same, seen against the direction of the points.
    pub(crate) fn reversed(self) -> Crossing {
        Crossing { to_left: self.to_right, to_right: self.to_left }
    }
}

/// A border as the side of a lane: run along its points, or against them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Edge {
    /// Place in [`Drawing::borders`].
    pub(crate) border: u32,
    pub(crate) reversed: bool,
}

impl Edge {
    /// The same border, run the other way.
    pub(crate) fn reversed(self) -> Edge {
        Edge { reversed: !self.reversed, ..self }
    }
}

/// A lane between two borders, both run in its direction of travel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Lane {
    pub(crate) id: i64,
    /// Line of the file in which it stands.
    pub(crate) line: Option<usize>,
    pub(crate) left: Edge,
    pub(crate) right: Edge,
    /// It may be used against its direction, too.
    pub(crate) is_two_way: bool,
    pub(crate) surroundings: Surroundings,
    /// Speed limit [km/h].
    pub(crate) limit_kmh: f64,
}

/// The surroundings of a lane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Surroundings {
    /// A motorway with its ramps.
    Motorway,
    Town,
    /// Open country.
    Country,
}

/// Kilometres an hour in a metre a second.
pub(crate) const KMH_PER_MPS: f64 = 3.6;

impl Drawing {
    /// The map of this drawing, with a problem for each lane that was left out because of its shape.
    ///
    /// # Errors
    /// If no lane is left.
    pub fn build(&self) -> Result<Map, MapError> {
        let mut lanes = Vec::with_capacity(self.lanes.len());
        let mut lanelets = Vec::with_capacity(self.lanes.len());
        let mut problems = Vec::new();
        let shape = |lane: &Lane| Shape::between(self.polyline(lane.left), self.polyline(lane.right));
        let shapes: Vec<Result<Shape, Flaw>> = self.lanes.par_iter().map(shape).collect();
        for (lane, shape) in self.lanes.iter().zip(shapes) {
            match shape {
                Ok(shape) => {
                    lanes.push(*lane);
                    let Shape { left, right, centre } = shape;
                    let limit = lane.limit_kmh / KMH_PER_MPS;
                    lanelets.push(Lanelet::alone(lane.id, [left, right, centre], limit));
                }
                Err(flaw) => problems.push(Problem {
                    element: format!("lanelet {}", lane.id),
                    line: lane.line,
                    what: format!("{}, so it is left out", flaw.what),
                    remedy: flaw.remedy.into(),
                }),
            }
        }
        if lanelets.is_empty() {
            let remedy = "draw lanes between borders of some length";
            return Err(MapError::NotDrivable { lanelets: self.lanes.len(), problems, remedy });
        }
        let nodes = graph::nodes(self, &lanes);
        graph::link(&mut lanelets, &nodes);
        let outlines: Vec<Option<Polygon>> = lanes.par_iter().map(|lane| self.outline(lane)).collect();
        let are_joined = |a: usize, b: usize| self.are_joined(&lanes[a], &lanes[b]);
        let mut conflicts = conflicts(&outlines, are_joined);
        problems.extend(conflicts.problems(|it| (lanes[it.at()].id, lanes[it.at()].line)));
        graph::add_two_way(&mut conflicts.with, &nodes);
        let graph = Graph { nodes, conflicting: conflicts.with };
        let network = Network::new(lanelets, self.driving_side)?;
        let rules = self.rules.clone();
        Ok(Map { network, graph, rules, contents: Contents::default(), problems, origin: None })
    }

    /// The mirror image, with y negated: left and right change places.
    pub(crate) fn mirrored(mut self) -> Drawing {
        let turn = |point: &mut Point| point.y = -point.y;
        self.points.iter_mut().for_each(turn);
        let lines = self.rules.iter_mut().flat_map(|it| it.stop_lines.iter_mut().chain(&mut it.signs));
        lines.flatten().for_each(turn);
        self.borders.iter_mut().for_each(|it| it.crossing = it.crossing.reversed());
        self.lanes.iter_mut().for_each(|it| std::mem::swap(&mut it.left, &mut it.right));
        self.driving_side = match self.driving_side {
            DrivingSide::Left => DrivingSide::Right,
            DrivingSide::Right => DrivingSide::Left,
        };
        self
    }

    /// The points at which a lane between these borders begins, on its left and on its right.
    pub(crate) fn starts(&self, left: Edge, right: Edge) -> (u32, u32) {
        (self.ends(left).0, self.ends(right).0)
    }

    /// The points at which a lane between these borders ends, on its left and on its right.
    pub(crate) fn finishes(&self, left: Edge, right: Edge) -> (u32, u32) {
        (self.ends(left).1, self.ends(right).1)
    }

    /// The area of a lane; `None` if it has none.
    pub(crate) fn outline(&self, lane: &Lane) -> Option<Polygon> {
        Polygon::new(self.along(lane.left).chain(self.along(lane.right.reversed())))
    }

    /// First and last point of `edge` in the direction of travel.
    pub(crate) fn ends(&self, edge: Edge) -> (u32, u32) {
        let points = &self.borders[edge.border as usize].points;
        let (first, last) = (points[0], points[points.len() - 1]);
        if edge.reversed { (last, first) } else { (first, last) }
    }

    /// Whether two lanes lie on either side of a border, or one begins or ends where the other does, in some
    /// direction of travel.
    fn are_joined(&self, a: &Lane, b: &Lane) -> bool {
        let is_beside = a.left == b.right || a.right == b.left;
        let is_opposite = a.left == b.left.reversed() || a.right == b.right.reversed();
        let start = |lane: &Lane| self.starts(lane.left, lane.right);
        let finish = |lane: &Lane| self.finishes(lane.left, lane.right);
        let turned = |(left, right): (u32, u32)| (right, left);
        is_beside
            || is_opposite
            || finish(a) == start(b)
            || finish(b) == start(a)
            || finish(a) == turned(finish(b))
            || start(a) == turned(start(b))
    }

    /// The directions in which `edge` may be crossed, seen in the direction of travel.
    pub(crate) fn crossing(&self, edge: Edge) -> Crossing {
        let crossing = self.borders[edge.border as usize].crossing;
        if edge.reversed { crossing.reversed() } else { crossing }
    }

    /// The points of `edge` in the direction of travel.
    fn along(&self, edge: Edge) -> impl Iterator<Item = Point> {
        let points = &self.borders[edge.border as usize].points;
        (0..points.len()).map(move |index| {
            let index = if edge.reversed { points.len() - 1 - index } else { index };
            self.points[points[index] as usize]
        })
    }

    fn polyline(&self, edge: Edge) -> Option<Polyline> {
        Polyline::new(self.along(edge))
    }
}
