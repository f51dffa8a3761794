//! Tables in files: typed columns, written row by row as CSV or Parquet.
//!
//! A schema is a constant array of columns, and a row the array of its cells:
//!
//! ```
//! use laneweave_study::{Cell, Column, Format, TableWriter};
//!
//! struct Passage<'a> {
//!     time_s: f64,
//!     vehicle: u32,
//!     class: &'a str,
//!     gap_m: Option<f64>,
//! }
//!
//! impl Passage<'_> {
//!     const COLUMNS: [Column; 4] =
//!         [Column::real("time_s"), Column::integer("vehicle"), Column::text("class"), Column::real("gap_m")];
//!
//!     fn cells(&self) -> [Cell<'_>; 4] {
//!         [self.time_s.into(), self.vehicle.into(), self.class.into(), self.gap_m.into()]
//!     }
//! }
//!
//! let path = std::env::temp_dir().join("laneweave-passages.csv");
//! let mut table = TableWriter::create(&path, Format::Csv, &Passage::COLUMNS)?;
//! table.row(&Passage { time_s: 1.5, vehicle: 7, class: "car", gap_m: None }.cells())?;
//! table.finish()?;
//! # let _ = std::fs::remove_file(&path);
//! # Ok::<(), laneweave_study::TableError>(())
//! ```

mod csv;
#[cfg(feature = "parquet")]
mod parquet;
mod partial;
mod read;
#[cfg(feature = "parquet")]
pub mod sound;
#[cfg(feature = "parquet")]
mod thrift;

use std::borrow::Cow;
use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

use self::csv::CsvSink;
#[cfg(feature = "parquet")]
use self::parquet::ParquetSink;

pub use self::partial::PartialFile;
pub use self::read::{ReadError, TextTable};

/// The type of the cells of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// 64-bit floating-point numbers.
    F64,
    /// 64-bit signed integers.
    I64,
    /// UTF-8 text.
    Text,
}

/// A column of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// Its name, with its unit by convention: `speed_mps`.
    pub name: Cow<'static, str>,
    /// The type of its cells.
    pub kind: Kind,
    /// Whether its values repeat, so that a dictionary saves space.
    pub repeats: bool,
}

impl Column {
    /// A column of floating-point numbers, most of which occur once.
    pub const fn real(name: &'static str) -> Column {
        Column { name: Cow::Borrowed(name), kind: Kind::F64, repeats: false }
    }

    /// A column of integers, which repeat.
    pub const fn integer(name: &'static str) -> Column {
        Column { name: Cow::Borrowed(name), kind: Kind::I64, repeats: true }
    }

    /// A column of text, which repeats.
    pub const fn text(name: &'static str) -> Column {
        Column { name: Cow::Borrowed(name), kind: Kind::Text, repeats: true }
    }

    /// A column with a name that is known only when the program runs, whose values repeat.
    pub const fn named(name: String, kind: Kind) -> Column {
        Column { name: Cow::Owned(name), kind, repeats: true }
    }

    /// The same column with values that repeat.
    #[must_use]
    pub const fn repeating(mut self) -> Column {
        self.repeats = true;
        self
    }
}

/// A simulated time [s] as it is written: rounded to the microsecond, without the rounding errors of its steps (1236
/// steps of 0.1 s are 123.60000000000001 s).
pub fn seconds(time: f64) -> f64 {
    (time * 1e6).round() / 1e6
}

/// One value of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cell<'a> {
    /// A number; NaN is written as missing.
    F64(f64),
    /// An integer.
    I64(i64),
    /// A text.
    Text(&'a str),
    /// No value: empty in CSV, null in Parquet. Fits every column.
    Missing,
}

impl Cell<'_> {
    fn fits(&self, kind: Kind) -> bool {
        match self {
            Cell::F64(_) => kind == Kind::F64,
            Cell::I64(_) => kind == Kind::I64,
            Cell::Text(_) => kind == Kind::Text,
            Cell::Missing => true,
        }
    }
}

impl From<f64> for Cell<'_> {
    fn from(value: f64) -> Self {
        Cell::F64(value)
    }
}

impl From<i64> for Cell<'_> {
    fn from(value: i64) -> Self {
        Cell::I64(value)
    }
}

impl From<u32> for Cell<'_> {
    fn from(value: u32) -> Self {
        Cell::I64(value.into())
    }
}

impl<'a> From<&'a str> for Cell<'a> {
    fn from(value: &'a str) -> Self {
        Cell::Text(value)
    }
}

impl<'a, T: Into<Cell<'a>>> From<Option<T>> for Cell<'a> {
    fn from(value: Option<T>) -> Self {
        value.map_or(Cell::Missing, Into::into)
    }
}

/// The values of one column in several rows; none is missing except NaN.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cells<'a> {
    /// Numbers; NaN is written as missing.
    F64(&'a [f64]),
    /// Integers.
    I64(&'a [i64]),
    /// For each row the index of its text in a list.
    Text(&'a [u32], &'a [&'a str]),
}

impl<'a> Cells<'a> {
    fn len(&self) -> usize {
        match self {
            Cells::F64(values) => values.len(),
            Cells::I64(values) => values.len(),
            Cells::Text(places, _) => places.len(),
        }
    }

    /// The value in a row.
    fn get(&self, row: usize) -> Cell<'a> {
        match self {
            Cells::F64(values) => values[row].into(),
            Cells::I64(values) => values[row].into(),
            Cells::Text(places, texts) => texts[places[row] as usize].into(),
        }
    }
}

/// The format of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Comma-separated values with a header; numbers in their shortest form that reads back exactly.
    Csv,
    /// Apache Parquet, uncompressed, repeating values by dictionary; with the feature `parquet`.
    #[cfg(feature = "parquet")]
    Parquet,
}

impl Format {
    /// The extension of its files.
    pub fn extension(self) -> &'static str {
        match self {
            Format::Csv => "csv",
            #[cfg(feature = "parquet")]
            Format::Parquet => "parquet",
        }
    }
}

/// Why a table cannot be written.
#[derive(Debug, Error)]
pub enum TableError {
    /// The file cannot be created.
    #[error("{}: cannot be created: {source}", path.display())]
    Create {
        /// The table's file.
        path: PathBuf,
        /// The error of the system.
        source: io::Error,
    },
    /// Writing fails.
    #[error("{}: cannot be written: {source}", path.display())]
    Write {
        /// The table's file.
        path: PathBuf,
        /// The error of the system.
        source: io::Error,
    },
    /// A row is too short or too long.
    #[error("{}: a row of {cells} cells for {columns} columns", path.display())]
    Width {
        /// The table's file.
        path: PathBuf,
        /// Cells of the row.
        cells: usize,
        /// Columns of the table.
        columns: usize,
    },
    /// A cell does not have the type of its column.
    #[error("{}: column {column} holds {kind:?}, not {cell}", path.display())]
    Cell {
        /// The table's file.
        path: PathBuf,
        /// Name of the column.
        column: String,
        /// The type of the column.
        kind: Kind,
        /// The cell.
        cell: String,
    },
}

/// Writes one table. Until [`TableWriter::finish`] the file is called `NAME.partial`; it is removed if the writer is
/// dropped before.
pub struct TableWriter {
    columns: Vec<Column>,
    /// This comes before the file, so that the file is closed when it is removed.
    sink: Sink,
    file: PartialFile,
}

enum Sink {
    Csv(CsvSink),
    #[cfg(feature = "parquet")]
    Parquet(Box<ParquetSink>),
}

impl TableWriter {
    /// Begins a table of `columns` that will be at `path` and replaces an existing file.
    ///
    /// # Errors
    /// If the file cannot be created or written.
    pub fn create(path: &Path, format: Format, columns: &[Column]) -> Result<TableWriter, TableError> {
        TableWriter::create_with(path, format, columns, &[])
    }

    /// The same with `notes` about the table, keys with their values, where the format has a place for them: in
    /// Parquet.
    ///
    /// # Errors
    /// If the file cannot be created or written.
    #[cfg_attr(not(feature = "parquet"), expect(unused_variables, reason = "CSV has no place for notes"))]
    pub fn create_with(
        path: &Path,
        format: Format,
        columns: &[Column],
        notes: &[(&str, &str)],
    ) -> Result<TableWriter, TableError> {
        let (file, output) = PartialFile::create(path)
            .map_err(|source| TableError::Create { path: path.to_owned(), source })?;
        let sink = match format {
            Format::Csv => Ok(Sink::Csv(CsvSink::new(output, columns))),
            #[cfg(feature = "parquet")]
            Format::Parquet => ParquetSink::new(output, columns, notes).map(|it| Sink::Parquet(Box::new(it))),
        };
        let sink = sink.map_err(|source| TableError::Write { path: path.to_owned(), source })?;
        Ok(TableWriter { columns: columns.to_vec(), sink, file })
    }

    /// Appends a row; it is written some thousands later.
    ///
    /// # Errors
    /// If the cells do not fit the columns, which leaves the table as it was; or if the file cannot be written.
    pub fn row(&mut self, cells: &[Cell<'_>]) -> Result<(), TableError> {
        self.check(cells)?;
        let written = match &mut self.sink {
            Sink::Csv(sink) => sink.row(cells),
            #[cfg(feature = "parquet")]
            Sink::Parquet(sink) => sink.row(cells),
        };
        written.map_err(|source| TableError::Write { path: self.file.target().to_owned(), source })
    }

    /// Appends several rows, given by their columns of the same length.
    ///
    /// # Errors
    /// If the cells do not fit the columns, which leaves the table as it was; or if the file cannot be written.
    pub fn rows(&mut self, columns: &[Cells<'_>]) -> Result<(), TableError> {
        let count = columns.first().map_or(0, Cells::len);
        if count == 0 {
            return Ok(());
        }
        let first: Vec<Cell> = columns.iter().filter(|it| it.len() == count).map(|it| it.get(0)).collect();
        self.check(&first)?;
        let written = match &mut self.sink {
            Sink::Csv(sink) => sink.rows(count, columns),
            #[cfg(feature = "parquet")]
            Sink::Parquet(sink) => sink.rows(count, columns),
        };
        written.map_err(|source| TableError::Write { path: self.file.target().to_owned(), source })
    }

    /// Writes what is left and gives the file its name.
    ///
    /// # Errors
    /// If the file cannot be written or renamed; it is removed then.
    pub fn finish(self) -> Result<(), TableError> {
        let TableWriter { sink, file, .. } = self;
        let path = file.target().to_owned();
        let written = match sink {
            Sink::Csv(sink) => sink.finish(),
            #[cfg(feature = "parquet")]
            Sink::Parquet(sink) => sink.finish(),
        };
        written.and_then(|()| file.complete()).map_err(|source| TableError::Write { path, source })
    }

    fn check(&self, cells: &[Cell<'_>]) -> Result<(), TableError> {
        if cells.len() != self.columns.len() {
            let path = self.file.target().to_owned();
            return Err(TableError::Width { path, cells: cells.len(), columns: self.columns.len() });
        }
        let misfit = self.columns.iter().zip(cells).find(|(column, cell)| !cell.fits(column.kind));
        misfit.map_or(Ok(()), |(column, cell)| {
            let path = self.file.target().to_owned();
            Err(TableError::Cell {
                path,
                column: column.name.to_string(),
                kind: column.kind,
                cell: format!("{cell:?}"),
            })
        })
    }
}
