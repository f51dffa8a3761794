//! OSM as plain data: nodes, ways and relations with their tags, ids and lines.

use std::fmt::Display;
use std::ops::Range;

use laneweave_network::DrivingSide;

/// The contents of an OSM file. The parts of all elements lie in common arrays, and text stays where it is in the
/// file, so that a document takes little more memory than its file.
#[derive(Debug, Default)]
pub struct Document<'a> {
    /// The text of the file.
    pub(super) text: &'a str,
    /// Text that the file does not contain in its final form.
    pub(super) own_text: String,
    pub(super) nodes: Vec<Node>,
    pub(super) ways: Vec<Way>,
    pub(super) relations: Vec<Relation>,
    /// Ids of the nodes of ways.
    pub(super) references: Vec<i64>,
    pub(super) members: Vec<Member>,
    pub(super) tags: Vec<Tag>,
    /// The attribute `driving_side` of the element `MetaInfo`.
    pub(super) driving_side: Option<DrivingSide>,
}

/// A piece of a document's text.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Text {
    /// Start position; from [`Text::OWN`] on it counts in the document's own text.
    start: u32,
    length: u32,
}

impl Text {
    /// Maximum size of a file.
    const OWN: u32 = 1 << 31;

    /// The same text, after so many bytes were put before the document's own text.
    fn moved(self, by: usize) -> Text {
        if self.start < Text::OWN { self } else { Text { start: self.start + by as u32, ..self } }
    }
}

/// A key and its value.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tag {
    pub(super) key: Text,
    pub(super) value: Text,
}

/// Start and end of an element's part of an array.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Span {
    start: u32,
    end: u32,
}

impl Span {
    /// The items that were added to an array since it had `start` items.
    pub(super) fn since(start: usize, length: usize) -> Span {
        Span { start: start as u32, end: length as u32 }
    }

    fn moved(self, by: usize) -> Span {
        Span { start: self.start + by as u32, end: self.end + by as u32 }
    }

    fn range(self) -> Range<usize> {
        self.start as usize..self.end as usize
    }
}

/// A coordinate that may be missing or no number.
#[derive(Clone, Copy, Debug)]
pub(super) struct Coordinate(f64);

impl Coordinate {
    /// A NaN that no reading of a number gives.
    const MISSING: u64 = 0x7ff8_dead_dead_dead;

    pub(super) const NONE: Coordinate = Coordinate(f64::from_bits(Coordinate::MISSING));

    /// The coordinate; NaN where it is unreadable.
    pub(super) fn new(value: f64) -> Coordinate {
        Coordinate(if value.is_nan() { f64::NAN } else { value })
    }

    /// The coordinate, if one is given.
    pub(super) fn get(self) -> Option<f64> {
        (self.0.to_bits() != Coordinate::MISSING).then_some(self.0)
    }
}

/// A point of the map.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) id: i64,
    /// Its attributes with these names.
    pub(super) lat: Coordinate,
    pub(super) lon: Coordinate,
    pub(super) x: Coordinate,
    pub(super) y: Coordinate,
    pub(super) ele: Coordinate,
    pub(super) line: u32,
    pub(super) tags: Span,
}

impl Default for Node {
    fn default() -> Node {
        let [lat, lon, x, y, ele] = [Coordinate::NONE; 5];
        Node { id: 0, lat, lon, x, y, ele, line: 0, tags: Span::default() }
    }
}

/// A line through nodes.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Way {
    pub(super) id: i64,
    pub(super) line: u32,
    pub(super) nodes: Span,
    pub(super) tags: Span,
}

/// Members with their roles.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Relation {
    pub(super) id: i64,
    pub(super) line: u32,
    pub(super) members: Span,
    pub(super) tags: Span,
}

/// A member of a relation.
#[derive(Clone, Copy, Debug)]
pub(super) struct Member {
    pub(super) id: i64,
    /// `node`, `way` or `relation`.
    pub(super) kind: Text,
    pub(super) role: Text,
}

impl<'a> Document<'a> {
    /// Stores a text: as a position if the file contains it.
    pub(super) fn keep(&mut self, text: &str) -> Text {
        let length = text.len() as u32;
        let place = (text.as_ptr() as usize).wrapping_sub(self.text.as_ptr() as usize);
        if place.saturating_add(text.len()) <= self.text.len() {
            return Text { start: place as u32, length };
        }
        let start = Text::OWN + self.own_text.len() as u32;
        self.own_text.push_str(text);
        Text { start, length }
    }

    /// Stores the tags of an element.
    pub(super) fn keep_tags(&mut self, tags: &[(&str, &dyn Display)]) -> Span {
        let start = self.tags.len();
        for (key, value) in tags {
            let tag = Tag { key: self.keep(key), value: self.keep(&value.to_string()) };
            self.tags.push(tag);
        }
        Span::since(start, self.tags.len())
    }

    /// Adds the elements of another part of the same file, which starts `lines` later.
    pub(super) fn append(&mut self, other: Document<'a>, lines: usize) {
        let own = self.own_text.len();
        let [tags, references, members] = [self.tags.len(), self.references.len(), self.members.len()];
        let lines = lines as u32;
        self.own_text += &other.own_text;
        self.tags
            .extend(other.tags.iter().map(|it| Tag { key: it.key.moved(own), value: it.value.moved(own) }));
        self.references.extend(&other.references);
        self.members.extend(other.members.iter().map(|it| Member {
            kind: it.kind.moved(own),
            role: it.role.moved(own),
            ..*it
        }));
        let node = |it: &Node| Node { line: it.line + lines, tags: it.tags.moved(tags), ..*it };
        self.nodes.extend(other.nodes.iter().map(node));
        let way = |it: &Way| Way {
            line: it.line + lines,
            nodes: it.nodes.moved(references),
            tags: it.tags.moved(tags),
            ..*it
        };
        self.ways.extend(other.ways.iter().map(way));
        let relation = |it: &Relation| Relation {
            line: it.line + lines,
            members: it.members.moved(members),
            tags: it.tags.moved(tags),
            ..*it
        };
        self.relations.extend(other.relations.iter().map(relation));
        self.driving_side = other.driving_side.or(self.driving_side);
    }

    /// The string of a text.
    pub(super) fn get(&self, text: Text) -> &str {
        let (from, start) = match text.start.checked_sub(Text::OWN) {
            Some(start) => (self.own_text.as_str(), start),
            None => (self.text, text.start),
        };
        &from[start as usize..(start + text.length) as usize]
    }

    /// The tags of an element.
    pub(super) fn tags(&self, span: Span) -> Tags<'_> {
        Tags { document: self, tags: &self.tags[span.range()] }
    }

    /// The ids of a way's nodes.
    pub(super) fn nodes_of(&self, way: &Way) -> &[i64] {
        &self.references[way.nodes.range()]
    }

    /// All members of a relation.
    pub(super) fn members_of(&self, relation: &Relation) -> &[Member] {
        &self.members[relation.members.range()]
    }

    /// The ids of a relation's members of a kind, `way` or `relation`, with this `role`.
    pub(super) fn members(
        &self,
        relation: &Relation,
        kind: &'static str,
        role: &'static str,
    ) -> impl Iterator<Item = i64> {
        let all = self.members_of(relation).iter();
        all.filter(move |it| self.get(it.role) == role && self.get(it.kind) == kind).map(|it| it.id)
    }

    /// The relations with this `type`.
    pub(super) fn relations_of_type(&self, kind: &'static str) -> impl Iterator<Item = &Relation> {
        self.relations.iter().filter(move |it| self.tags(it.tags).is("type", kind))
    }
}

/// Maximum number of tags of an element that are read, far more than any element has.
const MAXIMUM_TAGS: usize = 256;

/// The tags of one element. Where a key is given twice the first one counts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tags<'d> {
    document: &'d Document<'d>,
    tags: &'d [Tag],
}

impl<'d> Tags<'d> {
    /// Keys and values in their order.
    pub(super) fn all(self) -> impl Iterator<Item = (&'d str, &'d str)> {
        self.tags.iter().map(move |it| (self.document.get(it.key), self.document.get(it.value)))
    }

    /// The value of `key`.
    pub(super) fn get(self, key: &str) -> Option<&'d str> {
        let tag = self.tags.iter().take(MAXIMUM_TAGS).find(|it| self.document.get(it.key) == key);
        tag.map(|it| self.document.get(it.value))
    }

    /// Whether `key` has this value.
    pub(super) fn is(self, key: &str, value: &str) -> bool {
        self.get(key) == Some(value)
    }

    /// Whether any key begins with `prefix`.
    pub(super) fn any(self, prefix: &str) -> bool {
        self.all().take(MAXIMUM_TAGS).any(|(key, _)| key.starts_with(prefix))
    }
}

/// The result of `of` for an element with these tags.
#[cfg(test)]
pub(super) fn with_tags<const N: usize, T>(tags: [(&str, &str); N], of: impl FnOnce(Tags) -> T) -> T {
    let mut document = Document::default();
    let span = document.keep_tags(&tags.each_ref().map(|(key, value)| (*key, value as &dyn Display)));
    of(document.tags(span))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_element_is_known_by_its_first_256_tags() {
        let names: Vec<String> = (0..300).map(|it| format!("key {it}")).collect();
        let mut document = Document::default();
        let tags: Vec<(&str, &dyn Display)> =
            names.iter().map(|it| (it.as_str(), &1 as &dyn Display)).collect();
        let span = document.keep_tags(&tags);
        let tags = document.tags(span);
        assert_eq!((tags.get("key 255"), tags.get("key 256")), (Some("1"), None));
        assert!(tags.any("key 255") && !tags.any("key 256"));
        assert_eq!(tags.all().count(), 300);
    }
}
