//! A map as it is drawn: points, borders through them, and lanes between borders.

use laneweave_network::{Classes, DrivingSide, Id, Point, Polygon};

use crate::rule::Rule;

/// The roads of a map file: borders that lanes share, as yet without a graph.
///
/// Points and borders are named by their place in its lists. A name that is in no list, or a border without points,
/// is an error of the program that draws: [`build`](Drawing::build) and
/// [`lanelet2::write`](crate::lanelet2::write) panic.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    /// Points of borders.
    pub points: Vec<Point>,
    /// Lines between lanes.
    pub borders: Vec<Border>,
    /// Lanes between borders.
    pub lanes: Vec<Lane>,
    /// Lights, signs and priorities.
    pub rules: Vec<Rule>,
    /// On which side traffic drives.
    pub driving_side: DrivingSide,
}

/// A line between lanes.
#[derive(Clone, Debug, PartialEq)]
pub struct Border {
    /// Places in [`Drawing::points`].
    pub points: Vec<u32>,
    /// Its visible form.
    pub paint: Paint,
    /// The directions in which it may be crossed, seen along its points.
    pub crossing: Crossing,
}

/// The visible form of a border.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Paint {
    /// A line, or another physical border.
    Painted,
    /// Nothing: it is in the map only.
    Virtual,
}

/// In which directions a border may be crossed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Crossing {
    /// From right to left.
    pub to_left: bool,
    /// From left to right.
    pub to_right: bool,
}

impl Crossing {
    /// In no direction.
    pub const NEVER: Crossing = Crossing { to_left: false, to_right: false };
    /// In both directions.
    pub const BOTH_WAYS: Crossing = Crossing { to_left: true, to_right: true };

    /// The same, seen against the direction of the points.
    pub fn reversed(self) -> Crossing {
        Crossing { to_left: self.to_right, to_right: self.to_left }
    }
}

/// A border as the side of a lane: run along its points, or against them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Edge {
    /// Place in [`Drawing::borders`].
    pub border: u32,
    /// Whether it is run against its points.
    pub reversed: bool,
}

impl Edge {
    /// The same border, run the other way.
    pub fn reversed(self) -> Edge {
        Edge { reversed: !self.reversed, ..self }
    }
}

/// A lane between two borders, both run in its direction of travel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lane {
    /// Its id in the map.
    pub id: Id,
    /// Line of the file in which it stands.
    pub line: Option<usize>,
    /// Its left side.
    pub left: Edge,
    /// Its right side.
    pub right: Edge,
    /// Who may use it.
    pub classes: Classes,
    /// It may be used against its direction, too.
    pub is_two_way: bool,
    /// Its surroundings.
    pub surroundings: Surroundings,
    /// Speed limit [km/h].
    pub limit_kmh: f64,
}

/// The surroundings of a lane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Surroundings {
    /// A motorway with its ramps.
    Motorway,
    /// Streets within a town.
    Town,
    /// Open country.
    Country,
}

/// Kilometres an hour in a metre a second.
pub const KMH_PER_MPS: f64 = 3.6;

impl Drawing {
    /// The mirror image, with y negated: left and right change places.
    pub fn mirrored(mut self) -> Drawing {
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
    pub fn outline(&self, lane: &Lane) -> Option<Polygon> {
        Polygon::new(self.along(lane.left).chain(self.along(lane.right.reversed())))
    }

    /// First and last point of `edge` in the direction of travel.
    pub(crate) fn ends(&self, edge: Edge) -> (u32, u32) {
        let points = &self.borders[edge.border as usize].points;
        let (first, last) = (points[0], points[points.len() - 1]);
        if edge.reversed { (last, first) } else { (first, last) }
    }

    /// The directions in which `edge` may be crossed, seen in the direction of travel.
    pub(crate) fn crossing(&self, edge: Edge) -> Crossing {
        let crossing = self.borders[edge.border as usize].crossing;
        if edge.reversed { crossing.reversed() } else { crossing }
    }

    /// The points of `edge` in the direction of travel.
    pub(crate) fn along(&self, edge: Edge) -> impl Iterator<Item = Point> {
        let points = &self.borders[edge.border as usize].points;
        (0..points.len()).map(move |index| {
            let index = if edge.reversed { points.len() - 1 - index } else { index };
            self.points[points[index] as usize]
        })
    }
}
