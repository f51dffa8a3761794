//! OSM elements written as XML.

use std::fmt::{self, Display, Write};

use laneweave_network::DrivingSide;

use super::osm::{Document, Tags};

impl Document<'_> {
    /// The text of a file with these elements. Reading it gives the same ids, tags, coordinates, nodes and members,
    /// whether or not this program knows their meaning.
    pub fn write(&self) -> String {
        let mut text = String::new();
        // Writing to a string never fails.
        let _ = self.write_to(&mut text);
        text
    }

    fn write_to(&self, out: &mut impl Write) -> fmt::Result {
        writeln!(out, r#"<?xml version="1.0" encoding="UTF-8"?>"#)?;
        writeln!(out, r#"<osm version="0.6" generator="laneweave">"#)?;
        if let Some(side) = self.driving_side {
            let side = match side {
                DrivingSide::Left => "left",
                DrivingSide::Right => "right",
            };
            writeln!(out, r#"<MetaInfo format_version="1" map_version="1" driving_side="{side}"/>"#)?;
        }
        for node in &self.nodes {
            write!(out, r#"<node id="{}""#, node.id)?;
            let coordinates =
                [("lat", node.lat), ("lon", node.lon), ("x", node.x), ("y", node.y), ("ele", node.ele)];
            for (key, value) in coordinates.iter().filter_map(|(key, it)| Some((key, it.get()?))) {
                write!(out, r#" {key}="{value}""#)?;
            }
            element(out, "node", self.tags(node.tags), &[], |_, ()| Ok(()))?;
        }
        for way in &self.ways {
            write!(out, r#"<way id="{}""#, way.id)?;
            element(out, "way", self.tags(way.tags), self.nodes_of(way), |out, id| {
                write!(out, r#"<nd ref="{id}"/>"#)
            })?;
        }
        for relation in &self.relations {
            write!(out, r#"<relation id="{}""#, relation.id)?;
            element(out, "relation", self.tags(relation.tags), self.members_of(relation), |out, member| {
                let (kind, role) = (Escaped(self.get(member.kind)), Escaped(self.get(member.role)));
                write!(out, r#"<member type="{kind}" ref="{}" role="{role}"/>"#, member.id)
            })?;
        }
        writeln!(out, "</osm>")
    }
}

/// Writes what follows the attributes of an element: its parts, then its tags.
fn element<W: Write, P>(
    out: &mut W,
    name: &str,
    tags: Tags,
    parts: &[P],
    part: impl Fn(&mut W, &P) -> fmt::Result,
) -> fmt::Result {
    if parts.is_empty() && tags.all().next().is_none() {
        return writeln!(out, "/>");
    }
    write!(out, ">")?;
    parts.iter().try_for_each(|it| part(out, it))?;
    for (key, value) in tags.all() {
        write!(out, r#"<tag k="{}" v="{}"/>"#, Escaped(key), Escaped(value))?;
    }
    writeln!(out, "</{name}>")
}

/// Text as the value of an attribute.
struct Escaped<'a>(&'a str);

impl Display for Escaped<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for letter in self.0.chars() {
            match letter {
                '&' => f.write_str("&amp;")?,
                '<' => f.write_str("&lt;")?,
                '>' => f.write_str("&gt;")?,
                '"' => f.write_str("&quot;")?,
                // A reader replaces unescaped ones by spaces.
                '\n' | '\r' | '\t' => write!(f, "&#{};", letter as u32)?,
                letter => f.write_char(letter)?,
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_again_as_the_same() {
        let text = concat!(
            "<osm><MetaInfo driving_side='left'/><node id='-1' lat='49.25' lon='8.1' ele='-0.5'/>",
            "<node id='2' x='1e-7' y='123456.789012345'><tag k='a' v='&lt;&amp;&quot;&#10;>'/></node>",
            "<way id='3'/><way id='4'><nd ref='2'/></way><way id='5'><tag k='t' v=''/></way>",
            "<relation id='6'><member type='way' ref='4' role='l&gt;r'/></relation>",
            "<relation id='7'><member type='node' ref='2' role=''/><tag k='type' v='ä'/></relation></osm>",
        );
        let (document, _) = Document::parse(text.as_bytes()).unwrap();
        let written = document.write();
        let (again, problems) = Document::parse(written.as_bytes()).unwrap();
        assert!(problems.is_empty());
        assert_eq!(again.write(), written);
        assert_eq!(everything(&again), everything(&document));
        assert_eq!(everything(&again).len(), 2 + 3 + 2 + 1);
    }

    /// The contents of a document without its line numbers.
    fn everything(document: &Document) -> Vec<String> {
        let tags = |span| document.tags(span).all().collect::<Vec<_>>();
        let nodes = document.nodes.iter().map(|it| {
            let coordinates = [it.lat, it.lon, it.x, it.y, it.ele].map(|it| it.get());
            format!("{} {coordinates:?} {:?}", it.id, tags(it.tags))
        });
        let ways = document.ways.iter();
        let ways = ways.map(|it| format!("{} {:?} {:?}", it.id, document.nodes_of(it), tags(it.tags)));
        let relations = document.relations.iter().map(|it| {
            let members = document.members_of(it).iter();
            let members = members.map(|it| (it.id, document.get(it.kind), document.get(it.role)));
            format!("{} {:?} {:?}", it.id, members.collect::<Vec<_>>(), tags(it.tags))
        });
        let side = format!("{:?}", document.driving_side);
        nodes.chain(ways).chain(relations).chain([side]).collect()
    }
}
