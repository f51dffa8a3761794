//! The positions of a map's nodes in its local metric frame.

use laneweave_network::Point;

use super::osm::{Document, Node, Tags};
use super::projection::Utm;
use crate::error::MapError;
use crate::problem::Problem;
use crate::shape::MAXIMUM_COORDINATE;
use crate::xml::number;

/// The kind of coordinates that is used for all nodes of a map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Frame {
    /// The tags `local_x` and `local_y` [m].
    Local,
    /// The attributes `x` and `y` [m].
    Metric,
    /// Latitude and longitude, projected.
    Projected(Utm),
}

impl Frame {
    /// The first frame in the order above in which all nodes have coordinates, and its geographic
    /// origin [°]: `origin`, or else the place of the first node, rounded to 0.1°.
    ///
    /// # Errors
    /// If `origin` is no place that the projection covers.
    pub(super) fn of(
        document: &Document,
        origin: Option<(f64, f64)>,
        problems: &mut Vec<Problem>,
    ) -> Result<(Frame, Option<(f64, f64)>), MapError> {
        let nodes = || document.nodes.iter();
        let is_local = |it: &Node| {
            let tags = document.tags(it.tags);
            tags.get("local_x").is_some() && tags.get("local_y").is_some()
        };
        let is_metric = |it: &Node| it.x.get().is_some() && it.y.get().is_some();
        if nodes().all(is_local) {
            return Ok((Frame::Local, None));
        }
        // Most nodes have these coordinates, but not all: the others were forgotten.
        let local = nodes().filter(|it| is_local(it)).count();
        if let Some(first) = nodes().find(|it| !is_local(it)).filter(|_| 2 * local > document.nodes.len()) {
            problems.push(Problem {
                element: format!("node {}", first.id),
                line: Some(first.line as usize),
                what: format!(
                    "it is the first of {} nodes without local_x and local_y, so those of the others are not used",
                    document.nodes.len() - local
                ),
                remedy: "give all nodes local_x and local_y, or none".into(),
            });
        }
        if nodes().all(is_metric) {
            return Ok((Frame::Metric, None));
        }
        // Adding zero leaves no negative zero.
        let rounded = |degrees: f64| (degrees * 10.0).round() / 10.0 + 0.0;
        let mut places = nodes().filter_map(|it| Some((rounded(it.lat.get()?), rounded(it.lon.get()?))));
        let origin = origin.or_else(|| places.find(|at| Utm::around(at.0, at.1).is_some()));
        let origin = origin.unwrap_or((0.0, 0.0));
        let utm = Utm::around(origin.0, origin.1).ok_or(MapError::Origin(origin.0, origin.1))?;
        Ok((Frame::Projected(utm), Some(origin)))
    }

    /// The position of a node with these tags; `None` if its coordinates are missing, unreadable or out of range.
    /// Without a height it lies at zero.
    pub(super) fn place(&self, node: &Node, tags: Tags) -> Option<Point> {
        let tag = |key| tags.get(key).map(number);
        let (x, y) = match self {
            Frame::Local => (tag("local_x")?, tag("local_y")?),
            Frame::Metric => (node.x.get()?, node.y.get()?),
            Frame::Projected(utm) => utm.forward(node.lat.get()?, node.lon.get()?)?,
        };
        let z = tag("ele").or(node.ele.get()).unwrap_or(0.0);
        let in_range = [x, y, z].iter().all(|it| it.abs() <= MAXIMUM_COORDINATE);
        in_range.then(|| Point::new(x, y, z))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::lanelet2::osm::{Coordinate, with_tags};
    use crate::format::lanelet2::parse::parse;

    const NODE: &str = "<node id='1' lat='49.04' lon='8.44' x='1' y='2' ele='3'>";
    const LOCAL: &str = "<tag k='local_x' v='4'/><tag k='local_y' v='5'/><tag k='ele' v='6'/>";

    /// The frame of nodes, its origin, and the position of the last node.
    fn frame(nodes: &str) -> (Frame, Option<(f64, f64)>, Option<Point>) {
        let text = format!("<osm>{nodes}</osm>");
        let document = parse(text.as_bytes(), &mut Vec::new()).unwrap();
        let (frame, origin) = Frame::of(&document, None, &mut Vec::new()).unwrap();
        let last = document.nodes.last().unwrap();
        (frame, origin, frame.place(last, document.tags(last.tags)))
    }

    #[test]
    fn local_coordinates_come_first_if_all_nodes_have_them() {
        let local = format!("{NODE}{LOCAL}</node>");
        assert_eq!(frame(&local), (Frame::Local, None, Some(Point::new(4.0, 5.0, 6.0))));
        let mixed = format!("{local}{NODE}</node>");
        assert_eq!(frame(&mixed), (Frame::Metric, None, Some(Point::new(1.0, 2.0, 3.0))));
    }

    #[test]
    fn a_node_that_lacks_what_the_others_have_is_a_problem() {
        let text = format!("<osm>{NODE}{LOCAL}</node>\n{NODE}{LOCAL}</node>\n{NODE}</node></osm>");
        let document = parse(text.as_bytes(), &mut Vec::new()).unwrap();
        let mut problems = Vec::new();
        assert_eq!(Frame::of(&document, None, &mut problems).unwrap().0, Frame::Metric);
        assert!(
            problems[0]
                .to_string()
                .starts_with("node 1 (line 3): it is the first of 1 nodes without local_x")
        );
    }

    #[test]
    fn without_metric_coordinates_places_are_projected() {
        let (_, origin, at) = frame("<node id='1' lat='49.04' lon='8.44'/>");
        assert_eq!(origin, Some((49.0, 8.4)));
        let at = at.unwrap();
        assert!((4000.0..5000.0).contains(&at.y) && (2500.0..3500.0).contains(&at.x), "{at:?}");
        assert_eq!(at.z, 0.0);
    }

    #[test]
    fn an_origin_off_the_earth_is_refused() {
        let document = parse(b"<osm><node id='1'/></osm>", &mut Vec::new()).unwrap();
        let error = Frame::of(&document, Some((91.0, 0.0)), &mut Vec::new()).unwrap_err();
        assert!(error.to_string().starts_with("the origin (91, 0) is not a latitude"));
    }

    #[test]
    fn points_that_are_no_place_have_none() {
        let none = Coordinate::NONE;
        let unreadable = Coordinate::new(f64::NAN);
        for (x, ele) in [(f64::NAN, none), (5e7, none), (f64::INFINITY, none), (0.0, unreadable)] {
            let node = Node { x: Coordinate::new(x), y: Coordinate::new(0.0), ele, ..Node::default() };
            assert_eq!(with_tags([], |tags| Frame::Metric.place(&node, tags)), None);
        }
        assert_eq!(with_tags([], |tags| Frame::Metric.place(&Node::default(), tags)), None);
    }
}
