//! The formats of map files, and a reader that takes the format from the extension.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

use flate2::read::MultiGzDecoder;

use crate::commonroad;
use crate::error::MapError;
use crate::lanelet2;
use crate::map::Map;
use crate::options::ReadOptions;
use crate::size::Size;

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
