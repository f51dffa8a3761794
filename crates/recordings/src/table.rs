//! Recordings as tables: CSV, one row for a road user in a frame, rows in any order, columns identified by name.
//!
//! A [`Layout`] says what the columns hold. Those of the datasets that we know are in [`datasets`](crate::datasets).
//! Where a table has no speeds or headings, they come from positions: a straight line is fitted by least squares to
//! those half a second before and after, and its slope is the velocity.

mod draft;
mod header;
mod known;
mod layout;
mod lines;
mod row;
mod times;

use std::io::BufRead;

use laneweave_maps::Problem;

use crate::error::RecordingError;
use crate::recording::Recording;
use draft::Draft;
use header::Header;
pub(crate) use header::bare;
pub use known::Known;
pub use layout::{AngleUnit, Axes, Columns, Layout, LengthUnit, Point, TimeUnit, Units};
use lines::MAXIMUM_LINE;
pub(crate) use lines::{Line, Lines};
use row::Flaw;

/// Reads a table of `layout`, with what is `known` from other files. Rows that cannot be used are left out and listed
/// as problems. The memory that it takes grows with the states, not with the text.
///
/// # Errors
/// If it cannot be read, a required column is missing, no row is left, or the times do not belong to frames at equal
/// distances.
pub fn read(
    file: impl BufRead,
    layout: &Layout,
    known: &Known,
) -> Result<(Recording, Vec<Problem>), RecordingError> {
    let mut lines = Lines::of(file);
    let first = lines.next()?.map_or_else(Vec::new, |it| it.text.to_vec());
    let first = first.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(&first);
    let header = Header::of(first, layout)?;
    let mut draft = Draft::of(layout, known);
    let mut same: Option<Vec<u8>> = None;
    while let Some(Line { text, number, more }) = lines.next()? {
        if text.is_empty() {
            continue;
        }
        if let Some(value) = header.same(text)
            && same.get_or_insert_with(|| value.to_vec()) != value
        {
            return Err(several(layout, same.as_deref().unwrap_or_default(), value, number));
        }
        let row = if more > 0 { Err(too_long(more)) } else { header.row(text) };
        draft.add(row, number);
    }
    draft.finish()
}

fn several(layout: &Layout, first: &[u8], other: &[u8], line: usize) -> RecordingError {
    let text = |it: &[u8]| String::from_utf8_lossy(&it[..it.len().min(40)]).into_owned();
    let column = layout.same.clone().unwrap_or_default();
    RecordingError::Several { line, column, first: text(first), other: text(other) }
}

fn too_long(more: u64) -> Flaw {
    let what = format!("it has {} bytes, the limit is {MAXIMUM_LINE}", MAXIMUM_LINE as u64 + more);
    Flaw { what, remedy: "end each row with a line feed" }
}
