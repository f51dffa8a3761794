//! Recordings as tables: CSV, one row for a road user in a frame, rows in any order, columns identified by name.
//!
//! A [`Layout`] says what the columns hold. Those of the datasets that we know are in [`datasets`](crate::datasets).
//! Where a table has no speeds or headings, they come from positions: a straight line is fitted by least squares to
//! those half a second before and after, and its slope is the velocity.

mod dialect;
mod draft;
mod header;
mod id;
mod known;
mod layout;
mod row;
mod rows;
mod times;
mod unused;

use std::io::BufRead;

use laneweave_maps::Problem;

use crate::error::RecordingError;
use crate::recording::Recording;
pub(crate) use dialect::Dialect;
use draft::Draft;
use header::Header;
pub use id::Id;
pub use known::Known;
pub use layout::{AngleUnit, Axes, Columns, Layout, LengthUnit, Point, TimeUnit, Units};
use row::Flaw;
pub(crate) use rows::Fields;
use rows::{MAXIMUM_ROW, Rows};
pub(crate) use times::in_range;
pub(crate) use unused::file_beside;

/// Reads a table of `layout`, with what is `known` from other files. Rows that cannot be used are left out and listed
/// as problems. The memory that it takes grows with the states, not with the text.
///
/// # Errors
/// If it cannot be read, a required column is missing, no row is left, or the times do not belong to frames at equal
/// distances.
pub fn read(
    mut file: impl BufRead,
    layout: &Layout,
    known: &Known,
) -> Result<(Recording, Vec<Problem>), RecordingError> {
    let start = file.fill_buf()?;
    let dialect = Dialect::of(start);
    let header = Dialect::first_row(start, |it| {
        let header = Header::of(it, layout, dialect.commas)?;
        let unused = if header.is_written() { unused::columns(it, layout) } else { None };
        Ok::<_, RecordingError>((header, unused))
    });
    let (header, unused) = header.ok_or(RecordingError::EmptyFile)??;
    let mut rows = Rows::of(file, dialect);
    if header.is_written() {
        rows.next()?;
    }
    let mut draft = Draft::of(layout, known);
    let mut same: Option<Vec<u8>> = None;
    while let Some(row) = rows.next()? {
        if let Some(value) = header.same(&row)
            && same.get_or_insert_with(|| value.to_vec()) != value
        {
            return Err(several(layout, same.as_deref().unwrap_or_default(), value, row.line));
        }
        draft.add(if row.is_too_long { Err(too_long()) } else { header.row(&row) }, row.line);
    }
    let (recording, problems) = draft.finish()?;
    Ok((recording, unused.into_iter().chain(problems).collect()))
}

fn several(layout: &Layout, first: &[u8], other: &[u8], line: usize) -> RecordingError {
    let text = |it: &[u8]| String::from_utf8_lossy(&it[..it.len().min(40)]).into_owned();
    let column = layout.same.clone().unwrap_or_default();
    RecordingError::Several { line, column, first: text(first), other: text(other) }
}

fn too_long() -> Flaw {
    let what = format!("it has more than {MAXIMUM_ROW} bytes");
    Flaw { what, remedy: "end each row with a line feed, and close every quote" }
}
