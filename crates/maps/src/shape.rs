//! The shape of one lane: two borders and the centre line between them.

use laneweave_network::Polyline;

/// Coordinates beyond this are taken as errors [m].
pub(crate) const MAXIMUM_COORDINATE: f64 = 4.1e7;

/// Borders and centre line of a lane that can be driven.
#[derive(Debug)]
pub(crate) struct Shape {
    pub(crate) left: Polyline,
    pub(crate) right: Polyline,
    pub(crate) centre: Polyline,
}

/// Why two borders give no lane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Flaw {
    pub(crate) what: &'static str,
    pub(crate) remedy: &'static str,
}

/// Minimum length of the centre line [m].
const MINIMUM_LENGTH: f64 = 0.01;

/// Maximum length of a lane; a longer one has a point that is far off [m].
const MAXIMUM_LENGTH: f64 = 20_000.0;

impl Shape {
    /// The lane between two borders that run in its direction of travel.
    pub(crate) fn between(left: Option<Polyline>, right: Option<Polyline>) -> Result<Shape, Flaw> {
        const NO_LINE: &str = "draw it through at least two different points with finite coordinates";
        let left = left.ok_or(Flaw { what: "its left border has no length", remedy: NO_LINE })?;
        let right = right.ok_or(Flaw { what: "its right border has no length", remedy: NO_LINE })?;
        // The borders are checked, too, because the time for the centre line grows with them.
        if left.length().max(right.length()) > MAXIMUM_LENGTH {
            return Err(Flaw {
                what: "it is longer than 20 km",
                remedy: "correct the point that is far away, or split the lanelet",
            });
        }
        let centre = Polyline::between(&left, &right).filter(|it| it.length() >= MINIMUM_LENGTH);
        let centre = centre
            .ok_or(Flaw { what: "it is shorter than 1 cm", remedy: "correct its borders or delete it" })?;
        Ok(Shape { left, right, centre })
    }
}

#[cfg(test)]
mod tests {
    use laneweave_network::Point;

    use super::*;

    fn line(length: f64, y: f64) -> Option<Polyline> {
        Polyline::new([Point::new(0.0, y, 0.0), Point::new(length, y, 0.0)])
    }

    #[test]
    fn a_lane_has_a_centre_line_as_long_as_its_borders() {
        assert_eq!(Shape::between(line(12.0, 3.5), line(12.0, 0.0)).unwrap().centre.length(), 12.0);
    }

    #[test]
    fn lanes_of_absurd_length_are_flawed() {
        let what = |left, right| Shape::between(left, right).unwrap_err().what;
        assert_eq!(what(None, line(1.0, 0.0)), "its left border has no length");
        assert_eq!(what(line(1.0, 0.0), None), "its right border has no length");
        assert_eq!(what(line(0.009, 3.5), line(0.009, 0.0)), "it is shorter than 1 cm");
        assert_eq!(what(line(20_001.0, 3.5), line(10.0, 0.0)), "it is longer than 20 km");
        // Borders in opposite directions leave no centre line.
        assert_eq!(what(line(5.0, 0.0).map(|it| it.reversed()), line(5.0, 0.0)), "it is shorter than 1 cm");
    }
}
