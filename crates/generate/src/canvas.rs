//! A drawing under construction: points, borders, lanes and rules, numbered in order. It is drawn for traffic on the
//! right.

use laneweave_maps::drawing::{Border, Crossing, Drawing, Edge, Lane, Paint, Surroundings};
use laneweave_maps::{Rule, RuleKind};
use laneweave_network::{Classes, DrivingSide, Id, Point};

/// A drawing under construction.
#[derive(Clone)]
pub(super) struct Canvas {
    drawing: Drawing,
}

impl Canvas {
    pub(super) fn new() -> Canvas {
        let drawing = Drawing {
            points: Vec::new(),
            borders: Vec::new(),
            lanes: Vec::new(),
            rules: Vec::new(),
            driving_side: DrivingSide::Right,
        };
        Canvas { drawing }
    }

    /// Adds a point, rounded to the millimetre.
    pub(super) fn point(&mut self, at: Point) -> u32 {
        // Adding zero leaves no negative zero.
        let [x, y, z] = [at.x, at.y, at.z].map(|metres| (metres * 1000.0).round() / 1000.0 + 0.0);
        self.drawing.points.push(Point { x, y, z });
        self.drawing.points.len() as u32 - 1
    }

    /// The drawing so far.
    pub(super) fn drawing(&self) -> &Drawing {
        &self.drawing
    }

    /// Where a point lies.
    pub(super) fn at(&self, point: u32) -> Point {
        self.drawing.points[point as usize]
    }

    /// Adds a painted line.
    pub(super) fn line(&mut self, points: Vec<u32>, crossing: Crossing) -> u32 {
        self.border(Border { points, paint: Paint::Painted, crossing })
    }

    /// Adds a border that is not painted, and that vehicles may not cross.
    pub(super) fn imaginary(&mut self, points: Vec<u32>) -> u32 {
        self.border(Border { points, paint: Paint::Virtual, crossing: Crossing::NEVER })
    }

    fn border(&mut self, border: Border) -> u32 {
        self.drawing.borders.push(border);
        self.drawing.borders.len() as u32 - 1
    }

    /// Adds a lane with the next id.
    pub(super) fn lane(
        &mut self,
        [left, right]: [Edge; 2],
        surroundings: Surroundings,
        limit_kmh: f64,
    ) -> Id {
        let id = Id::from(self.drawing.lanes.len() as i64 + 1);
        let (classes, is_two_way) = (Classes::ALL, false);
        let lane = Lane { id, line: None, left, right, classes, is_two_way, surroundings, limit_kmh };
        self.drawing.lanes.push(lane);
        id
    }

    /// Keeps a lane for some classes of vehicles.
    pub(super) fn keep_for(&mut self, id: Id, classes: Classes) {
        self.drawing.lanes.iter_mut().filter(|it| it.id == id).for_each(|it| it.classes = classes);
    }

    /// Adds a rule for some lanes.
    pub(super) fn rule(
        &mut self,
        kind: RuleKind,
        mut lanelets: Vec<Id>,
        stop_lines: Vec<Vec<Point>>,
        signs: Vec<Vec<Point>>,
    ) {
        lanelets.sort_unstable();
        self.drawing.rules.push(Rule { id: 0.into(), line: None, kind, lanelets, stop_lines, signs });
    }

    /// The same without points that no border uses.
    pub(super) fn tidied(mut self) -> Canvas {
        let Drawing { points, borders, .. } = &mut self.drawing;
        let mut places: Vec<Option<u32>> = vec![None; points.len()];
        borders.iter().flat_map(|it| &it.points).for_each(|it| places[*it as usize] = Some(0));
        places.iter_mut().flatten().zip(0..).for_each(|(place, number)| *place = number);
        let mut kept = places.iter();
        points.retain(|_| kept.next().is_some_and(Option::is_some));
        for point in borders.iter_mut().flat_map(|it| &mut it.points) {
            *point = places[*point as usize].unwrap_or(*point);
        }
        self
    }

    /// The drawing, its rules numbered after the lanes; for traffic on the left its mirror image, with y negated.
    pub(super) fn finish(mut self, driving_side: DrivingSide) -> Drawing {
        let first = self.drawing.lanes.len() as i64 + 1;
        for (rule, id) in self.drawing.rules.iter_mut().zip(first..) {
            rule.id = id.into();
        }
        match driving_side {
            DrivingSide::Right => self.drawing,
            DrivingSide::Left => self.drawing.mirrored(),
        }
    }
}
