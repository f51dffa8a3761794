//! A drawing as the elements of a Lanelet2 map.

use super::osm::{Coordinate, Document, Member, Node, Relation, Span, Way};
use super::projection::Utm;
use super::rules::line_subtype;
use crate::drawing::{Drawing, Lane};

/// Where the origin of a drawing is put on the earth: latitude and longitude [°].
const ORIGIN: (f64, f64) = (49.0, 8.4);

/// The elements of a Lanelet2 map with the roads of this drawing.
///
/// Nodes have exact metric coordinates (`local_x`, `local_y`, `ele`), and latitude and longitude for other programs,
/// rounded to about a micrometre; these mean little further than some hundred kilometres from the origin. Lanelets keep
/// their ids; borders and points get those that come after.
pub fn compose(drawing: &Drawing) -> Document<'static> {
    let mut document = Document { driving_side: Some(drawing.driving_side), ..Document::default() };
    let first_border = 1 + drawing.lanes.iter().map(|it| it.id).max().unwrap_or(0);
    let first_point = first_border + drawing.borders.len() as i64;
    let utm = Utm::around(ORIGIN.0, ORIGIN.1);
    for (point, id) in drawing.points.iter().zip(first_point..) {
        let (latitude, longitude) = utm.map_or(ORIGIN, |it| it.inverse(point.x, point.y));
        let [x, y, z] = [point.x, point.y, point.z].map(|it| it.to_string());
        let tags = document.keep_tags(&[("local_x", &x), ("local_y", &y), ("ele", &z)]);
        let [lat, lon] = [latitude, longitude].map(|it| Coordinate::new(rounded(it)));
        document.nodes.push(Node { id, lat, lon, tags, ..Node::default() });
    }
    for (border, id) in drawing.borders.iter().zip(first_border..) {
        let start = document.references.len();
        document.references.extend(border.points.iter().map(|it| first_point + i64::from(*it)));
        let nodes = Span::since(start, document.references.len());
        let tags = document.keep_tags(&[("type", &"line_thin"), ("subtype", &line_subtype(border.crossing))]);
        document.ways.push(Way { id, nodes, tags, ..Way::default() });
    }
    for lane in &drawing.lanes {
        document.lane(lane, first_border);
    }
    document
}

/// An angle to eleven decimals, a micrometre on the ground.
fn rounded(degrees: f64) -> f64 {
    (degrees * 1e11).round() / 1e11
}

impl Document<'static> {
    fn lane(&mut self, lane: &Lane, first_border: i64) {
        let start = self.members.len();
        for (edge, role) in [(lane.left, "left"), (lane.right, "right")] {
            let (kind, role) = (self.keep("way"), self.keep(role));
            self.members.push(Member { id: first_border + i64::from(edge.border), kind, role });
        }
        let members = Span::since(start, self.members.len());
        let one_way = if lane.is_two_way { "no" } else { "yes" };
        let tags = self.keep_tags(&[
            ("type", &"lanelet"),
            ("subtype", &"highway"),
            ("location", &"nonurban"),
            ("one_way", &one_way),
            ("participant:vehicle", &"yes"),
            ("speed_limit", &lane.limit_kmh),
        ]);
        self.relations.push(Relation { id: lane.id, members, tags, ..Relation::default() });
    }
}
