//! What a file is, as its name and its first bytes tell.

use std::borrow::Cow;
use std::fmt;
use std::fs::File;
use std::io::Read;
use std::path::Path;

use flate2::read::MultiGzDecoder;

use crate::foreign::Foreign;
use crate::format::{FORMATS, Format};

/// What a file is.
#[derive(Clone, Copy, Debug)]
pub enum FileKind {
    /// A map of this format, maybe compressed; maybe with a recording ([`Format::has_tracks`]).
    Map(&'static Format),
    /// A file of a known format that is not read as a map.
    Foreign(&'static Foreign),
    /// Another XML file.
    Xml,
    /// A table as text, such as a recording.
    Csv,
    /// A table as Parquet.
    Parquet,
    /// TOML: a scenario, a style, or what the columns of a table hold.
    Toml,
    /// A folder, such as one with the results of a run.
    Folder,
    /// Nothing that is known.
    Unknown,
}

/// Ending of the names of compressed files.
const COMPRESSED: &str = ".gz";
/// So many first bytes tell what a file is.
const ENOUGH: usize = 1 << 16;
/// The first bytes of Parquet.
const PARQUET: &[u8] = b"PAR1";

impl FileKind {
    /// What the file at `path` is by its name; by its first bytes if the name says nothing.
    pub fn of(path: &Path) -> FileKind {
        if path.is_dir() {
            return FileKind::Folder;
        }
        match FileKind::by_name(path) {
            FileKind::Unknown => FileKind::by_content(&start(path)),
            known => known,
        }
    }

    /// What a file with this name is; whether there is one does not matter.
    pub fn by_name(path: &Path) -> FileKind {
        let name = uncompressed(path).to_ascii_lowercase();
        let Some((_, extension)) = name.rsplit_once('.') else { return FileKind::Unknown };
        match extension {
            "csv" => FileKind::Csv,
            "parquet" => FileKind::Parquet,
            "toml" => FileKind::Toml,
            _ => {
                // Of `net.xml` and `xml` the longer one tells more.
                let matched = FORMATS.iter().filter_map(|it| Some((it.matched(&name)?, it)));
                let format = matched.reduce(|best, it| if it.0 > best.0 { it } else { best });
                format.map_or(FileKind::Unknown, |it| FileKind::Map(it.1))
            }
        }
    }

    /// What a file is that begins with these bytes.
    pub fn by_content(start: &[u8]) -> FileKind {
        let start = &start[..start.len().min(ENOUGH)];
        if let Some(format) = FORMATS.iter().find(|it| it.begins.is_some_and(|begins| begins(start))) {
            return FileKind::Map(format);
        }
        if let Some(foreign) = Foreign::of(start) {
            return FileKind::Foreign(foreign);
        }
        let text = String::from_utf8_lossy(start);
        let text = text.trim_start_matches('\u{feff}').trim_start();
        let line = |it: &&str| !it.is_empty() && !it.starts_with('#');
        let first = text.lines().map(str::trim).find(line).unwrap_or_default();
        match () {
            () if start.starts_with(PARQUET) => FileKind::Parquet,
            () if start.contains(&0) => FileKind::Unknown,
            () if text.starts_with('<') => FileKind::Xml,
            () if first.contains('=') || (first.starts_with('[') && first.ends_with(']')) => FileKind::Toml,
            () if first.contains([',', ';', '\t']) => FileKind::Csv,
            () => FileKind::Unknown,
        }
    }

    /// Whether it may be a recording that brings its own map.
    pub fn has_tracks(&self) -> bool {
        matches!(self, FileKind::Map(it) if it.has_tracks)
    }

    /// Whether it is a table, which as a recording needs the map of its location.
    pub fn is_table(&self) -> bool {
        matches!(self, FileKind::Csv | FileKind::Parquet)
    }
}

impl fmt::Display for FileKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FileKind::Map(format) => write!(f, "a {} map", format.name),
            FileKind::Foreign(format) => format.fmt(f),
            FileKind::Xml => f.write_str("XML of an unknown format"),
            FileKind::Csv => f.write_str("a table, such as a recording"),
            FileKind::Parquet => f.write_str("a Parquet table, such as a recording"),
            FileKind::Toml => f.write_str("a scenario or a style"),
            FileKind::Folder => f.write_str("a folder"),
            FileKind::Unknown => f.write_str("a file of an unknown kind"),
        }
    }
}

/// Whether the name of a file says that it is compressed.
pub fn is_compressed(path: &Path) -> bool {
    path.extension().is_some_and(|it| it.eq_ignore_ascii_case(&COMPRESSED[1..]))
}

/// The name of a file, without the ending of compressed ones.
pub fn uncompressed(path: &Path) -> Cow<'_, str> {
    let name = if is_compressed(path) { path.file_stem() } else { path.file_name() };
    name.unwrap_or_default().to_string_lossy()
}

/// The first bytes of a file, unpacked if it is compressed; none if it cannot be read.
pub(crate) fn start(path: &Path) -> Vec<u8> {
    let mut bytes = Vec::new();
    let read = File::open(path).and_then(|file| match is_compressed(path) {
        true => MultiGzDecoder::new(file).take(ENOUGH as u64).read_to_end(&mut bytes),
        false => file.take(ENOUGH as u64).read_to_end(&mut bytes),
    });
    read.map_or(Vec::new(), |_| bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_tells_what_a_file_is() {
        let by_name = |name: &str| FileKind::by_name(Path::new(name)).to_string();
        assert_eq!(by_name("maps/town.osm"), "a Lanelet2 map");
        assert_eq!(by_name("town.OSM.gz"), "a Lanelet2 map");
        assert_eq!(by_name("a.b/USA_1.xml"), "a CommonRoad map");
        assert_eq!(by_name("town.net.xml.gz"), "a SUMO map");
        assert_eq!(by_name("01_tracks.csv"), "a table, such as a recording");
        assert_eq!(by_name("trips.parquet"), "a Parquet table, such as a recording");
        assert_eq!(by_name("demo.toml"), "a scenario or a style");
        for name in ["osm", "town.oms", "a.b/town", "town.gz", ""] {
            assert_eq!(by_name(name), "a file of an unknown kind", "{name}");
        }
    }

    #[test]
    fn first_bytes_tell_what_a_file_is() {
        let by_content = |start: &str| FileKind::by_content(start.as_bytes()).to_string();
        assert_eq!(by_content("\u{feff}<?xml version='1.0'?>\n<!-- by hand -->\n<osm>"), "a Lanelet2 map");
        assert_eq!(by_content("<commonRoad a='"), "a CommonRoad map");
        assert_eq!(by_content("<?xml version='1.0'?>\n<OpenDRIVE>"), "an OpenDRIVE road network");
        assert_eq!(by_content("<!-- netconvert -->\n<net version='1.16'>"), "a SUMO map");
        assert_eq!(by_content("\0\0\0\x0e\n\tOSMHeader\x18"), "binary OpenStreetMap data (.pbf)");
        assert_eq!(by_content("<!DOCTYPE html><html>"), "XML of an unknown format");
        assert_eq!(by_content("# ours\n\nmap = \"town.osm\"\n"), "a scenario or a style");
        assert_eq!(by_content("[follow]\nmodel"), "a scenario or a style");
        assert_eq!(by_content("track_id,frame_id\n1,2"), "a table, such as a recording");
        assert_eq!(by_content("PAR1\0"), "a Parquet table, such as a recording");
        for start in ["", "\0a,b", "once upon a time"] {
            assert_eq!(by_content(start), "a file of an unknown kind", "{start:?}");
        }
    }

    #[test]
    fn recordings_with_maps_of_their_own_are_known() {
        let by_name = |name: &str| FileKind::by_name(Path::new(name));
        assert!(by_name("USA_1.xml").has_tracks() && !by_name("town.osm").has_tracks());
        assert!(by_name("a.csv").is_table() && !by_name("USA_1.xml").is_table());
    }
}
