//! Reads map files in whatever format they are.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

use flate2::read::MultiGzDecoder;

use crate::error::MapError;
use crate::foreign::Foreign;
use crate::format::{FORMATS, Format};
use crate::kind::{FileKind, is_compressed, start, uncompressed};
use crate::map::Map;
use crate::options::ReadOptions;
use crate::size::Size;

/// Reads the map file at `path` in the format that its extension names; a final `.gz` means that it is compressed.
///
/// # Errors
/// If it cannot be read, is of no known format or of another one than it is named after, breaks its format's rules, or
/// has no lanelet for vehicles.
pub fn load(path: &Path, options: &ReadOptions) -> Result<Map, MapError> {
    size_of(path)?;
    let format = format_of(path)?;
    let bytes = contents(path, options.largest)?;
    match FileKind::by_content(&bytes) {
        // Several formats have files that end in .xml.
        FileKind::Map(other) if other.matched(&uncompressed(path).to_ascii_lowercase()).is_some() => {
            (other.read)(&bytes, options)
        }
        FileKind::Map(other) if other.name != format.name => Err(misnamed(other)),
        FileKind::Foreign(foreign) => Err(not_read(foreign)),
        other @ (FileKind::Toml | FileKind::Csv | FileKind::Parquet) if format.begins.is_some() => {
            Err(other_kind(other, path, "content"))
        }
        _ => (format.read)(&bytes, options),
    }
}

/// The content of the file at `path`, unpacked if a final `.gz` says that it is compressed.
///
/// # Errors
/// If it cannot be read, is empty, or is larger than the `largest` size.
pub fn contents(path: &Path, largest: Size) -> Result<Vec<u8>, MapError> {
    let size = size_of(path)?;
    let bytes = if is_compressed(path) {
        unpacked(path, largest)?
    } else {
        admit(size, largest)?;
        let file = File::open(path).map_err(MapError::Unreadable)?;
        read_all(file, size).map_err(MapError::Unreadable)?
    };
    if bytes.is_empty() { Err(MapError::Empty) } else { Ok(bytes) }
}

/// The size of the file at `path` [B].
fn size_of(path: &Path) -> Result<u64, MapError> {
    let metadata = fs::metadata(path).map_err(|error| match error.kind() {
        io::ErrorKind::NotFound => MapError::Missing,
        _ => MapError::Unreadable(error),
    })?;
    if metadata.is_dir() { Err(MapError::Folder) } else { Ok(metadata.len()) }
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

/// The format that the name of a file says.
fn format_of(path: &Path) -> Result<&'static Format, MapError> {
    match FileKind::by_name(path) {
        FileKind::Map(format) => Ok(format),
        FileKind::Unknown => Err(other_kind(FileKind::by_content(&start(path)), path, "content")),
        by_name => Err(other_kind(by_name, path, "name")),
    }
}

/// The refusal of a file that is of this kind, as its name or its content tells.
fn other_kind(kind: FileKind, path: &Path, told_by: &'static str) -> MapError {
    let remedy = match (kind, told_by) {
        (FileKind::Map(format), _) => return misnamed(format),
        (FileKind::Foreign(foreign), _) => return not_read(foreign),
        (FileKind::Toml, "name") => "give the map itself, which a scenario names in its key map".into(),
        (FileKind::Toml, _) => "give the map itself, or let the name of a scenario end in .toml".into(),
        (FileKind::Csv | FileKind::Parquet, _) => {
            format!("give the map of its location, known are {}", known())
        }
        (FileKind::Xml | FileKind::Folder | FileKind::Unknown, _) => return unknown(path),
    };
    MapError::OtherKind { what: kind.to_string(), told_by, remedy }
}

fn misnamed(format: &Format) -> MapError {
    MapError::Misnamed { format: format.name, extension: format.extensions[0] }
}

fn not_read(foreign: &Foreign) -> MapError {
    MapError::Foreign { what: foreign.name, remedy: foreign.remedy }
}

fn unknown(path: &Path) -> MapError {
    let name = uncompressed(path);
    let found = name.rsplit_once('.').map_or(String::new(), |(_, extension)| extension.to_lowercase());
    MapError::UnknownFormat { found, known: known() }
}

/// The known formats with their extensions.
fn known() -> String {
    let list = |format: &Format| format!("{} (.{})", format.name, format.extensions.join(", ."));
    FORMATS.iter().map(list).collect::<Vec<_>>().join(", ")
}
