//! The formats of map files, and reading a file in the one that its extension names.

use std::fs;
use std::io;
use std::path::Path;

use laneweave_network::{DrivingSide, Network};

use crate::commonroad;
use crate::error::MapError;
use crate::lanelet2;
use crate::problem::Problem;

/// A map that was read.
#[derive(Clone, Debug)]
pub struct Map {
    /// Its roads.
    pub network: Network,
    /// What could not be used as it stands, in order of lines.
    pub problems: Vec<Problem>,
    /// Latitude and longitude of the local frame's origin [°], if the map was projected.
    pub origin: Option<(f64, f64)>,
}

/// How to read a map.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ReadOptions {
    /// Latitude and longitude that become (0, 0) of the local frame [°]. Without it the place of the map's
    /// first node, rounded to 0.1°. Of no effect on maps with metric coordinates of their own.
    pub origin: Option<(f64, f64)>,
    /// On which side traffic drives. Without it what the map says, or else the right.
    pub driving_side: Option<DrivingSide>,
}

/// A format of map files.
#[derive(Clone, Copy, Debug)]
pub struct Format {
    /// Its name.
    pub name: &'static str,
    /// The extensions of its files, without the dot.
    pub extensions: &'static [&'static str],
    /// Reads the content of a file.
    pub read: fn(&[u8], &ReadOptions) -> Result<Map, MapError>,
}

/// The formats that can be read.
pub const FORMATS: &[Format] = &[
    Format { name: "Lanelet2", extensions: &["osm", "osm_xy"], read: lanelet2::read },
    Format { name: "CommonRoad", extensions: &["xml"], read: commonroad::read },
];

/// Largest file that is read [B].
pub(crate) const MAXIMUM_SIZE: u64 = 512 << 20;

/// Reads the map file at `path` in the format that its extension names.
///
/// # Errors
/// If it cannot be read, is of no known format, breaks its format's rules, or has no lanelet for vehicles.
pub fn load(path: &Path, options: &ReadOptions) -> Result<Map, MapError> {
    let metadata = fs::metadata(path).map_err(|error| match error.kind() {
        io::ErrorKind::NotFound => MapError::Missing,
        _ => MapError::Unreadable(error),
    })?;
    if metadata.is_dir() {
        return Err(MapError::Folder);
    }
    let format = format_of(path)?;
    if metadata.len() > MAXIMUM_SIZE {
        return Err(MapError::TooLarge { bytes: metadata.len(), limit: MAXIMUM_SIZE });
    }
    (format.read)(&fs::read(path).map_err(MapError::Unreadable)?, options)
}

fn format_of(path: &Path) -> Result<&'static Format, MapError> {
    let found = path.extension().map_or(String::new(), |it| it.to_string_lossy().to_ascii_lowercase());
    FORMATS.iter().find(|format| format.extensions.contains(&found.as_str())).ok_or_else(|| {
        let list = |format: &Format| format!("{} (.{})", format.name, format.extensions.join(", ."));
        let known = FORMATS.iter().map(list).collect::<Vec<_>>().join(", ");
        MapError::UnknownFormat { found, known }
    })
}
