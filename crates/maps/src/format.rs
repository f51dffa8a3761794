//! The formats of map files.

pub mod commonroad;
pub mod lanelet2;
pub mod sumo;

use crate::drawing::Drawing;
use crate::error::MapError;
use crate::map::Map;
use crate::options::ReadOptions;
use crate::xml;

/// A format of map files.
#[derive(Clone, Copy, Debug)]
pub struct Format {
    /// The name of the format, for users.
    pub name: &'static str,
    /// The extensions of its files, without the dot.
    pub extensions: &'static [&'static str],
    /// Whether a file that begins with these bytes is of this format, whatever its name; `None` if first bytes cannot
    /// tell that.
    pub begins: Option<fn(&[u8]) -> bool>,
    /// Whether its files may hold a recording beside the map.
    pub has_tracks: bool,
    /// Reads the content of a file.
    pub read: fn(&[u8], &ReadOptions) -> Result<Map, MapError>,
    /// Writes the content of a file, if the program writes this format.
    pub write: Option<fn(&Drawing) -> String>,
}

impl Format {
    /// The length of the longest of its extensions with which the name of a file ends.
    pub(crate) fn matched(&self, name: &str) -> Option<usize> {
        let ends = |it: &&&str| name.strip_suffix(**it).is_some_and(|it| it.ends_with('.'));
        self.extensions.iter().filter(ends).map(|it| it.len()).max()
    }
}

/// The formats that can be read.
pub const FORMATS: &[Format] = &[
    Format {
        name: "Lanelet2",
        extensions: &["osm", "osm_xy"],
        begins: Some(|it| xml::root(it) == Some("osm")),
        has_tracks: false,
        read: lanelet2::read,
        write: Some(lanelet2::write),
    },
    Format {
        name: "CommonRoad",
        extensions: &["xml"],
        begins: Some(|it| xml::root(it) == Some("commonRoad")),
        has_tracks: true,
        read: commonroad::read,
        write: None,
    },
    Format {
        name: "SUMO",
        extensions: &["net.xml", "xml"],
        begins: Some(|it| xml::root(it) == Some("net")),
        has_tracks: false,
        read: sumo::read,
        write: None,
    },
];
