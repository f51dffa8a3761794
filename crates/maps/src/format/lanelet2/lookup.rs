//! Elements by their ids, and the positions of nodes.

use hashbrown::HashMap;
use hashbrown::hash_map::Entry;
use laneweave_network::Point;
use rayon::prelude::*;

use super::osm::{Document, Node, Relation};
use super::place::Frame;
use crate::error::MapError;
use crate::problem::Problem;

/// Finds the elements of a document. Of several with the same id the first one counts.
pub(super) struct Lookup<'a> {
    document: &'a Document<'a>,
    nodes: HashMap<i64, u32>,
    ways: HashMap<i64, u32>,
    relations: HashMap<i64, u32>,
    /// The position of each node of the document; see [`Lookup::place`].
    points: Vec<Point>,
}

/// The position that stands for a missing one.
const NOWHERE: Point = Point { x: f64::NAN, y: f64::NAN, z: f64::NAN };

impl<'a> Lookup<'a> {
    /// Finds the elements of `document`; positions are relative to `origin` [°], or to one of its own. Elements that
    /// share an id become problems. Also returns the geographic origin, if the map is projected.
    ///
    /// # Errors
    /// If `origin` is no place that the projection covers.
    pub(super) fn new(
        document: &'a Document<'a>,
        origin: Option<(f64, f64)>,
        problems: &mut Vec<Problem>,
    ) -> Result<(Lookup<'a>, Option<(f64, f64)>), MapError> {
        let (frame, origin) = Frame::of(document, origin, problems)?;
        let place = |node: &Node| frame.place(node, document.tags(node.tags)).unwrap_or(NOWHERE);
        let (points, [nodes, ways, relations]) = rayon::join(
            || document.nodes.par_iter().map(place).collect(),
            || {
                [
                    by_id(document.nodes.iter().map(|it| (it.id, it.line)), "node", problems),
                    by_id(document.ways.iter().map(|it| (it.id, it.line)), "way", problems),
                    by_id(document.relations.iter().map(|it| (it.id, it.line)), "relation", problems),
                ]
            },
        );
        Ok((Lookup { document, nodes, ways, relations, points }, origin))
    }

    /// The index in the document of the node with this id.
    pub(super) fn node(&self, id: i64) -> Option<usize> {
        self.nodes.get(&id).map(|it| *it as usize)
    }

    /// The index in the document of the way with this id.
    pub(super) fn way(&self, id: i64) -> Option<usize> {
        self.ways.get(&id).map(|it| *it as usize)
    }

    /// The index in the document of the relation with this id.
    pub(super) fn relation(&self, id: i64) -> Option<usize> {
        self.relations.get(&id).map(|it| *it as usize)
    }

    /// Whether no relation before this one has its id.
    pub(super) fn is_first(&self, relation: &Relation) -> bool {
        self.relation(relation.id).is_some_and(|it| std::ptr::eq(&self.document.relations[it], relation))
    }

    /// The position of the node with this index in the document, if it has one on earth.
    pub(super) fn place(&self, node: usize) -> Option<Point> {
        Some(self.points[node]).filter(|it| !it.x.is_nan())
    }

    /// The positions of all nodes, in the order of the document.
    pub(super) fn into_points(self) -> Vec<Point> {
        self.points
    }

    /// The position of the node with this id.
    pub(super) fn point(&self, id: i64) -> Option<Point> {
        self.place(self.node(id)?)
    }
}

/// The index of each id.
fn by_id(
    elements: impl ExactSizeIterator<Item = (i64, u32)>,
    kind: &str,
    problems: &mut Vec<Problem>,
) -> HashMap<i64, u32> {
    let mut places = HashMap::with_capacity(elements.len());
    for (place, (id, line)) in elements.enumerate() {
        match places.entry(id) {
            Entry::Vacant(entry) => {
                entry.insert(place as u32);
            }
            Entry::Occupied(_) => problems.push(Problem {
                element: format!("{kind} {id}"),
                line: Some(line as usize),
                what: format!("another {kind} above has the same id, so this one is left out"),
                remedy: "give it an id of its own".into(),
            }),
        }
    }
    places
}
