//! From OSM elements to a drawing: the lanelets that vehicles may use, with the borders and points they need.

use laneweave_network::Point;
use rayon::prelude::*;

use super::lookup::Lookup;
use super::orientation::reversals;
use super::osm::{Document, Relation, Way};
use super::regulation::rules;
use super::rules::{self, Flaw};
use super::sharing::{MAXIMUM_SHARING, Sharing};
use super::speed::SpeedRules;
use crate::contents::Contents;
use crate::drawing::{Border, Drawing, Edge, Lane};
use crate::options::ReadOptions;
use crate::problem::{BORDERS, Problem};

/// The drawing of the document in `lookup`. Its points are the nodes, used or not.
pub(super) fn draw(
    document: &Document,
    lookup: Lookup,
    options: &ReadOptions,
    contents: &mut Contents,
    problems: &mut Vec<Problem>,
) -> Drawing {
    let driving_side = options.driving_side.or(document.driving_side).unwrap_or_default();
    let rules = rules(document, &lookup, problems);
    let drawing = Drawing { points: Vec::new(), borders: Vec::new(), lanes: Vec::new(), rules, driving_side };
    let (borders, shared) = (vec![NONE; document.ways.len()], Sharing::default());
    let mut draft = Draft { document, lookup: &lookup, drawing, borders, shared };
    let mut found: Vec<(&Relation, Result<[u32; 2], Flaw>)> = Vec::new();
    for relation in document.relations_of_type("lanelet") {
        let tags = document.tags(relation.tags);
        problems.extend(
            rules::flaws_of_lanelet(tags)
                .into_iter()
                .map(|flaw| problem("lanelet", relation.id, relation.line, flaw)),
        );
        if !rules::classes(tags).is_empty() && lookup.is_first(relation) {
            found.push((relation, draft.borders_of(relation)));
        }
    }
    let lacking = found.iter().filter(|(relation, _)| draft.lacks_a_border(relation)).count();
    problems.extend(without_borders(lacking, found.len()));
    let oriented =
        |(relation, borders): (_, Result<_, Flaw>)| (relation, borders.map(|it| draft.oriented(it)));
    let found: Vec<(&Relation, Result<[Edge; 2], Flaw>)> = found.into_par_iter().map(oriented).collect();
    let speed_rules = SpeedRules::of(document, &lookup);
    let mut ends = Ends::default();
    for (relation, edges) in found {
        let of_lanelet = |flaw: Flaw| problem("lanelet", relation.id, relation.line, flaw);
        let tags = document.tags(relation.tags);
        let is_two_way = rules::is_two_way(tags);
        if is_two_way {
            let what = "it may be used in both directions; simulated traffic uses the forward one only";
            problems.push(of_lanelet((what.into(), "draw a lanelet for each direction")));
        }
        match edges.and_then(|edges| ends.admit(&draft.drawing, edges)) {
            Ok([left, right]) => {
                let limit_kmh =
                    speed_rules.limit(relation, options.law, &mut contents.limits_of_law, problems);
                let line = Some(relation.line as usize);
                let (id, classes, surroundings) =
                    (relation.id.into(), rules::classes(tags), rules::surroundings(tags));
                let lane = Lane { id, line, left, right, classes, is_two_way, surroundings, limit_kmh };
                draft.drawing.lanes.push(lane);
            }
            Err((what, remedy)) => problems.push(of_lanelet((format!("{what}, so it is left out"), remedy))),
        }
    }
    let used = document.ways.iter().zip(&draft.borders).filter(|(_, place)| **place != NONE);
    for (way, _) in used {
        let flaws = rules::flaws_of_border(document.tags(way.tags));
        problems.extend(flaws.into_iter().map(|flaw| problem("way", way.id, way.line, flaw)));
    }
    let drawing = draft.drawing;
    Drawing { points: lookup.into_points(), ..drawing }
}

/// The summary before the list of `lacking` lanelets without a border, of so many; a single one needs none.
fn without_borders(lacking: usize, lanelets: usize) -> Option<Problem> {
    (lacking > 1).then(|| Problem {
        element: BORDERS.into(),
        line: None,
        what: format!("{lacking} of {lanelets} lanelets have no left or right border, so they are left out"),
        remedy: "export the map again, with a way in the role left and one in the role right of each lanelet"
            .into(),
    })
}

fn problem(kind: &str, id: i64, line: u32, (what, remedy): Flaw) -> Problem {
    Problem { element: format!("{kind} {id}"), line: Some(line as usize), what, remedy: remedy.into() }
}

/// The indices in the drawing of elements of the document.
const NONE: u32 = u32::MAX;

/// A drawing under construction, lane by lane, with the indices of what was already drawn.
struct Draft<'a> {
    document: &'a Document<'a>,
    lookup: &'a Lookup<'a>,
    drawing: Drawing,
    /// For each way of the document its index in the drawing.
    borders: Vec<u32>,
    /// For each way the number of lanelets that it borders, by its index in the document.
    shared: Sharing<usize>,
}

impl Draft<'_> {
    /// The left and the right border of a lanelet.
    fn borders_of(&mut self, relation: &Relation) -> Result<[u32; 2], Flaw> {
        let [left, right] = [self.way(relation, "left")?, self.way(relation, "right")?];
        // This comes before everything that takes time with the length of a border.
        if [left, right].map(|it| self.shared.admits(it)) != [true; 2] {
            return Err(drawn_twice());
        }
        Ok([self.border(left)?, self.border(right)?])
    }

    /// The borders of a lanelet, run in its direction of travel.
    fn oriented(&self, [left, right]: [u32; 2]) -> [Edge; 2] {
        let line = |border: u32| -> Vec<Point> {
            let points = &self.drawing.borders[border as usize].points;
            points.iter().filter_map(|it| self.lookup.place(*it as usize)).collect()
        };
        let (left_reversed, right_reversed) = reversals(&line(left), &line(right));
        [Edge { border: left, reversed: left_reversed }, Edge { border: right, reversed: right_reversed }]
    }

    /// Whether no way borders a lanelet on one of its sides.
    fn lacks_a_border(&self, relation: &Relation) -> bool {
        let is_there =
            |side| self.document.members(relation, "way", side).any(|it| self.lookup.way(it).is_some());
        !(is_there("left") && is_there("right"))
    }

    /// The way that borders a lanelet on `side`.
    fn way(&self, relation: &Relation, side: &'static str) -> Result<usize, Flaw> {
        let mut members = self.document.members(relation, "way", side);
        match (members.next(), members.next()) {
            (Some(id), None) => self.lookup.way(id).ok_or_else(|| {
                let what = format!("its {side} border is way {id}, which is missing");
                (what, "add the way, or refer to another")
            }),
            (None, _) => Err((format!("{side} border is missing"), "add a way in the role of that side")),
            (Some(_), Some(_)) => Err((format!("it has several {side} borders"), "merge them into one way")),
        }
    }

    fn border(&mut self, place: usize) -> Result<u32, Flaw> {
        if self.borders[place] != NONE {
            return Ok(self.borders[place]);
        }
        let way = &self.document.ways[place];
        let nodes = self.document.nodes_of(way);
        if nodes.is_empty() {
            let what = format!("its border, way {}, has no nodes", way.id);
            return Err((what, "draw the way through at least two nodes"));
        }
        let points = nodes.iter().map(|id| self.point(way, *id)).collect::<Result<_, _>>()?;
        let border = self.drawing.borders.len() as u32;
        let tags = self.document.tags(way.tags);
        let (paint, crossing) = (rules::paint(tags), rules::crossing(tags));
        self.drawing.borders.push(Border { points, paint, crossing });
        self.borders[place] = border;
        Ok(border)
    }

    fn point(&mut self, way: &Way, id: i64) -> Result<u32, Flaw> {
        let place = self.lookup.node(id).ok_or_else(|| {
            let what = format!("its border, way {}, runs through node {id}, which is missing", way.id);
            (what, "add the node, or remove it from the way")
        })?;
        if self.lookup.place(place).is_none() {
            let line = self.document.nodes[place].line;
            let what = format!("node {id} (line {line}) of its border has no geographic position");
            return Err((what, "give all nodes lat and lon, or all of them local_x and local_y"));
        }
        Ok(place as u32)
    }
}

/// The number of lanes that share a start, or an end.
#[derive(Default)]
struct Ends {
    starts: Sharing<(u32, u32)>,
    finishes: Sharing<(u32, u32)>,
}

impl Ends {
    fn admit(&mut self, drawing: &Drawing, [left, right]: [Edge; 2]) -> Result<[Edge; 2], Flaw> {
        let (start, finish) = (drawing.starts(left, right), drawing.finishes(left, right));
        let admitted = [self.starts.admits(start), self.finishes.admits(finish)] == [true; 2];
        if admitted { Ok([left, right]) } else { Err(drawn_twice()) }
    }
}

fn drawn_twice() -> Flaw {
    let what = format!("{MAXIMUM_SHARING} others share its start, its end or a border");
    (what, "delete lanelets that were drawn twice")
}
