//! Recordings in files, in whatever format they are.

use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;

use laneweave_maps::{FileKind, Problem};

use crate::commonroad;
use crate::datasets::Dataset;
use crate::error::RecordingError;
#[cfg(feature = "parquet")]
use crate::parquet::ParquetLines;
use crate::recording::Recording;
use crate::table::{Dialect, Known, Layout, file_beside, read};

/// Size of the parts in which a table is read [B].
const PART: usize = 1 << 20;

/// Reads the recording in the file `path`: CommonRoad (`.xml`), or a table (CSV, Parquet). A table has the columns of a
/// dataset that we know, or is of `layout`.
///
/// # Errors
/// If it cannot be read, or is of no format that we know.
pub fn open(path: &Path, layout: Option<&Layout>) -> Result<(Recording, Vec<Problem>), RecordingError> {
    let mut file = BufReader::with_capacity(PART, File::open(path)?);
    let start = file.fill_buf()?;
    if start.is_empty() {
        return Err(RecordingError::EmptyFile);
    }
    match FileKind::by_content(start) {
        FileKind::Parquet => parquet(path, layout),
        // Bytes that are no text would be shown unchanged in the message about them.
        _ if start.contains(&0) => Err(RecordingError::NoText),
        kind @ FileKind::Map(format) if !format.has_tracks => Err(RecordingError::OtherKind {
            what: kind.to_string(),
            remedy: "give it with --map, and the recording in its place",
        }),
        FileKind::Map(_) | FileKind::Foreign(_) | FileKind::Xml => {
            let mut bytes = Vec::new();
            file.take(commonroad::MAXIMUM_SIZE + 1).read_to_end(&mut bytes)?;
            commonroad::read(&bytes)
        }
        kind @ FileKind::Toml if layout.is_none() => Err(RecordingError::OtherKind {
            what: kind.to_string(),
            remedy: "give the recording, and with --columns what its columns hold",
        }),
        _ => table(file, path, layout),
    }
}

#[cfg(feature = "parquet")]
fn parquet(path: &Path, layout: Option<&Layout>) -> Result<(Recording, Vec<Problem>), RecordingError> {
    // Whatever cannot be read of it is said of the format.
    table(ParquetLines::of(File::open(path)?)?, path, layout).map_err(|error| match error {
        RecordingError::Unreadable { what } => RecordingError::Parquet { what },
        other => other,
    })
}

#[cfg(not(feature = "parquet"))]
fn parquet(_: &Path, _: Option<&Layout>) -> Result<(Recording, Vec<Problem>), RecordingError> {
    Err(RecordingError::Parquet { what: "this program was built without it".into() })
}

/// Reads a table from `file`, which is at `path`.
fn table(
    mut file: impl BufRead,
    path: &Path,
    layout: Option<&Layout>,
) -> Result<(Recording, Vec<Problem>), RecordingError> {
    let mut problems: Vec<Problem> = file_beside(path, layout.is_some()).into_iter().collect();
    if let Some(layout) = layout {
        let (recording, more) = read(file, layout, &Known::default())?;
        problems.extend(more);
        return Ok((recording, problems));
    }
    let start = file.fill_buf()?;
    let Some(dataset) = Dataset::of_start(start) else {
        return Err(RecordingError::UnknownTable {
            found: Dialect::first_row(start, |it| it.excerpt()).unwrap_or_default(),
            known: Dataset::ALL.map(Dataset::name).join("; "),
        });
    };
    let (known, missing) =
        if dataset.has_other_files() { Known::beside(path)? } else { (Known::default(), Vec::new()) };
    let (recording, more) = read(file, &dataset.layout(), &known)?;
    problems.extend(missing.into_iter().chain(more));
    Ok((recording, problems))
}
