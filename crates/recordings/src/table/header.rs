//! The header of a table, which identifies the columns of its rows.

use super::dialect::Commas;
use super::layout::{Field, Layout};
use super::row::{Flaw, Row};
use super::rows::Fields;
use crate::error::RecordingError;

/// The number of fields.
const FIELDS: usize = Field::ALL.len();

/// What the columns of a file hold.
pub(super) struct Header<'a> {
    layout: &'a Layout,
    commas: Commas,
    /// Whether the table has one: else its first row is one of data.
    is_written: bool,
    /// For each field its column in the file: the first with its name.
    places: [Option<usize>; FIELDS],
    /// Columns that every row has to have.
    required: usize,
    /// The place of the column that has the same value in all rows, if there is one.
    same: Option<usize>,
}

impl<'a> Header<'a> {
    /// The header of a table with this first row, which may be its header.
    pub(super) fn of(
        first: &Fields,
        layout: &'a Layout,
        commas: Commas,
    ) -> Result<Header<'a>, RecordingError> {
        let assumed = layout.header.as_ref().filter(|_| first.place(&[&layout.columns.track]).is_none());
        let place = |name: &str| match assumed {
            Some(names) => names.iter().position(|it| it == name),
            None => first.place(&[name]),
        };
        let places = Field::ALL.map(|it| layout.columns.name(it).and_then(place));
        let needed = || Field::ALL.into_iter().filter(|it| !it.may_be_missing());
        let missing = needed().filter(|it| places[*it as usize].is_none());
        if let Some(column) = missing.filter_map(|it| layout.columns.name(it)).next() {
            return Err(RecordingError::MissingColumn { column: column.to_owned(), found: first.excerpt() });
        }
        let required = needed().filter_map(|it| places[it as usize]).max().map_or(0, |it| it + 1);
        let same = layout.same.as_deref().and_then(place);
        Ok(Header { layout, commas, is_written: assumed.is_none(), places, required, same })
    }

    /// Whether the table has one: else its first row is one of data.
    pub(super) fn is_written(&self) -> bool {
        self.is_written
    }

    /// The value of the column that has the same one in all rows; `None` if there is no such column.
    pub(super) fn same<'r>(&self, row: &Fields<'r>) -> Option<&'r [u8]> {
        self.same.map(|it| row.get(it))
    }

    /// What a row says.
    pub(super) fn row(&self, row: &Fields) -> Result<Row, Flaw> {
        if row.len() < self.required {
            let what = format!("it has {} fields, the header names at least {}", row.len(), self.required);
            return Err(Flaw { what, remedy: "fill in all columns" });
        }
        let fields = self.places.map(|it| it.map_or(&[][..], |at| row.get(at)));
        Row::of(&fields, self.layout, self.commas)
    }
}
