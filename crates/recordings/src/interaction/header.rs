//! The header of a track file, which identifies the columns of its rows.

use super::row::{Flaw, Row};
use crate::error::RecordingError;

/// The columns that are read.
pub(super) const COLUMNS: [&str; 11] = [
    "track_id",
    "frame_id",
    "timestamp_ms",
    "agent_type",
    "x",
    "y",
    "vx",
    "vy",
    "psi_rad",
    "length",
    "width",
];
/// The first of them are required.
const REQUIRED: usize = 8;
/// Further columns are ignored.
const MAXIMUM_COLUMNS: usize = 256;
/// Maximum length of a row [B].
const MAXIMUM_LINE: usize = 1 << 16;

/// The contents of the columns of the file.
pub(super) struct Header {
    /// For each column of the file its index in [`COLUMNS`].
    meanings: Vec<Option<usize>>,
    /// Columns that every row has to have.
    required: usize,
}

impl Header {
    pub(super) fn of(line: &[u8]) -> Result<Header, RecordingError> {
        let line = &line[..line.len().min(MAXIMUM_LINE)];
        let mut meanings: Vec<Option<usize>> = line
            .split(|it| *it == b',')
            .take(MAXIMUM_COLUMNS)
            .map(|name| COLUMNS.iter().position(|it| it.as_bytes() == bare(name)))
            .collect();
        for column in 0..COLUMNS.len() {
            // Of columns with the same name the first counts.
            let same = meanings.iter_mut().filter(|it| **it == Some(column));
            same.skip(1).for_each(|it| *it = None);
        }
        if let Some(missing) = (0..REQUIRED).find(|it| !meanings.contains(&Some(*it))) {
            let found = String::from_utf8_lossy(&line[..line.len().min(200)]).into_owned();
            return Err(RecordingError::MissingColumn { column: COLUMNS[missing], found });
        }
        let is_required = |it: &Option<usize>| it.is_some_and(|column| column < REQUIRED);
        let required = meanings.iter().rposition(is_required).map_or(0, |it| it + 1);
        Ok(Header { meanings, required })
    }

    /// The row in `line`.
    pub(super) fn row(&self, line: &[u8]) -> Result<Row, Flaw> {
        if line.len() > MAXIMUM_LINE {
            let what = format!("it has {} bytes, the limit is {MAXIMUM_LINE}", line.len());
            return Err(Flaw { what, remedy: "end each row with a line feed" });
        }
        let mut fields: [&[u8]; COLUMNS.len()] = [&[]; COLUMNS.len()];
        let mut count = 0;
        for (field, meaning) in line.split(|it| *it == b',').zip(&self.meanings) {
            count += 1;
            if let Some(column) = meaning {
                fields[*column] = bare(field);
            }
        }
        if count < self.required {
            let what = format!("it has {count} fields, the header names at least {}", self.required);
            return Err(Flaw { what, remedy: "fill in all columns" });
        }
        Row::of(&fields)
    }
}

/// A field without blanks and quotes around it.
fn bare(field: &[u8]) -> &[u8] {
    let field = field.trim_ascii();
    field.strip_prefix(b"\"").and_then(|it| it.strip_suffix(b"\"")).unwrap_or(field)
}
