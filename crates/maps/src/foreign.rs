//! Formats of road networks that are not read, told by their content.

use std::fmt;

use crate::xml;

/// A format of road networks that is not read.
#[derive(Clone, Copy, Debug)]
pub struct Foreign {
    /// What a file of it is, for users.
    pub name: &'static str,
    /// How to get a map from it that is read.
    pub remedy: &'static str,
    /// Whether a file that begins with these bytes is of this format.
    begins: fn(&[u8]) -> bool,
}

/// How a road network of another format becomes a map.
pub(crate) const CONVERT: &str = "convert it to CommonRoad (.xml) or Lanelet2 (.osm) first, for example with the CommonRoad Scenario \
                                  Designer (crdesigner)";

/// The formats that are known, but not read.
const ALL: &[Foreign] = &[
    Foreign {
        name: "an OpenDRIVE road network",
        remedy: CONVERT,
        begins: |it| xml::root(it) == Some("OpenDRIVE"),
    },
    Foreign { name: "a SUMO road network", remedy: CONVERT, begins: |it| xml::root(it) == Some("net") },
    Foreign {
        name: "binary OpenStreetMap data (.pbf)",
        remedy: "a Lanelet2 map becomes .osm by `osmium cat IN.osm.pbf -o OUT.osm`, and a street map is first converted to lanes, for \
                 example with the CommonRoad Scenario Designer (crdesigner)",
        begins: |it| it.get(4..).is_some_and(|it| it.starts_with(b"\x0a\x09OSMHeader")),
    },
];

impl Foreign {
    /// The format of a file that begins with these bytes.
    pub(crate) fn of(start: &[u8]) -> Option<&'static Foreign> {
        ALL.iter().find(|it| (it.begins)(start))
    }
}

impl fmt::Display for Foreign {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)
    }
}
