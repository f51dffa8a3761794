//! OSM as plain data: nodes, ways and relations with their tags, ids and lines.

use std::borrow::Cow;
use std::ops::Range;

use laneweave_network::DrivingSide;

/// What an OSM file holds. Text is borrowed from the file; what belongs to one element lies together in an array for all.
#[derive(Debug, Default, PartialEq)]
pub struct Document<'a> {
    pub(super) nodes: Vec<Node>,
    pub(super) ways: Vec<Way>,
    pub(super) relations: Vec<Relation>,
    /// Ids of the nodes of ways.
    pub(super) references: Vec<i64>,
    pub(super) members: Vec<Member<'a>>,
    pub(super) tags: Vec<Tag<'a>>,
    /// The attribute `driving_side` of the element `MetaInfo`.
    pub(super) driving_side: Option<DrivingSide>,
}

/// A key and its value.
pub(super) type Tag<'a> = (Cow<'a, str>, Cow<'a, str>);

/// From where to where an element's part of an array goes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Span {
    start: u32,
    end: u32,
}

impl Span {
    /// What was added to an array since it had `start` items.
    pub(super) fn since(start: usize, length: usize) -> Span {
        Span { start: start as u32, end: length as u32 }
    }

    fn range(self) -> Range<usize> {
        self.start as usize..self.end as usize
    }
}

/// A point of the map.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Node {
    pub(super) id: i64,
    pub(super) line: usize,
    /// Its attributes `lat`, `lon`, `x`, `y` and `ele`; not a number where one is unreadable.
    pub(super) lat: Option<f64>,
    pub(super) lon: Option<f64>,
    pub(super) x: Option<f64>,
    pub(super) y: Option<f64>,
    pub(super) ele: Option<f64>,
    pub(super) tags: Span,
}

/// A line through nodes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Way {
    pub(super) id: i64,
    pub(super) line: usize,
    pub(super) nodes: Span,
    pub(super) tags: Span,
}

/// Members in their roles.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Relation {
    pub(super) id: i64,
    pub(super) line: usize,
    pub(super) members: Span,
    pub(super) tags: Span,
}

/// What plays a role in a relation.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Member<'a> {
    /// `node`, `way` or `relation`.
    pub(super) kind: Cow<'a, str>,
    pub(super) role: Cow<'a, str>,
    pub(super) id: i64,
}

impl<'a> Document<'a> {
    /// The tags of an element.
    pub(super) fn tags(&self, span: Span) -> Tags<'_> {
        Tags(&self.tags[span.range()])
    }

    /// The ids of a way's nodes.
    pub(super) fn nodes_of(&self, way: &Way) -> &[i64] {
        &self.references[way.nodes.range()]
    }

    /// All members of a relation.
    pub(super) fn members_of(&self, relation: &Relation) -> &[Member<'a>] {
        &self.members[relation.members.range()]
    }

    /// The ids of a relation's members of a kind, `way` or `relation`, that play `role`.
    pub(super) fn members(
        &self,
        relation: &Relation,
        kind: &'static str,
        role: &'static str,
    ) -> impl Iterator<Item = i64> {
        self.members_of(relation).iter().filter(move |it| it.kind == kind && it.role == role).map(|it| it.id)
    }

    /// The relations with this `type`.
    pub(super) fn relations_of_type(&self, kind: &'static str) -> impl Iterator<Item = &Relation> {
        self.relations.iter().filter(move |it| self.tags(it.tags).is("type", kind))
    }
}

/// The tags of one element. Where a key is given twice the first one counts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tags<'d>(pub(super) &'d [Tag<'d>]);

impl<'d> Tags<'d> {
    /// The value of `key`.
    pub(super) fn get(&self, key: &str) -> Option<&'d str> {
        self.0.iter().find(|(k, _)| k == key).map(|(_, value)| value.as_ref())
    }

    /// Whether `key` has this value.
    pub(super) fn is(&self, key: &str, value: &str) -> bool {
        self.get(key) == Some(value)
    }

    /// Whether any key begins with `prefix`.
    pub(super) fn any(&self, prefix: &str) -> bool {
        self.0.iter().any(|(key, _)| key.starts_with(prefix))
    }
}

/// Tags for tests.
#[cfg(test)]
pub(super) fn tags<const N: usize>(tags: [(&'static str, &'static str); N]) -> [Tag<'static>; N] {
    tags.map(|(key, value)| (key.into(), value.into()))
}

/// A coordinate; not a number where it is unreadable.
pub(super) fn number(text: &str) -> f64 {
    text.trim().parse().unwrap_or(f64::NAN)
}
