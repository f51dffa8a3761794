//! Obstacles of a CommonRoad file: their shapes and positions, which moving and standing ones share, and those that
//! stand.

use laneweave_network::{Point, Pose, Rectangle};

use super::element;
use crate::problem::Problem;
use crate::shape::MAXIMUM_COORDINATE;

/// Maximum length or width of an obstacle, and distance of its centre from its position [m].
const MAXIMUM_EXTENT: f64 = 400.0;
/// Directions beyond this are taken as errors: the format's range is one turn either way [rad].
const MAXIMUM_ANGLE: f64 = 100.0;

/// A rectangle or circle, the first shape of an obstacle; zero where the file says nothing.
#[derive(Default)]
pub struct ObstacleShape {
    /// Length [m].
    pub length: f64,
    /// Width [m].
    pub width: f64,
    /// How many shapes the obstacle has.
    pub count: usize,
    /// Angle to the direction of the obstacle [rad].
    orientation: f64,
    /// Centre, ahead of and left of the obstacle's position [m].
    ahead: f64,
    left: f64,
}

impl ObstacleShape {
    /// Begins the element `part` of an obstacle, which may be a shape.
    pub fn open(&mut self, part: &str) {
        self.count += usize::from(part.strip_prefix("shape/").is_some_and(|it| !it.contains('/')));
    }

    /// Takes the number `value` of the element `part` of an obstacle, if it is of its first shape.
    pub fn take(&mut self, part: &str, value: f64) {
        let Some(leaf) = part.strip_prefix("shape/").filter(|_| self.count == 1) else { return };
        match leaf {
            "rectangle/length" => self.length = value,
            "rectangle/width" => self.width = value,
            "circle/radius" => (self.length, self.width) = (2.0 * value, 2.0 * value),
            "rectangle/orientation" => self.orientation = value,
            "rectangle/center/x" | "circle/center/x" => self.ahead = value,
            "rectangle/center/y" | "circle/center/y" => self.left = value,
            _ => {}
        }
    }

    /// Whether it has a size, and lies around the obstacle's position.
    pub fn is_usable(&self) -> bool {
        let is_extent = |it: f64| it > 0.0 && it <= MAXIMUM_EXTENT;
        let is_near = |it: f64| it.abs() <= MAXIMUM_EXTENT;
        let is_turn = self.orientation.abs() <= MAXIMUM_ANGLE;
        is_extent(self.length)
            && is_extent(self.width)
            && is_near(self.ahead)
            && is_near(self.left)
            && is_turn
    }

    /// The centre of the shape of an obstacle that is at `[x, y]` [m] with this heading [rad], and its heading.
    pub fn centre(&self, [x, y]: [f64; 2], heading: f64) -> ([f64; 2], f64) {
        let (sin, cos) = heading.sin_cos();
        let at = [x + cos * self.ahead - sin * self.left, y + sin * self.ahead + cos * self.left];
        (at, heading + self.orientation)
    }
}

/// A value that is exact or an interval.
#[derive(Default)]
pub struct Value {
    /// The exact one.
    pub exact: Option<f64>,
    start: Option<f64>,
    end: Option<f64>,
}

impl Value {
    /// Takes the number `value` of the element `leaf`.
    pub fn take(&mut self, leaf: &str, value: f64) {
        match leaf {
            "exact" => self.exact = Some(value),
            "intervalStart" => self.start = Some(value),
            "intervalEnd" => self.end = Some(value),
            _ => {}
        }
    }

    /// The exact value, or the middle of the interval.
    pub fn middle(&self) -> Option<f64> {
        self.exact.or_else(|| Some(0.5 * (self.start? + self.end?)))
    }
}

/// A position and an orientation.
#[derive(Default)]
pub struct Place {
    x: Option<f64>,
    y: Option<f64>,
    orientation: Value,
}

impl Place {
    /// Takes the number `value` of the element `leaf` of a state.
    pub fn take(&mut self, leaf: &str, value: f64) {
        match leaf.split_once('/') {
            Some(("position", "point/x" | "rectangle/center/x" | "circle/center/x")) => {
                self.x = self.x.or(Some(value));
            }
            Some(("position", "point/y" | "rectangle/center/y" | "circle/center/y")) => {
                self.y = self.y.or(Some(value));
            }
            Some(("orientation", leaf)) => self.orientation.take(leaf, value),
            _ => {}
        }
    }

    /// The position [m] and the heading [rad].
    ///
    /// # Errors
    /// What is missing or out of range.
    pub fn known(&self) -> Result<([f64; 2], f64), &'static str> {
        let within = |value: Option<f64>, limit: f64| value.filter(|it| it.abs() <= limit);
        let coordinate = |it| within(it, MAXIMUM_COORDINATE).ok_or("it has no position");
        let heading = within(self.orientation.middle(), MAXIMUM_ANGLE).ok_or("it has no orientation")?;
        Ok(([coordinate(self.x)?, coordinate(self.y)?], heading))
    }
}

/// The element `staticObstacle`, in version 2018b `obstacle` with the role `static`, while it is read.
#[derive(Default)]
pub(super) struct StaticObstacle {
    pub(super) id: i64,
    pub(super) line: usize,
    pub(super) is_static: bool,
    shape: ObstacleShape,
    place: Place,
}

impl StaticObstacle {
    pub(super) fn new(id: i64, line: usize, is_static: bool) -> StaticObstacle {
        StaticObstacle { id, line, is_static, ..StaticObstacle::default() }
    }

    pub(super) fn open(&mut self, part: &str) {
        self.shape.open(part);
    }

    pub(super) fn close(&mut self, part: &str, text: &str, value: f64) {
        if part == "role" {
            self.is_static = text == "static";
        }
        self.shape.take(part, value);
        if let Some(leaf) = part.strip_prefix("initialState/") {
            self.place.take(leaf, value);
        }
    }

    /// The ground that it covers, if that is known.
    pub(super) fn ground(&self, problems: &mut Vec<Problem>) -> Option<Rectangle> {
        let problem = |what: String, remedy| element::problem("obstacle", self.id, self.line, what, remedy);
        let ObstacleShape { length, width, count, .. } = self.shape;
        if !self.shape.is_usable() {
            let what = "its first shape is not a rectangle or circle of a usable size, so it is left out";
            problems.push(problem(what.into(), "give it a rectangle with length and width in m"));
            return None;
        }
        if count > 1 {
            problems.push(problem(
                format!("only the first of its {count} shapes is used"),
                "give it one rectangle",
            ));
        }
        match self.place.known() {
            Ok((at, heading)) => {
                let ([x, y], heading) = self.shape.centre(at, heading);
                Some(Rectangle { pose: Pose { at: Point::new(x, y, 0.0), heading }, length, width })
            }
            Err(why) => {
                problems.push(problem(format!("{why}, so it is left out"), "give it an initialState"));
                None
            }
        }
    }
}
