//! What a document holds beside the roads.

use std::collections::BTreeMap;

use laneweave_network::Point;

use super::lookup::Lookup;
use super::orientation::reversals;
use super::osm::{Document, Relation};
use crate::contents::Contents;

/// Counts the elements of a document by type and subtype, and finds its crosswalks.
pub(super) fn contents(document: &Document, lookup: &Lookup) -> Contents {
    let mut counts: BTreeMap<(&str, &str), usize> = BTreeMap::new();
    let mut crosswalks = Vec::new();
    for relation in &document.relations {
        let tags = document.tags(relation.tags);
        let kind = (tags.get("type").unwrap_or("relation"), tags.get("subtype").unwrap_or_default());
        *counts.entry(kind).or_default() += 1;
        if kind == ("lanelet", "crosswalk") {
            crosswalks.extend(outline(document, lookup, relation));
        }
    }
    let named = |((kind, subtype), count): ((&str, &str), usize)| {
        (format!("{kind} {subtype}").trim_end().to_owned(), count)
    };
    let elements = [("node", document.nodes.len()), ("way", document.ways.len())];
    let elements = elements.map(|(kind, count)| (kind.to_owned(), count));
    Contents { counts: counts.into_iter().map(named).chain(elements).collect(), crosswalks }
}

/// The ground that a lanelet covers, if both of its borders are there.
fn outline(document: &Document, lookup: &Lookup, lanelet: &Relation) -> Option<Vec<Point>> {
    let line = |side| -> Option<Vec<Point>> {
        let way = lookup.way(document.members(lanelet, "way", side).next()?)?;
        document.nodes_of(&document.ways[way]).iter().map(|it| lookup.point(*it)).collect()
    };
    let (mut left, mut right) = (line("left")?, line("right")?);
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
