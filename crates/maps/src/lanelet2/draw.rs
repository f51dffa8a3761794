//! From OSM elements to a drawing: the lanelets that cars may use, with the borders and points they need.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use laneweave_network::Point;

use super::orientation::reversals;
use super::osm::{Document, Relation, Way};
use super::place::Frame;
use super::{rules, speed};
use crate::drawing::{Border, Drawing, Edge, Lane};
use crate::error::MapError;
use crate::format::ReadOptions;
use crate::problem::Problem;

/// No more lanelets than this share a border, a start or an end; the links between them grow with the square.
const MAXIMUM_SHARING: u32 = 32;

/// The drawing, and the geographic origin of its frame [°].
pub(super) fn draw(
    document: &Document,
    options: &ReadOptions,
    problems: &mut Vec<Problem>,
) -> Result<(Drawing, Option<(f64, f64)>), MapError> {
    let nodes = by_id(document.nodes.iter().map(|it| (it.id, it.line)), "node", problems);
    let ways = by_id(document.ways.iter().map(|it| (it.id, it.line)), "way", problems);
    let relations = by_id(document.relations.iter().map(|it| (it.id, it.line)), "relation", problems);
    let bordered = bordered(document, &ways, &relations, problems);
    let used = bordered.iter().flat_map(|it| it.borders).flat_map(|way| &document.ways[way].nodes);
    let used_nodes = used.filter_map(|id| Some(&document.nodes[*nodes.get(id)?]));
    let (frame, origin) = Frame::of(used_nodes, options.origin)?;

    let driving_side = options.driving_side.or(document.driving_side).unwrap_or_default();
    let drawing = Drawing { points: Vec::new(), borders: Vec::new(), lanes: Vec::new(), driving_side };
    let mut draft =
        Draft { document, nodes, frame, drawing, points: HashMap::new(), borders: HashMap::new() };
    let mut sharing = Sharing::default();
    for it in bordered {
        let lane = draft.lane(&it, |left, right| {
            let rule = |id| relations.get(&id).map(|it| &document.relations[*it]);
            let sign = |id| ways.get(&id).map(|it| &document.ways[*it].tags);
            let limit_kmh = speed::limit(it.relation, rule, sign, problems);
            Lane { id: it.relation.id, line: Some(it.relation.line), left, right, limit_kmh }
        });
        match lane.and_then(|lane| sharing.admit(&draft.drawing, &lane).map(|()| lane)) {
            Ok(lane) => draft.drawing.lanes.push(lane),
            Err((what, remedy)) => problems.push(left_out(it.relation, &what, remedy)),
        }
    }
    Ok((draft.drawing, origin))
}

/// A lanelet with its left and right border, places in [`Document::ways`].
struct Bordered<'a> {
    relation: &'a Relation,
    borders: [usize; 2],
}

/// What is wrong, and what mends it.
type Flaw = (String, &'static str);

/// Where each id stands; of several elements with the same id the first one counts.
fn by_id(
    elements: impl Iterator<Item = (i64, usize)>,
    kind: &str,
    problems: &mut Vec<Problem>,
) -> HashMap<i64, usize> {
    let mut places = HashMap::new();
    for (place, (id, line)) in elements.enumerate() {
        match places.entry(id) {
            Entry::Vacant(entry) => {
                entry.insert(place);
            }
            Entry::Occupied(_) => problems.push(Problem {
                element: format!("{kind} {id}"),
                line: Some(line),
                what: format!("another {kind} above has the same id, so this one is left out"),
                remedy: "give it an id of its own".into(),
            }),
        }
    }
    places
}

fn left_out(relation: &Relation, what: &str, remedy: &str) -> Problem {
    Problem {
        element: format!("lanelet {}", relation.id),
        line: Some(relation.line),
        what: format!("{what}, so it is left out"),
        remedy: remedy.into(),
    }
}

/// The lanelets that cars may use and that have two borders.
fn bordered<'a>(
    document: &'a Document,
    ways: &HashMap<i64, usize>,
    relations: &HashMap<i64, usize>,
    problems: &mut Vec<Problem>,
) -> Vec<Bordered<'a>> {
    let mut found = Vec::new();
    let is_first = |it: &Relation| {
        relations.get(&it.id).is_some_and(|place| std::ptr::eq(&document.relations[*place], it))
    };
    for relation in document.lanelets().filter(|it| rules::is_for_cars(&it.tags) && is_first(it)) {
        let borders = border(relation, "left", ways)
            .and_then(|left| border(relation, "right", ways).map(|right| [left, right]));
        match borders {
            Ok(borders) => found.push(Bordered { relation, borders }),
            Err((what, remedy)) => problems.push(left_out(relation, &what, remedy)),
        }
        if rules::is_two_way(&relation.tags) {
            problems.push(Problem {
                element: format!("lanelet {}", relation.id),
                line: Some(relation.line),
                what: "it may be used in both directions; only the forward one is".into(),
                remedy: "draw a lanelet for each direction".into(),
            });
        }
    }
    found
}

/// The way that borders a lanelet on `side`.
fn border(relation: &Relation, side: &str, ways: &HashMap<i64, usize>) -> Result<usize, Flaw> {
    let mut members = relation.members("way", side);
    match (members.next(), members.next()) {
        (Some(id), None) => ways.get(&id).copied().ok_or_else(|| {
            (format!("its {side} border is way {id}, which is missing"), "add the way or name another")
        }),
        (None, _) => Err((format!("{side} border is missing"), "add a way in the role of that side")),
        (Some(_), Some(_)) => Err((format!("it has several {side} borders"), "join them to one way")),
    }
}

/// A drawing that grows lane by lane, with the places of what was drawn already.
struct Draft<'a> {
    document: &'a Document,
    nodes: HashMap<i64, usize>,
    frame: Frame,
    drawing: Drawing,
    /// Node id to place in the drawing.
    points: HashMap<i64, u32>,
    /// Place of a way in the document to place in the drawing.
    borders: HashMap<usize, u32>,
}

impl Draft<'_> {
    fn lane(&mut self, it: &Bordered, lane: impl FnOnce(Edge, Edge) -> Lane) -> Result<Lane, Flaw> {
        let [left, right] = it.borders;
        let (left, right) = (self.border(left)?, self.border(right)?);
        let line = |border: u32| -> Vec<Point> {
            let points = &self.drawing.borders[border as usize].points;
            points.iter().map(|it| self.drawing.points[*it as usize]).collect()
        };
        let (left_reversed, right_reversed) = reversals(&line(left), &line(right));
        let left = Edge { border: left, reversed: left_reversed };
        Ok(lane(left, Edge { border: right, reversed: right_reversed }))
    }

    fn border(&mut self, place: usize) -> Result<u32, Flaw> {
        if let Some(border) = self.borders.get(&place) {
            return Ok(*border);
        }
        let way = &self.document.ways[place];
        if way.nodes.len() < 2 {
            let what = format!("its border, way {}, has fewer than two nodes", way.id);
            return Err((what, "draw the way through at least two nodes"));
        }
        let points = way.nodes.iter().map(|id| self.point(way, *id)).collect::<Result<_, _>>()?;
        let border = self.drawing.borders.len() as u32;
        self.drawing.borders.push(Border { points, crossing: rules::crossing(&way.tags) });
        self.borders.insert(place, border);
        Ok(border)
    }

    fn point(&mut self, way: &Way, id: i64) -> Result<u32, Flaw> {
        if let Some(point) = self.points.get(&id) {
            return Ok(*point);
        }
        let node = self.nodes.get(&id).map(|it| &self.document.nodes[*it]).ok_or_else(|| {
            let what = format!("its border, way {}, runs through node {id}, which is missing", way.id);
            (what, "add the node or take it out of the way")
        })?;
        let at = self.frame.place(node).ok_or_else(|| {
            let what = format!("node {id} (line {}) of its border has no position on earth", node.line);
            (what, "give all nodes lat and lon, or all of them local_x and local_y")
        })?;
        let point = self.drawing.points.len() as u32;
        self.drawing.points.push(at);
        self.points.insert(id, point);
        Ok(point)
    }
}

/// How many lanes share a border, a start, or an end.
#[derive(Default)]
struct Sharing {
    borders: HashMap<u32, u32>,
    starts: HashMap<(u32, u32), u32>,
    ends: HashMap<(u32, u32), u32>,
}

impl Sharing {
    fn admit(&mut self, drawing: &Drawing, lane: &Lane) -> Result<(), Flaw> {
        let (left, right) = (drawing.ends(lane.left), drawing.ends(lane.right));
        let mut is_full = false;
        let mut count = |count: &mut u32| {
            is_full |= *count >= MAXIMUM_SHARING;
            *count += 1;
        };
        count(self.borders.entry(lane.left.border).or_default());
        count(self.borders.entry(lane.right.border).or_default());
        count(self.starts.entry((left.0, right.0)).or_default());
        count(self.ends.entry((left.1, right.1)).or_default());
        if is_full {
            let what = format!("{MAXIMUM_SHARING} others share its start, its end or a border");
            return Err((what, "delete lanelets that were drawn twice"));
        }
        Ok(())
    }
}
