//! The header of a table, which identifies the columns of its rows.

use super::layout::{Field, Layout};
use super::row::{Flaw, Row};
use crate::error::RecordingError;

/// Further columns are ignored.
const MAXIMUM_COLUMNS: usize = 256;

/// The number of fields.
const FIELDS: usize = Field::ALL.len();

/// What the columns of a file hold.
pub(super) struct Header<'a> {
    layout: &'a Layout,
    /// For each column of the file its field.
    meanings: Vec<Option<Field>>,
    /// Columns that every row has to have.
    required: usize,
    /// The place of the column that has the same value in all rows, if there is one.
    same: Option<usize>,
}

impl<'a> Header<'a> {
    pub(super) fn of(line: &[u8], layout: &'a Layout) -> Result<Header<'a>, RecordingError> {
        let named = |name: &[u8]| {
            let is_it = |it: &&Field| layout.columns.name(**it).is_some_and(|it| it.as_bytes() == name);
            Field::ALL.iter().find(is_it).copied()
        };
        let names = line.split(|it| *it == b',').take(MAXIMUM_COLUMNS);
        let mut meanings: Vec<Option<Field>> = names.map(|it| named(bare(it))).collect();
        for field in Field::ALL {
            // Of columns with the same name the first counts.
            let same = meanings.iter_mut().filter(|it| **it == Some(field));
            same.skip(1).for_each(|it| *it = None);
        }
        for field in Field::ALL.into_iter().filter(|it| !it.may_be_missing()) {
            if let Some(name) = layout.columns.name(field)
                && !meanings.contains(&Some(field))
            {
                let found = String::from_utf8_lossy(&line[..line.len().min(200)]).into_owned();
                return Err(RecordingError::MissingColumn { column: name.to_owned(), found });
            }
        }
        let is_required = |it: &Option<Field>| it.is_some_and(|it| !it.may_be_missing());
        let required = meanings.iter().rposition(is_required).map_or(0, |it| it + 1);
        let mut names = line.split(|it| *it == b',').take(MAXIMUM_COLUMNS);
        let same = layout.same.as_ref().and_then(|same| names.position(|it| bare(it) == same.as_bytes()));
        Ok(Header { layout, meanings, required, same })
    }

    /// The value of the column that has the same one in all rows; `None` if there is no such column.
    pub(super) fn same<'l>(&self, line: &'l [u8]) -> Option<&'l [u8]> {
        line.split(|it| *it == b',').nth(self.same?).map(bare)
    }

    /// The row in `line`.
    pub(super) fn row(&self, line: &[u8]) -> Result<Row, Flaw> {
        let mut fields: [&[u8]; FIELDS] = [&[]; FIELDS];
        let mut count = 0;
        for (field, meaning) in line.split(|it| *it == b',').zip(&self.meanings) {
            count += 1;
            if let Some(it) = meaning {
                fields[*it as usize] = bare(field);
            }
        }
        if count < self.required {
            let what = format!("it has {count} fields, the header names at least {}", self.required);
            return Err(Flaw { what, remedy: "fill in all columns" });
        }
        Row::of(&fields, self.layout)
    }
}

/// A field without blanks and quotes around it.
pub(crate) fn bare(field: &[u8]) -> &[u8] {
    let field = field.trim_ascii();
    field.strip_prefix(b"\"").and_then(|it| it.strip_suffix(b"\"")).unwrap_or(field)
}
