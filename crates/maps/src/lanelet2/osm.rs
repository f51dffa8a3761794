//! OSM XML as plain data: nodes, ways and relations with their tags, ids and lines.

use std::fmt::{self, Display};

use laneweave_network::DrivingSide;
use quick_xml::events::{BytesStart, Event};

use crate::error::MapError;
use crate::problem::Problem;
pub(super) use crate::xml::number;
use crate::xml::{MAXIMUM_DEPTH, Xml, attributes, broken};

/// What an OSM file holds.
#[derive(Debug, Default)]
pub(super) struct Document {
    pub(super) nodes: Vec<Node>,
    pub(super) ways: Vec<Way>,
    pub(super) relations: Vec<Relation>,
    /// The attribute `driving_side` of the element `MetaInfo`.
    pub(super) driving_side: Option<DrivingSide>,
}

/// A point of the map.
#[derive(Debug, Default)]
pub(super) struct Node {
    pub(super) id: i64,
    pub(super) line: usize,
    /// Its attributes `lat`, `lon`, `x`, `y` and `ele`; not a number where one is unreadable.
    pub(super) lat: Option<f64>,
    pub(super) lon: Option<f64>,
    pub(super) x: Option<f64>,
    pub(super) y: Option<f64>,
    pub(super) ele: Option<f64>,
    pub(super) tags: Tags,
}

/// A line through nodes.
#[derive(Debug, Default)]
pub(super) struct Way {
    pub(super) id: i64,
    pub(super) line: usize,
    /// Ids of its nodes.
    pub(super) nodes: Vec<i64>,
    pub(super) tags: Tags,
}

/// Members in their roles.
#[derive(Debug, Default)]
pub(super) struct Relation {
    pub(super) id: i64,
    pub(super) line: usize,
    pub(super) members: Vec<Member>,
    pub(super) tags: Tags,
}

/// A way or relation that plays a role in a relation.
#[derive(Debug)]
pub(super) struct Member {
    pub(super) kind: String,
    pub(super) role: String,
    pub(super) id: i64,
}

impl Document {
    /// The relations that are lanelets.
    pub(super) fn lanelets(&self) -> impl Iterator<Item = &Relation> {
        self.relations.iter().filter(|it| it.tags.is("type", "lanelet"))
    }
}

impl Relation {
    /// The members of a kind, `way` or `relation`, that play `role`.
    pub(super) fn members<'a>(&'a self, kind: &'a str, role: &'a str) -> impl Iterator<Item = i64> + 'a {
        self.members.iter().filter(move |it| it.kind == kind && it.role == role).map(|it| it.id)
    }
}

/// Keys with values.
#[derive(Debug, Default)]
pub(super) struct Tags(Vec<(String, String)>);

impl Tags {
    /// The value of `key`.
    pub(super) fn get(&self, key: &str) -> Option<&str> {
        self.0.iter().find(|(k, _)| k == key).map(|(_, value)| value.as_str())
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

impl<const N: usize> From<[(&str, &str); N]> for Tags {
    fn from(tags: [(&str, &str); N]) -> Tags {
        Tags(tags.into_iter().map(|(key, value)| (key.into(), value.into())).collect())
    }
}

/// Reads an OSM file. Elements without a usable id become problems, unknown ones are passed over.
pub(super) fn parse(bytes: &[u8], problems: &mut Vec<Problem>) -> Result<Document, MapError> {
    let mut xml = Xml::new(bytes)?;
    let mut document = Document::default();
    let mut depth = 0;
    let mut building: Option<Building> = None;
    let mut found_root = false;
    loop {
        let (event, line) = xml.next()?;
        let (start, is_empty) = match &event {
            Event::Start(start) => (start, false),
            Event::Empty(start) => (start, true),
            Event::End(_) => {
                depth -= 1;
                if depth == 1 {
                    document.keep(building.take());
                }
                continue;
            }
            Event::Eof if depth > 0 => {
                return Err(broken(line, "the file ends inside an element").into());
            }
            Event::Eof if !found_root => return Err(MapError::NotOsm { line, found: String::new() }),
            Event::Eof => return Ok(document),
            _ => continue,
        };
        match depth {
            0 if start.name().as_ref() != "osm" => {
                return Err(MapError::NotOsm { line, found: start.name().as_ref().into() });
            }
            0 => found_root = true,
            1 => building = document.open(start, line, problems)?,
            2 => {
                if let Some(building) = &mut building {
                    building.add(start, line, problems)?;
                }
            }
            MAXIMUM_DEPTH => return Err(broken(line, "elements are nested too deeply").into()),
            _ => {}
        }
        if !is_empty {
            depth += 1;
        } else if depth == 1 {
            document.keep(building.take());
        }
    }
}

/// The element that is being read.
enum Building {
    Node(Node),
    Way(Way),
    Relation(Relation),
}

impl Document {
    /// Begins a node, way or relation; notes what `MetaInfo` says.
    fn open(
        &mut self,
        start: &BytesStart,
        line: usize,
        problems: &mut Vec<Problem>,
    ) -> Result<Option<Building>, MapError> {
        let name = start.name();
        let kind = name.as_ref();
        if kind == "MetaInfo" {
            let [side] = attributes(start, line, ["driving_side"])?;
            self.driving_side = match side.as_deref() {
                Some("left") => Some(DrivingSide::Left),
                Some("right") => Some(DrivingSide::Right),
                _ => self.driving_side,
            };
        }
        if !matches!(kind, "node" | "way" | "relation") {
            return Ok(None);
        }
        let [id, action, lat, lon, x, y, ele] =
            attributes(start, line, ["id", "action", "lat", "lon", "x", "y", "ele"])?;
        // Editors leave what was deleted in the file until it is uploaded.
        if action.as_deref() == Some("delete") {
            return Ok(None);
        }
        let Some(id) = id.as_deref().and_then(|it| it.parse().ok()) else {
            problems.push(Problem {
                element: format!("{kind} {}", id.unwrap_or_default()).trim_end().into(),
                line: Some(line),
                what: "its id is missing or no whole number, so it is left out".into(),
                remedy: "give it an id of its own".into(),
            });
            return Ok(None);
        };
        Ok(Some(match kind {
            "node" => {
                let [lat, lon, x, y, ele] = [lat, lon, x, y, ele].map(|it| it.as_deref().map(number));
                Building::Node(Node { id, line, lat, lon, x, y, ele, tags: Tags::default() })
            }
            "way" => Building::Way(Way { id, line, ..Way::default() }),
            _ => Building::Relation(Relation { id, line, ..Relation::default() }),
        }))
    }

    fn keep(&mut self, built: Option<Building>) {
        match built {
            Some(Building::Node(node)) => self.nodes.push(node),
            Some(Building::Way(way)) => self.ways.push(way),
            Some(Building::Relation(relation)) => self.relations.push(relation),
            None => {}
        }
    }
}

impl Building {
    /// Adds a tag, a node of a way, or a member of a relation.
    fn add(&mut self, start: &BytesStart, line: usize, problems: &mut Vec<Problem>) -> Result<(), MapError> {
        let name = start.name();
        if name.as_ref() == "tag" {
            if let [Some(key), Some(value)] = attributes(start, line, ["k", "v"])? {
                self.tags().0.push((key, value));
            }
            return Ok(());
        }
        let [reference, kind, role] = attributes(start, line, ["ref", "type", "role"])?;
        let id = reference.as_deref().and_then(|it| it.parse().ok());
        match (self, name.as_ref(), id) {
            (Building::Way(way), "nd", Some(id)) => way.nodes.push(id),
            (Building::Relation(relation), "member", Some(id)) => relation.members.push(Member {
                kind: kind.unwrap_or_default(),
                role: role.unwrap_or_default(),
                id,
            }),
            (building, "nd" | "member", None) => problems.push(Problem {
                element: building.to_string(),
                line: Some(line),
                what: "a member's ref is missing or no whole number, so that member is left out".into(),
                remedy: "refer to the id of an element".into(),
            }),
            _ => {}
        }
        Ok(())
    }

    fn tags(&mut self) -> &mut Tags {
        match self {
            Building::Node(it) => &mut it.tags,
            Building::Way(it) => &mut it.tags,
            Building::Relation(it) => &mut it.tags,
        }
    }
}

impl Display for Building {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Building::Node(it) => write!(f, "node {}", it.id),
            Building::Way(it) => write!(f, "way {}", it.id),
            Building::Relation(it) => write!(f, "relation {}", it.id),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> (Document, Vec<Problem>) {
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
        assert_eq!((node.lat, node.lon, node.y), (Some(49.0), Some(8.5), None));
        assert!(node.x.unwrap().is_nan());
        assert_eq!(node.tags.get("name"), Some("a & b"));
        assert_eq!((document.ways[0].line, &document.ways[0].nodes[..]), (7, &[-1, 7][..]));
        let relation = &document.relations[0];
        assert_eq!((relation.line, relation.members("way", "left").collect::<Vec<_>>()), (8, vec![2]));
        assert!(relation.tags.is("type", "lanelet") && relation.tags.any("typ"));
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
        assert_eq!(refusal(b""), "line 1: the outermost element is <>, not <osm>; is this a Lanelet2 map?");
        assert!(refusal(b"\n<svg/>").starts_with("line 2: the outermost element is <svg>"));
        assert!(refusal(b"<osm>\n\n<way></node></osm>").starts_with("line 3: not well-formed XML"));
        assert!(refusal(b"<osm>\n<way>").starts_with("line 2: not well-formed XML (the file ends inside"));
        assert!(refusal(b"<osm>\n\xff</osm>").starts_with("line 2: the bytes are not UTF-8"));
        assert!(refusal(b"<osm><node id='&unknown;'/></osm>").starts_with("line 1: not well-formed XML"));
    }

    #[test]
    fn deep_nesting_is_refused() {
        assert!(refusal("<osm>".repeat(33).as_bytes()).contains("nested too deeply"));
    }
}
