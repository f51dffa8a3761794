//! The formats of map files, and a reader that takes the format from the extension.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

use flate2::read::MultiGzDecoder;

use laneweave_network::{DrivingSide, LaneUse, Network};

use crate::commonroad;
use crate::contents::Contents;
use crate::error::MapError;
use crate::graph::Graph;
use crate::lanelet2;
use crate::problem::Problem;
use crate::rule::Rule;
use crate::size::Size;

/// A map that was read.
#[derive(Clone, Debug)]
pub struct Map {
    /// Its roads.
    pub network: Network,
    /// Where vehicles may go from each lanelet.
    pub graph: Graph,
    /// The rules of traffic, beside the lanelets themselves.
    pub rules: Vec<Rule>,
    /// The other contents of the file.
    pub contents: Contents,
    /// Elements that could not be used unchanged, in order of lines.
    pub problems: Vec<Problem>,
    /// Latitude and longitude of the local frame's origin [°], if the map was projected.
    pub origin: Option<(f64, f64)>,
}

/// How to read a map.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ReadOptions {
    /// Latitude and longitude that become (0, 0) of the local frame [°]. Without it, the place of the map's first
    /// node, rounded to 0.1°. It has no effect on maps with metric coordinates of their own.
    pub origin: Option<(f64, f64)>,
    /// The law whose speed limits apply where the map gives none.
    pub law: Law,
    /// On which side traffic drives. Without it, the map decides, or else the right.
    pub driving_side: Option<DrivingSide>,
    /// Largest size of its text, unpacked if it is compressed, up to [`Size::MAXIMUM`].
    pub largest: Size,
}

/// The traffic law that applies on a map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Law {
    /// That of Germany.
    #[default]
    Germany,
    /// That of most of the United States.
    UnitedStates,
}

impl Law {
    /// Which lanes it wants drivers to use. Many states ask only slower traffic to keep to the slow side; none of that
    /// is read here.
    pub fn lane_use(self) -> LaneUse {
        match self {
            Law::Germany => LaneUse::SlowSide,
            Law::UnitedStates => LaneUse::Free,
        }
    }
}

/// A format of map files.
#[derive(Clone, Copy, Debug)]
pub struct Format {
    /// The name of the format, for users.
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

/// Ending of the names of compressed files.
const COMPRESSED: &str = ".gz";

/// Reads the map file at `path` in the format that its extension names; a final `.gz` means that it is compressed.
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
    let name = path.file_name().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    let format = format_of(name.strip_suffix(COMPRESSED).unwrap_or(&name))?;
    let bytes = if name.ends_with(COMPRESSED) {
        unpacked(path, options.largest)?
    } else {
        admit(metadata.len(), options.largest)?;
        let file = File::open(path).map_err(MapError::Unreadable)?;
        read_all(file, metadata.len()).map_err(MapError::Unreadable)?
    };
    if bytes.is_empty() {
        return Err(MapError::Empty);
    }
    (format.read)(&bytes, options)
}

/// The text of the compressed file at `path`. It is unpacked twice: the first time only to get its size, so that a
/// file that is too large takes no memory.
fn unpacked(path: &Path, largest: Size) -> Result<Vec<u8>, MapError> {
    let open = || File::open(path).map(MultiGzDecoder::new).map_err(MapError::Unreadable);
    let size = io::copy(&mut open()?.take(largest.0 + 1), &mut io::sink()).map_err(MapError::Compressed)?;
    admit(size, largest)?;
    read_all(open()?, size).map_err(MapError::Compressed)
}

fn admit(size: u64, largest: Size) -> Result<(), MapError> {
    if size > largest.0 { Err(MapError::TooLarge { largest }) } else { Ok(()) }
}

/// At most so many bytes of the content of `source`.
fn read_all(source: impl Read, size: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::with_capacity(size as usize);
    source.take(size).read_to_end(&mut bytes)?;
    Ok(bytes)
}

fn format_of(name: &str) -> Result<&'static Format, MapError> {
    let found = Path::new(name).extension().map_or(String::new(), |it| it.to_string_lossy().into_owned());
    FORMATS.iter().find(|format| format.extensions.contains(&found.as_str())).ok_or_else(|| {
        let list = |format: &Format| format!("{} (.{})", format.name, format.extensions.join(", ."));
        let known = FORMATS.iter().map(list).collect::<Vec<_>>().join(", ");
        MapError::UnknownFormat { found, known }
    })
}
