//! Tables read from files: all cells as texts, as they would stand in CSV.

use std::fs;
use std::io;
use std::path::Path;

use thiserror::Error;

/// A table that was read from a file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TextTable {
    /// The names of its columns.
    pub columns: Vec<String>,
    /// Its rows, each with a cell for each column; `None`: the value is missing.
    pub rows: Vec<Vec<Option<String>>>,
}

/// Why a table cannot be read.
#[derive(Debug, Error)]
pub enum ReadError {
    /// The system refuses to read the file.
    #[error("cannot be read: {0}")]
    File(#[from] io::Error),
    /// The name of the file is not that of a table.
    #[error("by its name this is no table; give a file whose name ends with {FORMATS}")]
    Name,
    /// The file is no such table.
    #[error("{0}")]
    Content(String),
    /// A row is not like the header.
    #[error("{what}")]
    Row {
        /// Its number, counted from 1 without the header.
        row: usize,
        /// What is wrong with it.
        what: String,
    },
}

#[cfg(feature = "parquet")]
const FORMATS: &str = ".csv or .parquet";
#[cfg(not(feature = "parquet"))]
const FORMATS: &str = ".csv";

impl TextTable {
    /// The table at `path`, whose format is that of its extension.
    ///
    /// # Errors
    /// If it cannot be read, or is no table of this format.
    pub fn read(path: &Path) -> Result<TextTable, ReadError> {
        let extension = path.extension().map(|it| it.to_string_lossy().to_lowercase());
        match extension.as_deref() {
            Some("csv") => TextTable::of_csv(&fs::read_to_string(path)?),
            #[cfg(feature = "parquet")]
            Some("parquet") => super::parquet::read(fs::File::open(path)?),
            _ => Err(ReadError::Name),
        }
    }

    /// The place of the column called `name`.
    pub fn column(&self, name: &str) -> Option<usize> {
        self.columns.iter().position(|it| it == name)
    }

    /// The table in comma-separated values after RFC 4180. An empty field is missing, a quoted empty one is not.
    fn of_csv(text: &str) -> Result<TextTable, ReadError> {
        let mut rest = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut table = TextTable::default();
        while !rest.is_empty() {
            let row = table.rows.len() + usize::from(!table.columns.is_empty());
            let (cells, left) = line(rest).map_err(|what| ReadError::Row { row, what })?;
            rest = left;
            // An empty line is no row.
            if cells == [None] {
                continue;
            }
            if table.columns.is_empty() {
                table.columns = cells.into_iter().map(Option::unwrap_or_default).collect();
                continue;
            }
            let (cells_count, columns) = (cells.len(), table.columns.len());
            if cells_count != columns {
                let what = format!("{cells_count} cells in a table of {columns} columns");
                return Err(ReadError::Row { row, what });
            }
            table.rows.push(cells);
        }
        Ok(table)
    }
}

/// The cells of the first line of `text`, and the text after it.
fn line(mut text: &str) -> Result<(Vec<Option<String>>, &str), String> {
    let mut cells = Vec::new();
    loop {
        let (cell, rest) = cell(text)?;
        cells.push(cell);
        match rest.strip_prefix(',') {
            Some(more) => text = more,
            None => {
                let rest = rest.strip_prefix('\r').unwrap_or(rest);
                return match rest.strip_prefix('\n') {
                    Some(left) => Ok((cells, left)),
                    None if rest.is_empty() => Ok((cells, rest)),
                    None => Err("text behind a quoted cell".into()),
                };
            }
        }
    }
}

/// The first cell of `text`, and the text after it.
fn cell(text: &str) -> Result<(Option<String>, &str), String> {
    let Some(quoted) = text.strip_prefix('"') else {
        let end = text.find([',', '\n', '\r']).unwrap_or(text.len());
        let (cell, rest) = text.split_at(end);
        return Ok(((!cell.is_empty()).then(|| cell.to_owned()), rest));
    };
    let (mut cell, mut left) = (String::new(), quoted);
    loop {
        let (part, rest) = left.split_once('"').ok_or("a quotation mark is not closed")?;
        cell += part;
        match rest.strip_prefix('"') {
            // Two quotation marks stand for one.
            Some(more) => {
                cell.push('"');
                left = more;
            }
            None => return Ok((Some(cell), rest)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_may_be_missing_empty_or_quoted() {
        let text = "\u{feff}a,b,c\r\n1,,\"\"\r\n\n\"x,\"\"y\"\"\n\",2,3";
        let table = TextTable::of_csv(text).unwrap();
        assert_eq!(table.columns, ["a", "b", "c"]);
        let some = |it: &str| Some(it.to_owned());
        assert_eq!(table.rows[0], [some("1"), None, some("")]);
        assert_eq!(table.rows[1], [some("x,\"y\"\n"), some("2"), some("3")]);
        assert_eq!(table.rows.len(), 2);
    }

    #[test]
    fn a_wrong_row_is_named() {
        let refused = |text: &str| match TextTable::of_csv(text) {
            Err(ReadError::Row { row, what }) => (row, what),
            other => panic!("{other:?}"),
        };
        assert_eq!(refused("a,b\n1,2\n3\n"), (2, "1 cells in a table of 2 columns".into()));
        assert_eq!(refused("a,b\n1,\"2\n"), (1, "a quotation mark is not closed".into()));
        assert_eq!(refused("a,b\n\"1\"x,2\n"), (1, "text behind a quoted cell".into()));
        assert_eq!(refused("\"a"), (0, "a quotation mark is not closed".into()));
    }
}
