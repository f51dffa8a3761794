//! Formats that are not read as maps, told by their content.

use std::fmt;

use crate::xml;

/// A format that is not read as a map.
#[derive(Clone, Copy, Debug)]
pub struct Foreign {
    /// What a file of it is, for users.
    pub name: &'static str,
    /// How to get a map from it that is read.
    pub remedy: &'static str,
    /// Whether a file that begins with these bytes is of this format.
    begins: fn(&[u8]) -> bool,
}

/// How a street map becomes a map with lanes.
pub(crate) const FROM_STREETS: &str =
    "make a net of SUMO of it, which is read: netconvert --osm-files IN.osm -o OUT.net.xml";

/// The formats that are known, but not read as maps.
const ALL: &[Foreign] = &[
    Foreign {
        name: "a configuration of SUMO",
        remedy: "run it with `laneweave run`, or give the net that it names in net-file",
        begins: |it| matches!(xml::root(it), Some("configuration" | "sumoConfiguration")),
    },
    Foreign {
        name: "a file with vehicles or other additions to a net of SUMO",
        remedy: "name it in a configuration (.sumocfg) beside the net, and run that with `laneweave run`",
        begins: |it| matches!(xml::root(it), Some("routes" | "additional")),
    },
    Foreign {
        name: "an OpenDRIVE road network",
        remedy: "make a net of SUMO of it, which is read: netconvert --opendrive-files IN.xodr -o OUT.net.xml",
        begins: |it| xml::root(it) == Some("OpenDRIVE"),
    },
    Foreign {
        name: "binary OpenStreetMap data (.pbf)",
        remedy: "a Lanelet2 map becomes .osm by `osmium cat IN.osm.pbf -o OUT.osm`, and a street map a net of SUMO by \
                 `netconvert --osm-files OUT.osm -o OUT.net.xml`",
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
