//! The map of a drawing: which of its lanes have a shape, how they are linked, and which conflict.

use std::collections::BTreeMap;

use laneweave_network::{Lanelet, Network, Point, Polygon};
use rayon::prelude::*;

use crate::conflict::conflicts;
use crate::contents::Contents;
use crate::drawing::{Drawing, Edge, KMH_PER_MPS, Lane, Surroundings};
use crate::error::MapError;
use crate::graph::{self, Graph};
use crate::loose_ends::loose_ends;
use crate::map::Map;
use crate::problem::Problem;
use crate::shape::{Flaw, Shape};

impl Drawing {
    /// The map of this drawing, with a problem for each lane that was left out because of its shape.
    ///
    /// # Errors
    /// If no lane is left.
    pub fn build(&self) -> Result<Map, MapError> {
        let mut lanes = Vec::with_capacity(self.lanes.len());
        let mut lanelets = Vec::with_capacity(self.lanes.len());
        let mut problems = Vec::new();
        let line = |edge: Edge| -> Vec<Point> { self.along(edge).collect() };
        let shape = |lane: &Lane| Shape::between(&line(lane.left), &line(lane.right));
        let shapes: Vec<Result<Shape, Flaw>> = self.lanes.par_iter().map(shape).collect();
        for (lane, shape) in self.lanes.iter().zip(shapes) {
            let problem = |what: String, flaw: Flaw| Problem {
                element: format!("lanelet {}", lane.id),
                line: lane.line,
                what,
                remedy: flaw.remedy.into(),
            };
            match shape {
                Ok(Shape { left, right, centre, flaws }) => {
                    lanes.push(*lane);
                    problems.extend(flaws.into_iter().map(|it| problem(it.what.into(), it)));
                    let limit = lane.limit_kmh / KMH_PER_MPS;
                    let is_in_town = lane.surroundings == Surroundings::Town;
                    let alone = Lanelet::alone(lane.id, [left, right, centre], limit);
                    lanelets.push(Lanelet { is_in_town, classes: lane.classes, ..alone });
                }
                Err(flaw) => problems.push(problem(format!("{}, so it is left out", flaw.what), flaw)),
            }
        }
        if lanelets.is_empty() {
            let remedy = "draw lanes between borders of some length";
            return Err(MapError::NotDrivable { lanelets: self.lanes.len(), problems, remedy });
        }
        let nodes = graph::nodes(self, &lanes);
        graph::link(&mut lanelets, &nodes);
        problems.extend(loose_ends(self, &lanes, &lanelets, &nodes));
        let outlines: Vec<Option<Polygon>> = lanes.par_iter().map(|lane| self.outline(lane)).collect();
        let are_joined = |a: usize, b: usize| self.are_joined(&lanes[a], &lanes[b]);
        let mut conflicts = conflicts(&outlines, are_joined);
        problems.extend(conflicts.problems(|it| (lanes[it.at()].id, lanes[it.at()].line)));
        graph::add_two_way(&mut conflicts.with, &nodes);
        let graph = Graph { nodes, conflicting: conflicts.with };
        let network = Network::new(lanelets, self.driving_side)?;
        let rules = self.rules.clone();
        let contents = Contents::default();
        Ok(Map { network, graph, rules, programs: BTreeMap::new(), contents, problems, origin: None })
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
}
