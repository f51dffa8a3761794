//! The shape of one lane: two borders and the centre line between them.

use laneweave_network::{Point, Polyline, turn};

/// Coordinates beyond this are taken as errors [m].
pub(crate) const MAXIMUM_COORDINATE: f64 = 4.1e7;

/// Borders and centre line of a lane that can be driven.
#[derive(Debug)]
pub(crate) struct Shape {
    pub(crate) left: Polyline,
    pub(crate) right: Polyline,
    pub(crate) centre: Polyline,
    /// What is odd about its borders, although it can be driven.
    pub(crate) flaws: Vec<Flaw>,
}

/// What is wrong with two borders.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Flaw {
    pub(crate) what: &'static str,
    pub(crate) remedy: &'static str,
}

/// Minimum length of the centre line; a border that is shorter counts as one point [m].
const MINIMUM_LENGTH: f64 = 0.01;

/// Maximum length of a lane; a longer one has a point that is far off [m].
const MAXIMUM_LENGTH: f64 = 20_000.0;

/// A centre line that is shorter than this share of both borders lies between borders that do not belong together.
const MINIMUM_SHARE: f64 = 0.5;

/// The size of the border that stands for a single point, as a share of the other border.
const SCALE_OF_POINT: f64 = 1e-3;

/// A border that turns by more than this turns back [rad].
const TURNS_BACK: f64 = 2.8;

/// Segments of a border that are shorter than this say nothing of its direction [m].
const JITTER: f64 = 0.5;

/// Borders that cross by less than this only touch [m].
const TOUCH: f64 = 0.01;

/// Maximum of pairs of segments that are checked for a crossing: the time must not grow with the square of a border.
const CHECKED_PAIRS: usize = 1 << 14;

impl Shape {
    /// The lane between two borders that run in its direction of travel.
    ///
    /// A border may be a single point, around which vehicles turn. The other border, much reduced, stands for it.
    pub(crate) fn between(left: &[Point], right: &[Point]) -> Result<Shape, Flaw> {
        let long_enough = |it: &Polyline| it.length() >= MINIMUM_LENGTH;
        let lines = [left, right].map(|it| Polyline::new(it.iter().copied()).filter(long_enough));
        let shortened = |line: &Option<Polyline>, border: &[Point]| {
            line.as_ref().is_some_and(|it| it.points().len() < border.len())
        };
        let is_repeated = shortened(&lines[0], left) || shortened(&lines[1], right);
        let [left_point, right_point] = [(&lines[0], left), (&lines[1], right)]
            .map(|(line, it)| only_point(it).filter(|_| line.is_none()));
        let (left_line, right_line) = match (lines, left_point, right_point) {
            ([Some(left), Some(right)], ..) => (left, right),
            ([Some(left), None], _, Some(point)) => (left.clone(), reduced(&left, point)?),
            ([None, Some(right)], Some(point), _) => (reduced(&right, point)?, right),
            ([None, None], Some(_), Some(_)) => return Err(NO_LENGTH),
            ([None, _], None, _) => return Err(LEFT_NOWHERE),
            _ => return Err(RIGHT_NOWHERE),
        };
        // The borders are checked, too, because the time for the centre line grows with them.
        if left_line.length().max(right_line.length()) > MAXIMUM_LENGTH {
            return Err(TOO_LONG);
        }
        let centre = match (left_point, right_point) {
            (Some(point), _) => halfway(&right_line, point),
            (_, Some(point)) => halfway(&left_line, point),
            _ => centre(&left_line, &right_line)?,
        };
        let centre = centre.filter(long_enough).ok_or(TOO_SHORT)?;
        let odd = [
            (left_point.is_some() || right_point.is_some(), POINT),
            (is_repeated, REPEATED),
            ([&left_line, &right_line].into_iter().any(turns_back), BACK),
            (are_crossed(&left_line, &right_line), CROSSED),
        ];
        let flaws = odd.into_iter().filter_map(|(is_so, flaw)| is_so.then_some(flaw)).collect();
        Ok(Shape { left: left_line, right: right_line, centre, flaws })
    }
}

const NO_LENGTH: Flaw =
    Flaw { what: "its borders have no length", remedy: "draw them through at least two different points" };
const LEFT_NOWHERE: Flaw =
    Flaw { what: "its left border has no points with finite coordinates", remedy: "correct its coordinates" };
const RIGHT_NOWHERE: Flaw = Flaw {
    what: "its right border has no points with finite coordinates",
    remedy: "correct its coordinates",
};
const TOO_LONG: Flaw = Flaw {
    what: "it is longer than 20 km",
    remedy: "correct the point that is far away, or split the lanelet",
};
const TOO_SHORT: Flaw = Flaw { what: "it is shorter than 1 cm", remedy: "correct its borders or delete it" };
const OPPOSITE: Flaw = Flaw {
    what: "its borders run in opposite directions or cross, so that its length is not known",
    remedy: "draw both in the direction of travel, and correct points that lie far off",
};
const POINT: Flaw = Flaw {
    what: "one of its borders is a single point, so vehicles turn around it",
    remedy: "draw it through at least two different points if it has a length",
};
const REPEATED: Flaw = Flaw {
    what: "a border runs through one place twice in a row, so the second point is ignored",
    remedy: "delete the second point",
};
const BACK: Flaw = Flaw {
    what: "a border turns back on itself, so its length may be wrong",
    remedy: "correct the point at which it turns back",
};
const CROSSED: Flaw = Flaw {
    what: "its borders cross, so its length and its width may be wrong",
    remedy: "correct the point that lies on the wrong side of the other border",
};

/// The place of a border without a length; `None` if it has no points, or one of them is nowhere.
fn only_point(border: &[Point]) -> Option<Point> {
    let is_there = |it: &Point| it.x.is_finite() && it.y.is_finite() && it.z.is_finite();
    border.first().copied().filter(|_| border.iter().all(is_there))
}

/// A line like `other`, but so small that it lies at `point`.
fn reduced(other: &Polyline, point: Point) -> Result<Polyline, Flaw> {
    let points = other.points().iter().map(|it| point.towards(it, SCALE_OF_POINT));
    Polyline::new(points).ok_or(TOO_SHORT)
}

/// The line halfway between a line and a point.
fn halfway(line: &Polyline, point: Point) -> Option<Polyline> {
    Polyline::new(line.points().iter().map(|it| it.midpoint(&point)))
}

/// The line halfway between two borders.
fn centre(left: &Polyline, right: &Polyline) -> Result<Option<Polyline>, Flaw> {
    let centre = Polyline::between(left, right);
    let length = centre.as_ref().map_or(0.0, Polyline::length);
    if length < MINIMUM_SHARE * left.length().min(right.length()) { Err(OPPOSITE) } else { Ok(centre) }
}

/// Whether a border turns back somewhere.
fn turns_back(border: &Polyline) -> bool {
    let long = border.points().windows(2).filter(|it| it[0].distance(&it[1]) > JITTER);
    let headings: Vec<f64> = long.map(|it| (it[1].y - it[0].y).atan2(it[1].x - it[0].x)).collect();
    headings.windows(2).any(|it| turn(it[0], it[1]).abs() > TURNS_BACK)
}

/// Whether two borders cross, as far as the first [`CHECKED_PAIRS`] pairs of their segments show.
fn are_crossed(left: &Polyline, right: &Polyline) -> bool {
    let pairs = left.points().windows(2).flat_map(|a| right.points().windows(2).map(move |b| (a, b)));
    pairs.take(CHECKED_PAIRS).any(|(a, b)| lies_across(a, b) && lies_across(b, a))
}

/// Whether the ends of one segment lie on different sides of the line through another.
fn lies_across(segment: &[Point], line: &[Point]) -> bool {
    let (dx, dy) = (line[1].x - line[0].x, line[1].y - line[0].y);
    let side = |it: &Point| dx * (it.y - line[0].y) - dy * (it.x - line[0].x);
    let (from, to) = (side(&segment[0]), side(&segment[1]));
    from * to < 0.0 && from.abs().min(to.abs()) > TOUCH * line[0].distance(&line[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(length: f64, y: f64) -> Vec<Point> {
        points(&[(0.0, y), (length, y)])
    }

    fn points(points: &[(f64, f64)]) -> Vec<Point> {
        points.iter().map(|(x, y)| Point::new(*x, *y, 0.0)).collect()
    }

    #[test]
    fn a_lane_has_a_centre_line_as_long_as_its_borders() {
        let shape = Shape::between(&line(12.0, 3.5), &line(12.0, 0.0)).unwrap();
        assert_eq!((shape.centre.length(), shape.flaws), (12.0, vec![]));
    }

    #[test]
    fn lanes_of_absurd_length_are_flawed() {
        let what = |left: &[Point], right: &[Point]| Shape::between(left, right).unwrap_err();
        let nowhere = points(&[(0.0, 0.0), (1.0, f64::NAN)]);
        assert_eq!(what(&[], &line(1.0, 0.0)), LEFT_NOWHERE);
        assert_eq!(what(&line(1.0, 0.0), &nowhere), RIGHT_NOWHERE);
        assert_eq!(what(&line(0.0, 3.5), &line(0.009, 0.0)), NO_LENGTH);
        assert_eq!(what(&line(0.015, 3.5), &line(0.009, 0.0)), TOO_SHORT);
        assert_eq!(what(&line(20_001.0, 3.5), &line(10.0, 0.0)), TOO_LONG);
        let turned = points(&[(200.0, 3.5), (0.0, 3.5)]);
        assert_eq!(what(&turned, &line(200.0, 0.0)), OPPOSITE);
    }

    #[test]
    fn a_border_may_be_one_point() {
        let bend = points(&[(0.0, 4.0), (2.0, 3.4), (3.4, 2.0), (4.0, 0.0)]);
        for inner in [points(&[(0.0, 0.0)]), line(0.0, 0.0)] {
            let shape = Shape::between(&bend, &inner).unwrap();
            let outer = Polyline::new(bend.iter().copied()).unwrap();
            assert!((shape.centre.length() - 0.5 * outer.length()).abs() < 1e-9);
            assert!(shape.right.points().iter().all(|it| it.distance(&inner[0]) < 0.01));
            assert_eq!(shape.flaws, [POINT]);
            let mirrored: Vec<Point> = bend.iter().map(|it| Point::new(it.x, -it.y, 0.0)).collect();
            assert_eq!(Shape::between(&inner, &mirrored).unwrap().centre.length(), shape.centre.length());
        }
    }

    #[test]
    fn odd_borders_are_noted() {
        let odd = |left: &[(f64, f64)]| Shape::between(&points(left), &line(200.0, 0.0)).unwrap();
        assert_eq!(odd(&[(0.0, 3.5), (100.0, 3.5), (100.0, 3.5), (200.0, 3.5)]).flaws, [REPEATED]);
        let spike = odd(&[(0.0, 3.5), (100.0, 3.5), (110.0, -0.1), (120.0, 3.5), (200.0, 3.5)]);
        assert_eq!(spike.flaws, [CROSSED]);
        assert!((spike.centre.length() - 200.0).abs() < 2.0);
        assert_eq!(odd(&[(0.0, 3.5), (100.0, 3.5), (99.0, 3.6), (200.0, 3.5)]).flaws, [BACK]);
        assert_eq!(odd(&[(0.0, 3.5), (100.0, 3.5), (99.7, 3.5), (200.0, 3.5)]).flaws, []);
        // Lanes that open from a point touch there.
        assert_eq!(odd(&[(0.0, 0.0), (100.0, 3.5), (200.0, 3.5)]).flaws, []);
    }
}
