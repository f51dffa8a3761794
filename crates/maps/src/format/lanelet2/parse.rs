//! OSM XML read into a document.

use std::borrow::Cow;
use std::ops::Range;

use laneweave_network::DrivingSide;

use super::osm::{Coordinate, Document, Member, Node, Relation, Span, Tag, Way};
use crate::problem::Problem;
use crate::xml::{self, Element, Token, Tokens, XmlError, number, refuse_comma};

/// Sets a coordinate called `key` that was not set before.
///
/// # Errors
/// If it has a decimal comma.
fn set(coordinate: &mut Coordinate, line: usize, key: &str, text: &str) -> Result<(), XmlError> {
    if coordinate.get().is_none() {
        let value = number(text);
        refuse_comma(value, line, key, text)?;
        *coordinate = Coordinate::new(value);
    }
    Ok(())
}

/// Shorter files are read in one part [B].
const WORTH_SHARING: usize = 4 << 20;

/// Reads an OSM file. Elements without a usable id become problems; unknown ones are ignored.
///
/// Two halves of a large file are read at once. The second is assumed to begin between two elements. When the first
/// half arrives there and finds that this is wrong, it reads on to the end, and the result of the second is dropped.
pub(super) fn parse<'a>(bytes: &'a [u8], problems: &mut Vec<Problem>) -> Result<Document<'a>, XmlError> {
    let text = xml::text(bytes)?;
    let cut = Some(text.len()).filter(|it| *it >= WORTH_SHARING).and_then(|it| element_after(text, it / 2));
    parse_cut(text, cut.unwrap_or(text.len()), problems)
}

fn parse_cut<'a>(text: &'a str, cut: usize, problems: &mut Vec<Problem>) -> Result<Document<'a>, XmlError> {
    let second = || match &text[cut..] {
        "" => None,
        rest => Some(part(text, Tokens::inside(rest, ROOT), cut..text.len())),
    };
    let (first, second) = rayon::join(|| part(text, Tokens::of(text, ROOT), 0..cut), second);
    let mut first = first?;
    problems.append(&mut first.problems);
    if let (true, Some(second)) = (first.is_cut, second) {
        let second = second.map_err(|error| error.moved(first.lines))?;
        let moved = |it: Problem| Problem { line: it.line.map(|line| line + first.lines), ..it };
        problems.extend(second.problems.into_iter().map(moved));
        first.document.append(second.document, first.lines);
    }
    Ok(first.document)
}

/// The outermost element.
const ROOT: &str = "osm";

/// The position after `start` at which a line begins with something that looks like an element of the file.
fn element_after(text: &str, start: usize) -> Option<usize> {
    memchr::memchr_iter(b'\n', &text.as_bytes()[start..]).map(|it| start + it + 1).find_map(|line| {
        let rest = text.get(line..)?;
        let element = rest.trim_start_matches([' ', '\t']);
        let is_one = ["<node ", "<way ", "<relation "].iter().any(|it| element.starts_with(it));
        is_one.then_some(text.len() - element.len())
    })
}

/// Part of a file.
struct Part<'a> {
    document: Document<'a>,
    problems: Vec<Problem>,
    /// Whether it ends at the cut, not at the end of the file.
    is_cut: bool,
    /// Number of lines that end in it.
    lines: usize,
}

/// Reads the part of the text at `place`, and further if it ends inside of something.
fn part<'a>(text: &'a str, mut tokens: Tokens<'a>, place: Range<usize>) -> Result<Part<'a>, XmlError> {
    let mut problems = Vec::new();
    let document = with_room(text, place.clone());
    let mut parser = Parser { document, open: None, problems: &mut problems };
    let mut is_cut = false;
    loop {
        match tokens.next()? {
            Token::Open(element) => match tokens.depth() {
                2 => parser.open(&element)?,
                3 => parser.add(&element)?,
                _ => {}
            },
            Token::Close if tokens.depth() == 1 => parser.close(),
            Token::Close | Token::Text(_) => {}
            Token::End => break,
        }
        if tokens.position() == place.len() && tokens.depth() == 1 && place.end < text.len() {
            is_cut = true;
            break;
        }
    }
    let document = parser.document;
    Ok(Part { document, problems, is_cut, lines: tokens.lines() })
}

/// A document with capacity for as many elements as this part of the text seems to contain: growing large arrays
/// takes longer than counting the elements.
fn with_room(text: &str, part: Range<usize>) -> Document<'_> {
    let [mut nodes, mut ways, mut relations, mut references, mut members, mut tags] = [0; 6];
    let bytes = &text.as_bytes()[part];
    for at in memchr::memchr_iter(b'<', bytes) {
        match bytes.get(at + 1..at + 3) {
            Some(b"no") => nodes += 1,
            Some(b"wa") => ways += 1,
            Some(b"re") => relations += 1,
            Some(b"nd") => references += 1,
            Some(b"me") => members += 1,
            Some(b"ta") => tags += 1,
            _ => {}
        }
    }
    // Text that only looks like elements is shorter than the shortest ones.
    let most = |count: usize, shortest: &str| count.min(bytes.len() / shortest.len());
    Document {
        text,
        own_text: String::new(),
        nodes: Vec::with_capacity(most(nodes, "<node id='1'/>")),
        ways: Vec::with_capacity(most(ways, "<way id='1'/>")),
        relations: Vec::with_capacity(most(relations, "<relation id='1'/>")),
        references: Vec::with_capacity(most(references, "<nd ref='1'/>")),
        members: Vec::with_capacity(most(members, "<member ref='1'/>")),
        tags: Vec::with_capacity(most(tags, "<tag k='' v=''/>")),
        driving_side: None,
    }
}

struct Parser<'a, 'p> {
    document: Document<'a>,
    open: Option<Open>,
    problems: &'p mut Vec<Problem>,
}

/// The element that is being read, and the start of its tags and its members or nodes.
struct Open {
    element: Kind,
    first_tag: usize,
    first_part: usize,
}

#[derive(Clone, Copy)]
enum Kind {
    Node(Node),
    Way { id: i64, line: u32 },
    Relation { id: i64, line: u32 },
}

impl<'a> Parser<'a, '_> {
    /// Begins a node, way or relation; reads `MetaInfo`.
    fn open(&mut self, element: &Element<'a>) -> Result<(), XmlError> {
        match element.name {
            "node" | "way" | "relation" => self.begin(element),
            "MetaInfo" => {
                for attribute in element.attributes() {
                    match attribute? {
                        ("driving_side", side) if side == "left" => {
                            self.document.driving_side = Some(DrivingSide::Left);
                        }
                        ("driving_side", side) if side == "right" => {
                            self.document.driving_side = Some(DrivingSide::Right);
                        }
                        _ => {}
                    }
                }
                Ok(())
            }
            _ => Ok(()),
        }
    }

    fn begin(&mut self, element: &Element<'a>) -> Result<(), XmlError> {
        let mut node = Node { line: element.line as u32, ..Node::default() };
        let mut id: Option<Cow<str>> = None;
        for attribute in element.attributes() {
            let (key, value) = attribute?;
            match key {
                "id" => id = id.or(Some(value)),
                // Editors keep deleted elements in the file until it is uploaded.
                "action" if value == "delete" => return Ok(()),
                "lat" => set(&mut node.lat, element.line, key, &value)?,
                "lon" => set(&mut node.lon, element.line, key, &value)?,
                "x" => set(&mut node.x, element.line, key, &value)?,
                "y" => set(&mut node.y, element.line, key, &value)?,
                "ele" => set(&mut node.ele, element.line, key, &value)?,
                _ => {}
            }
        }
        let Some(number) = id.as_deref().and_then(|it| it.parse().ok()) else {
            self.problems.push(Problem {
                element: format!("{} {}", element.name, id.unwrap_or_default()).trim_end().into(),
                line: Some(element.line),
                what: "its id is missing or not a whole number, so it is left out".into(),
                remedy: "give it an id of its own".into(),
            });
            return Ok(());
        };
        let line = element.line as u32;
        let (element, first_part) = match element.name {
            "node" => (Kind::Node(Node { id: number, ..node }), 0),
            "way" => (Kind::Way { id: number, line }, self.document.references.len()),
            _ => (Kind::Relation { id: number, line }, self.document.members.len()),
        };
        self.open = Some(Open { element, first_tag: self.document.tags.len(), first_part });
        Ok(())
    }

    /// Adds a tag, a node of a way, or a member of a relation.
    fn add(&mut self, element: &Element<'a>) -> Result<(), XmlError> {
        let Some(Open { element: into, .. }) = self.open else { return Ok(()) };
        match (element.name, into) {
            ("tag", _) => self.add_tag(element),
            ("nd", Kind::Way { .. }) | ("member", Kind::Relation { .. }) => self.add_part(element, into),
            _ => Ok(()),
        }
    }

    fn add_tag(&mut self, element: &Element<'a>) -> Result<(), XmlError> {
        let (mut key, mut value) = (None, None);
        for attribute in element.attributes() {
            match attribute? {
                ("k", it) => key = key.or(Some(it)),
                ("v", it) => value = value.or(Some(it)),
                _ => {}
            }
        }
        if let (Some(key), Some(value)) = (key, value) {
            if matches!(key.as_ref(), "local_x" | "local_y" | "ele") {
                refuse_comma(number(&value), element.line, &key, &value)?;
            }
            let tag = Tag { key: self.document.keep(&key), value: self.document.keep(&value) };
            self.document.tags.push(tag);
        }
        Ok(())
    }

    fn add_part(&mut self, element: &Element<'a>, into: Kind) -> Result<(), XmlError> {
        let (mut reference, mut kind, mut role) = (None, None, None);
        for attribute in element.attributes() {
            match attribute? {
                ("ref", it) => reference = reference.or(Some(it)),
                ("type", it) => kind = kind.or(Some(it)),
                ("role", it) => role = role.or(Some(it)),
                _ => {}
            }
        }
        let id = reference.as_deref().and_then(|it| it.parse().ok());
        match (id, into) {
            (Some(id), Kind::Way { .. }) => self.document.references.push(id),
            (Some(id), _) => {
                let kind = self.document.keep(&kind.unwrap_or_default());
                let role = self.document.keep(&role.unwrap_or_default());
                self.document.members.push(Member { id, kind, role });
            }
            (None, _) => self.problems.push(Problem {
                element: match into {
                    Kind::Node(it) => format!("node {}", it.id),
                    Kind::Way { id, .. } => format!("way {id}"),
                    Kind::Relation { id, .. } => format!("relation {id}"),
                },
                line: Some(element.line),
                what: "the ref of a member is missing or not a whole number, so that member is left out"
                    .into(),
                remedy: "refer to the id of an element".into(),
            }),
        }
        Ok(())
    }

    /// Stores the element that was being read.
    fn close(&mut self) {
        let document = &mut self.document;
        let Some(Open { element, first_tag, first_part }) = self.open.take() else { return };
        let tags = Span::since(first_tag, document.tags.len());
        match element {
            Kind::Node(node) => document.nodes.push(Node { tags, ..node }),
            Kind::Way { id, line } => {
                let nodes = Span::since(first_part, document.references.len());
                document.ways.push(Way { id, line, nodes, tags });
            }
            Kind::Relation { id, line } => {
                let members = Span::since(first_part, document.members.len());
                document.relations.push(Relation { id, line, members, tags });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> (Document<'_>, Vec<Problem>) {
        let mut problems = Vec::new();
        let document = parse(text.as_bytes(), &mut problems).unwrap();
        (document, problems)
    }

    fn refusal(bytes: &[u8]) -> String {
        parse(bytes, &mut Vec::new()).unwrap_err().to_string()
    }

    #[test]
    fn elements_carry_their_ids_lines_and_tags() {
        let (document, problems) = read(concat!(
            "\u{feff}<?xml version='1.0'?>\n<osm>\n<MetaInfo driving_side='left'/>\n",
            "<node id='-1' lat='49' lon='8.5' x='one'>\n<tag k='name' v='a &amp; b'/></node><!-- \n -->\n",
            "<way id='2'><nd ref='-1'/><nd ref='7'/></way>\n",
            "<relation id='3'><member type='way' ref='2' role='left'/><tag k='type' v='lanelet'/></relation>\n",
            "<node id='9' action='delete' lat='0' lon='0'/>\n</osm>\n",
        ));
        assert!(problems.is_empty());
        assert_eq!(document.driving_side, Some(DrivingSide::Left));
        let node = &document.nodes[0];
        assert_eq!((document.nodes.len(), node.id, node.line), (1, -1, 4));
        assert_eq!((node.lat.get(), node.lon.get(), node.y.get()), (Some(49.0), Some(8.5), None));
        assert!(node.x.get().unwrap().is_nan());
        assert_eq!(document.tags(node.tags).get("name"), Some("a & b"));
        let way = &document.ways[0];
        assert_eq!((way.line, document.nodes_of(way)), (7, &[-1, 7][..]));
        let relation = &document.relations[0];
        assert_eq!(relation.line, 8);
        assert_eq!(document.members(relation, "way", "left").collect::<Vec<_>>(), [2]);
        assert!(document.tags(relation.tags).is("type", "lanelet"));
        assert!(document.tags(relation.tags).any("typ"));
    }

    #[test]
    fn elements_without_an_id_are_problems() {
        let (document, problems) =
            read("<osm>\n<node lat='1'/>\n<way id='2'>\n<nd ref='x'/></way><relation id='r'/></osm>");
        assert_eq!((document.nodes.len(), document.ways.len(), document.relations.len()), (0, 1, 0));
        let places: Vec<_> = problems.iter().map(|it| (it.element.as_str(), it.line.unwrap())).collect();
        assert_eq!(places, [("node", 2), ("way 2", 4), ("relation r", 4)]);
    }

    #[test]
    fn what_is_no_osm_is_refused_with_its_line() {
        assert_eq!(
            refusal(b""),
            "line 1: the outermost element is <>, not <osm>; is this a file of another format?"
        );
        assert!(refusal(b"\n<svg/>").starts_with("line 2: the outermost element is <svg>"));
        assert!(refusal(b"<osm>\n\n<way></node></osm>").starts_with("line 3: not well-formed XML"));
        assert!(refusal(b"<osm><node id='&unknown;'/></osm>").starts_with("line 1: not well-formed XML"));
    }

    #[test]
    fn two_halves_are_read_like_one_whole_wherever_the_file_is_cut() {
        let text = concat!(
            "<?xml version='1.0'?>\n<osm>\n<node id='1' lat='1'>\n<tag k='a&amp;b' v='1'/></node>\n<!--\n",
            "<node id='8'/> -->\n<MetaInfo driving_side='right'/>\n<way id='2'><nd ref='1'/>\n<nd ref='x'/></way>\n",
            "<node id='3'><tag k='&lt;' v='&gt;'/></node><relation id='4'><member ref='2' role='&quot;'/></relation>\n",
            "<node/>\n<relation id='5'/>\n<MetaInfo driving_side='left'/></osm>\n",
        );
        let all = |cut: usize| {
            let mut problems = Vec::new();
            let document = parse_cut(text, cut, &mut problems).unwrap();
            let lines: Vec<u32> = document.nodes.iter().map(|it| it.line).collect();
            let others: Vec<u32> = document.ways.iter().map(|it| it.line).collect();
            (document.write(), lines, others, document.relations.last().unwrap().line, problems)
        };
        let whole = all(text.len());
        assert_eq!((whole.1.as_slice(), whole.2.as_slice(), whole.3), (&[3, 10][..], &[8][..], 12));
        assert_eq!(whole.4.iter().map(|it| it.line.unwrap()).collect::<Vec<_>>(), [9, 11]);
        for cut in 0..text.len() {
            assert_eq!(all(cut), whole, "cut at {cut}");
        }
    }

    #[test]
    fn what_breaks_in_the_second_half_is_refused_with_its_line() {
        let text = "<osm>\n<node id='1'/>\n<node id='2'/>\n</way>\n</osm>";
        let refusal = |cut| parse_cut(text, cut, &mut Vec::new()).unwrap_err();
        assert_eq!(refusal(text.len()).line(), 4);
        for cut in (0..text.len()).filter(|it| text[*it..].starts_with("<node")) {
            assert_eq!(refusal(cut).line(), 4, "{}", refusal(cut));
        }
    }

    #[test]
    fn a_large_file_is_cut_before_an_element() {
        let text = "<osm>\n <!-- -->\n\t <way id='1'/>\n<node id='2'/></osm>";
        assert_eq!(element_after(text, 0), text.find("<way"));
        assert_eq!(element_after(text, 25), text.find("<node"));
        assert_eq!(element_after(text, 40), None);
    }
}
