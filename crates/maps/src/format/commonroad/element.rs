//! The elements of a CommonRoad file of which roads are made, as plain data.

use laneweave_network::{Point, Side};

use crate::drawing::Crossing;
use crate::problem::Problem;

/// The element `lanelet`.
#[derive(Debug, Default)]
pub(super) struct LaneletElement {
    pub(super) id: i64,
    pub(super) line: usize,
    pub(super) left: Bound,
    pub(super) right: Bound,
    /// Ids of lanelets.
    pub(super) predecessors: Vec<i64>,
    pub(super) successors: Vec<i64>,
    pub(super) adjacent_left: Option<Adjacent>,
    pub(super) adjacent_right: Option<Adjacent>,
    /// Its types, such as `urban`.
    pub(super) types: Vec<String>,
    /// Its users in its direction, and those in both directions; often the file names none.
    pub(super) users: Vec<String>,
    pub(super) users_both_ways: Vec<String>,
    /// The element `speedLimit` of version 2018b [m/s]; NaN where it is unreadable.
    pub(super) speed_limit: Option<f64>,
    /// Ids of traffic signs.
    pub(super) signs: Vec<i64>,
}

impl LaneletElement {
    pub(super) fn bound(&self, side: Side) -> &Bound {
        match side {
            Side::Left => &self.left,
            Side::Right => &self.right,
        }
    }

    pub(super) fn adjacent(&self, side: Side) -> Option<Adjacent> {
        match side {
            Side::Left => self.adjacent_left,
            Side::Right => self.adjacent_right,
        }
    }

    pub(super) fn problem(&self, what: impl Into<String>, remedy: &str) -> Problem {
        problem("lanelet", self.id, self.line, what, remedy)
    }
}

/// A bound of a lanelet, in its direction of travel.
#[derive(Debug, Default)]
pub(super) struct Bound {
    /// Its points; coordinates that are missing or unreadable are NaN.
    pub(super) points: Vec<Point>,
    /// The directions in which its marking may be crossed; `None` if that is not known.
    pub(super) crossing: Option<Crossing>,
}

/// A lanelet beside another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Adjacent {
    pub(super) id: i64,
    /// Whether both run in the same direction.
    pub(super) same_direction: bool,
}

/// The element `trafficSign`.
#[derive(Debug, Default)]
pub(super) struct Sign {
    pub(super) id: i64,
    pub(super) line: usize,
    /// What it shows: numbers of the national catalogue, each with its first value.
    pub(super) shown: Vec<(String, Option<f64>)>,
}

pub(super) fn problem(kind: &str, id: i64, line: usize, what: impl Into<String>, remedy: &str) -> Problem {
    Problem { element: format!("{kind} {id}"), line: Some(line), what: what.into(), remedy: remedy.into() }
}
