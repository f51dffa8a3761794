//! Where the nodes of a map lie in its local metric frame.

use laneweave_network::Point;

use super::osm::{Node, number};
use super::projection::Utm;
use crate::error::MapError;

/// Which of the coordinates that nodes may have are used, for all nodes of a map alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Frame {
    /// The tags `local_x` and `local_y` [m].
    Local,
    /// The attributes `x` and `y` [m].
    Metric,
    /// Latitude and longitude, projected.
    Projected(Utm),
}

/// Points further from the origin are none on earth [m].
const MAXIMUM_COORDINATE: f64 = 4.1e7;

impl Frame {
    /// The first frame in the order above in which all of `nodes` have coordinates, and its geographic origin
    /// [°].
    pub(super) fn of<'a>(
        nodes: impl Iterator<Item = &'a Node> + Clone,
        origin: Option<(f64, f64)>,
    ) -> Result<(Frame, Option<(f64, f64)>), MapError> {
        let all = |has: fn(&Node) -> bool| nodes.clone().all(has);
        if all(|it| it.tags.get("local_x").is_some() && it.tags.get("local_y").is_some()) {
            return Ok((Frame::Local, None));
        }
        if all(|it| it.x.is_some() && it.y.is_some()) {
            return Ok((Frame::Metric, None));
        }
        // Adding zero leaves no negative zero.
        let rounded = |degrees: f64| (degrees * 10.0).round() / 10.0 + 0.0;
        let mut places = nodes.filter_map(|it| Some((rounded(it.lat?), rounded(it.lon?))));
        let origin = origin.or_else(|| places.find(|at| Utm::around(at.0, at.1).is_some()));
        let origin = origin.unwrap_or((0.0, 0.0));
        let utm = Utm::around(origin.0, origin.1).ok_or(MapError::Origin(origin.0, origin.1))?;
        Ok((Frame::Projected(utm), Some(origin)))
    }

    /// Where `node` lies; `None` if its coordinates are missing, unreadable or out of range. Without a height
    /// it lies at zero.
    pub(super) fn place(&self, node: &Node) -> Option<Point> {
        let tag = |key| node.tags.get(key).map(number);
        let (x, y) = match self {
            Frame::Local => (tag("local_x")?, tag("local_y")?),
            Frame::Metric => (node.x?, node.y?),
            Frame::Projected(utm) => utm.forward(node.lat?, node.lon?)?,
        };
        let z = tag("ele").or(node.ele).unwrap_or(0.0);
        let in_range = [x, y, z].iter().all(|it| it.abs() <= MAXIMUM_COORDINATE);
        in_range.then(|| Point::new(x, y, z))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanelet2::osm::Tags;

    fn all_three() -> Node {
        Node {
            lat: Some(49.04),
            lon: Some(8.44),
            x: Some(1.0),
            y: Some(2.0),
            ele: Some(3.0),
            tags: Tags::from([("local_x", "4"), ("local_y", "5"), ("ele", "6")]),
            ..Node::default()
        }
    }

    fn frame(nodes: &[Node]) -> (Frame, Option<(f64, f64)>) {
        Frame::of(nodes.iter(), None).unwrap()
    }

    #[test]
    fn local_coordinates_come_first_if_all_nodes_have_them() {
        let nodes = [all_three(), Node { tags: Tags::default(), ..all_three() }];
        assert_eq!(frame(&nodes[..1]), (Frame::Local, None));
        assert_eq!(Frame::Local.place(&nodes[0]), Some(Point::new(4.0, 5.0, 6.0)));
        assert_eq!(frame(&nodes), (Frame::Metric, None));
        assert_eq!(Frame::Metric.place(&nodes[1]), Some(Point::new(1.0, 2.0, 3.0)));
    }

    #[test]
    fn without_metric_coordinates_places_are_projected() {
        let node = Node { lat: Some(49.04), lon: Some(8.44), ..Node::default() };
        let (frame, origin) = frame(std::slice::from_ref(&node));
        assert_eq!(origin, Some((49.0, 8.4)));
        let at = frame.place(&node).unwrap();
        assert!((4000.0..5000.0).contains(&at.y) && (2500.0..3500.0).contains(&at.x), "{at:?}");
        assert_eq!(at.z, 0.0);
    }

    #[test]
    fn an_origin_off_the_earth_is_refused() {
        let error = Frame::of([Node::default()].iter(), Some((91.0, 0.0))).unwrap_err();
        assert!(error.to_string().starts_with("the origin (91, 0) is no latitude"));
    }

    #[test]
    fn points_that_are_no_place_have_none() {
        for (x, ele) in [(f64::NAN, None), (5e7, None), (f64::INFINITY, None), (0.0, Some(f64::NAN))] {
            let node = Node { x: Some(x), y: Some(0.0), ele, ..Node::default() };
            assert_eq!(Frame::Metric.place(&node), None);
        }
        assert_eq!(Frame::Metric.place(&Node::default()), None);
    }
}
