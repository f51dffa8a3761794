//! A drawing as the elements of a Lanelet2 map.

use std::collections::HashMap;
use std::fmt::Display;

use laneweave_network::{Id, Point};

use super::osm::{Coordinate, Document, Member, Node, Relation, Span, Way};
use super::projection::Utm;
use super::rules::{line_subtype, participants, subtype_and_location};
use crate::drawing::{Border, Drawing, Lane, Paint};
use crate::rule::{Rule, RuleKind};

/// The geographic place of the origin of a drawing: latitude and longitude [°].
const ORIGIN: (f64, f64) = (49.0, 8.4);

/// The elements of a Lanelet2 map with the roads and rules of this drawing.
///
/// Nodes have exact metric coordinates (`local_x`, `local_y`, `ele`). For other programs they also have latitude and
/// longitude, rounded to about a micrometre; these are meaningless more than some hundred kilometres from the origin.
/// Lanelets and rules keep ids that are numbers; everything else gets the ids after those.
pub fn compose(drawing: &Drawing) -> Document<'static> {
    let document = Document { driving_side: Some(drawing.driving_side), ..Document::default() };
    let numbers = Numbers::of(drawing);
    let first_border = numbers.next;
    let first_point = first_border + drawing.borders.len() as i64;
    let next_id = first_point + drawing.points.len() as i64;
    let mut composer = Composer { document, utm: Utm::around(ORIGIN.0, ORIGIN.1), numbers, next_id };
    for (point, id) in drawing.points.iter().zip(first_point..) {
        composer.node(id, point);
    }
    for (border, id) in drawing.borders.iter().zip(first_border..) {
        composer.border(id, border, first_point);
    }
    let mut obeyed: HashMap<Id, Vec<Id>> = HashMap::new();
    for rule in &drawing.rules {
        rule.lanelets.iter().for_each(|it| obeyed.entry(*it).or_default().push(rule.id));
    }
    for lane in &drawing.lanes {
        composer.lane(lane, first_border, obeyed.get(&lane.id).map_or(&[], |it| it));
    }
    for rule in &drawing.rules {
        composer.rule(rule);
    }
    composer.document
}

/// An angle to eleven decimals, a micrometre on the ground.
fn rounded(degrees: f64) -> f64 {
    (degrees * 1e11).round() / 1e11
}

/// The number of each lanelet and rule.
struct Numbers {
    of_texts: HashMap<Id, i64>,
    /// The first number that none of them has.
    next: i64,
}

impl Numbers {
    fn of(drawing: &Drawing) -> Numbers {
        let ids = || drawing.lanes.iter().map(|it| it.id).chain(drawing.rules.iter().map(|it| it.id));
        let mut next = 1 + ids().filter_map(Id::number).max().unwrap_or(0);
        let mut of_texts = HashMap::new();
        for text in ids().filter(|it| it.number().is_none()) {
            of_texts.insert(text, next);
            next += 1;
        }
        Numbers { of_texts, next }
    }

    /// The number of a lanelet or rule; 0 of one that is not there.
    fn get(&self, id: Id) -> i64 {
        id.number().or_else(|| self.of_texts.get(&id).copied()).unwrap_or_default()
    }
}

/// A document under construction.
struct Composer {
    document: Document<'static>,
    utm: Option<Utm>,
    numbers: Numbers,
    /// The id of the next element that has none of its own.
    next_id: i64,
}

impl Composer {
    fn node(&mut self, id: i64, point: &Point) {
        let (latitude, longitude) = self.utm.map_or(ORIGIN, |it| it.inverse(point.x, point.y));
        let [x, y, z] = [point.x, point.y, point.z].map(|it| it.to_string());
        let tags = self.document.keep_tags(&[("local_x", &x), ("local_y", &y), ("ele", &z)]);
        let [lat, lon] = [latitude, longitude].map(|it| Coordinate::new(rounded(it)));
        self.document.nodes.push(Node { id, lat, lon, tags, ..Node::default() });
    }

    fn border(&mut self, id: i64, border: &Border, first_point: i64) {
        let nodes = border.points.iter().map(|it| first_point + i64::from(*it));
        match border.paint {
            Paint::Painted => {
                let subtype = line_subtype(border.crossing);
                self.way(id, nodes, &[("type", &"line_thin"), ("subtype", &subtype)]);
            }
            Paint::Virtual => self.way(id, nodes, &[("type", &"virtual")]),
        }
    }

    fn way(&mut self, id: i64, nodes: impl Iterator<Item = i64>, tags: &[(&str, &dyn Display)]) {
        let start = self.document.references.len();
        self.document.references.extend(nodes);
        let nodes = Span::since(start, self.document.references.len());
        let tags = self.document.keep_tags(tags);
        self.document.ways.push(Way { id, nodes, tags, ..Way::default() });
    }

    /// Adds a way through points of its own, and returns its id.
    fn own_way(&mut self, points: &[Point], tags: &[(&str, &dyn Display)]) -> i64 {
        let first = self.next_id;
        for (point, id) in points.iter().zip(first..) {
            self.node(id, point);
        }
        let id = first + points.len() as i64;
        self.next_id = id + 1;
        self.way(id, first..id, tags);
        id
    }

    fn lane(&mut self, lane: &Lane, first_border: i64, rules: &[Id]) {
        let border = |border: u32| first_border + i64::from(border);
        let sides = [("way", border(lane.left.border), "left"), ("way", border(lane.right.border), "right")];
        let rules: Vec<_> =
            rules.iter().map(|it| ("relation", self.numbers.get(*it), "regulatory_element")).collect();
        let one_way = if lane.is_two_way { "no" } else { "yes" };
        let (subtype, location) = subtype_and_location(lane.surroundings);
        let participants = participants(lane.classes);
        let mut tags: Vec<(&str, &dyn Display)> =
            vec![("type", &"lanelet"), ("subtype", &subtype), ("location", &location), ("one_way", &one_way)];
        tags.extend(participants.iter().map(|it| (it.as_str(), &"yes" as &dyn Display)));
        tags.push(("speed_limit", &lane.limit_kmh));
        self.relation(self.numbers.get(lane.id), sides.into_iter().chain(rules), &tags);
    }

    fn rule(&mut self, rule: &Rule) {
        let (subtype, sign): (&str, &[(&str, &dyn Display)]) = match &rule.kind {
            RuleKind::TrafficLight => {
                ("traffic_light", &[("type", &"traffic_light"), ("subtype", &"red_yellow_green")])
            }
            RuleKind::StopSign => ("traffic_sign", &[("type", &"traffic_sign"), ("subtype", &"stop_sign")]),
            other => (other.name(), &[("type", &"traffic_sign")]),
        };
        let mut members: Vec<(&str, i64, &str)> = Vec::new();
        for line in &rule.stop_lines {
            members.push(("way", self.own_way(line, &[("type", &"stop_line")]), "ref_line"));
        }
        for points in &rule.signs {
            members.push(("way", self.own_way(points, sign), "refers"));
        }
        let named: [(&[Id], &str); 2] = match &rule.kind {
            RuleKind::RightOfWay { first, yielding } => [(first, "right_of_way"), (yielding, "yield")],
            RuleKind::AllWayStop { lanelets } => [(lanelets, "yield"), (&[], "")],
            RuleKind::Crosswalk { lanelets } => [(lanelets, "refers"), (&[], "")],
            _ => [(&[], ""); 2],
        };
        for (lanelets, role) in named {
            members.extend(lanelets.iter().map(|it| ("relation", self.numbers.get(*it), role)));
        }
        let tags: [(&str, &dyn Display); 2] = [("type", &"regulatory_element"), ("subtype", &subtype)];
        self.relation(self.numbers.get(rule.id), members.into_iter(), &tags);
    }

    /// Adds a relation with members of a kind in a role.
    fn relation<'a>(
        &mut self,
        id: i64,
        members: impl Iterator<Item = (&'a str, i64, &'a str)>,
        tags: &[(&str, &dyn Display)],
    ) {
        let start = self.document.members.len();
        for (kind, id, role) in members {
            let (kind, role) = (self.document.keep(kind), self.document.keep(role));
            self.document.members.push(Member { id, kind, role });
        }
        let members = Span::since(start, self.document.members.len());
        let tags = self.document.keep_tags(tags);
        self.document.relations.push(Relation { id, members, tags, ..Relation::default() });
    }
}
