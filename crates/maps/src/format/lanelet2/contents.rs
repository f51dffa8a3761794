//! The contents of a document beside the roads.

use std::collections::BTreeMap;

use laneweave_network::Point;
use rayon::prelude::*;

use super::lookup::Lookup;
use super::orientation::reversals;
use super::osm::{Document, Relation};
use super::rules::marking;
use super::sharing::{MAXIMUM_SHARING, Sharing};
use crate::contents::{Contents, Marking};
use crate::problem::Problem;

/// Counts the elements of a document by type and subtype, and finds its crosswalks.
pub(super) fn contents(document: &Document, lookup: &Lookup, problems: &mut Vec<Problem>) -> Contents {
    let mut counts: BTreeMap<(&str, &str), usize> = BTreeMap::new();
    let (mut crosswalks, mut shared) = (Vec::new(), Sharing::default());
    for relation in &document.relations {
        let tags = document.tags(relation.tags);
        let kind = (tags.get("type").unwrap_or("relation"), tags.get("subtype").unwrap_or_default());
        *counts.entry(kind).or_default() += 1;
        if kind != ("lanelet", "crosswalk") {
            continue;
        }
        let Some(borders) = borders(document, lookup, relation) else { continue };
        if borders.map(|it| shared.admits(it)) == [true; 2] {
            crosswalks.extend(outline(document, lookup, borders));
        } else {
            problems.push(Problem {
                element: format!("lanelet {}", relation.id),
                line: Some(relation.line as usize),
                what: format!(
                    "{MAXIMUM_SHARING} others share a border of this crosswalk, so it is not drawn"
                ),
                remedy: "delete lanelets that were drawn twice".into(),
            });
        }
    }
    let named = |((kind, subtype), count): ((&str, &str), usize)| {
        (format!("{kind} {subtype}").trim_end().to_owned(), count)
    };
    let elements = [("node", document.nodes.len()), ("way", document.ways.len())];
    let elements = elements.map(|(kind, count)| (kind.to_owned(), count));
    Contents {
        counts: counts.into_iter().map(named).chain(elements).collect(),
        crosswalks,
        markings: markings(document, lookup),
        ..Contents::default()
    }
}

/// All lines that can be seen.
fn markings(document: &Document, lookup: &Lookup) -> Vec<Marking> {
    let markings = document.ways.par_iter().filter_map(|way| {
        let (paint, is_thick) = marking(document.tags(way.tags))?;
        let nodes = document.nodes_of(way).iter();
        let line: Vec<Point> = nodes.map(|it| lookup.point(*it)).collect::<Option<_>>()?;
        (line.len() > 1).then_some(Marking { line, paint, is_thick })
    });
    markings.collect()
}

/// The indices of the left and the right border of a lanelet, if both exist.
fn borders(document: &Document, lookup: &Lookup, lanelet: &Relation) -> Option<[usize; 2]> {
    let way = |side| lookup.way(document.members(lanelet, "way", side).next()?);
    Some([way("left")?, way("right")?])
}

/// The area between two ways, if all their nodes have a position.
fn outline(document: &Document, lookup: &Lookup, [left, right]: [usize; 2]) -> Option<Vec<Point>> {
    let line = |way: usize| -> Option<Vec<Point>> {
        document.nodes_of(&document.ways[way]).iter().map(|it| lookup.point(*it)).collect()
    };
    let (mut left, mut right) = (line(left)?, line(right)?);
    if left.len() < 2 || right.len() < 2 {
        return None;
    }
    let (is_left_reversed, is_right_reversed) = reversals(&left, &right);
    if is_left_reversed {
        left.reverse();
    }
    // Forwards on the left, and back on the right.
    if !is_right_reversed {
        right.reverse();
    }
    left.append(&mut right);
    Some(left)
}
