//! A Parquet file as the CSV for which it stands: a header with the names of its columns, and a line for each row.

use std::fs::File;
use std::io::{self, BufRead, Read, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};

use parquet::errors::ParquetError;
use parquet::file::reader::FileReader;
use parquet::record::reader::RowIter;
use parquet::record::{Field, Row};

use laneweave_study::sound;

use crate::error::RecordingError;

/// Lines are made in parts of this size [B].
const PART: usize = 1 << 16;

/// The lines of a Parquet file, made as they are read.
pub(crate) struct ParquetLines {
    rows: RowIter<'static>,
    made: Vec<u8>,
    /// What was read of them.
    read: usize,
}

impl ParquetLines {
    /// The lines of `file`.
    ///
    /// # Errors
    /// If it is damaged, or compressed in a way that is not supported.
    pub(crate) fn of(file: File) -> Result<ParquetLines, RecordingError> {
        let opened = guarded(|| {
            let reader = sound::open(file)?;
            let schema = reader.metadata().file_metadata().schema_descr();
            let mut header = Vec::new();
            for (number, column) in schema.columns().iter().enumerate() {
                header.extend((number > 0).then_some(b','));
                quoted(column.name(), &mut header);
            }
            header.push(b'\n');
            Ok((reader.into_iter(), header))
        });
        let (rows, header) = opened.map_err(|error| RecordingError::Parquet { what: error.to_string() })?;
        Ok(ParquetLines { rows, made: header, read: 0 })
    }

    /// Makes further lines.
    fn make(&mut self) -> io::Result<()> {
        (self.read, self.made) = (0, std::mem::take(&mut self.made));
        self.made.clear();
        while self.made.len() < PART {
            let rows = &mut self.rows;
            match guarded(|| rows.next().transpose()).map_err(io::Error::other)? {
                Some(row) => line(&row, &mut self.made)?,
                None => break,
            }
        }
        Ok(())
    }
}

impl Read for ParquetLines {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let count = self.fill_buf()?.read(into)?;
        self.consume(count);
        Ok(count)
    }
}

impl BufRead for ParquetLines {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        if self.read == self.made.len() {
            self.make()?;
        }
        Ok(&self.made[self.read..])
    }

    fn consume(&mut self, count: usize) {
        self.read += count;
    }
}

fn line(row: &Row, out: &mut Vec<u8>) -> io::Result<()> {
    for (number, (_, field)) in row.get_column_iter().enumerate() {
        if number > 0 {
            out.push(b',');
        }
        match field {
            Field::Null => {}
            Field::Str(text) => quoted(text, out),
            Field::Int(it) => write!(out, "{it}")?,
            Field::Long(it) => write!(out, "{it}")?,
            Field::Float(it) => write!(out, "{it}")?,
            Field::Double(it) => write!(out, "{it}")?,
            Field::TimestampMillis(it) | Field::TimestampMicros(it) => write!(out, "{it}")?,
            other => quoted(&other.to_string(), out),
        }
    }
    out.push(b'\n');
    Ok(())
}

/// Writes a text that may have separators and quotes in it.
fn quoted(text: &str, out: &mut Vec<u8>) {
    out.push(b'"');
    out.extend(text.replace('"', "\"\"").bytes());
    out.push(b'"');
}

/// What `read` returns. The reader of the crate panics on some damaged files: that is an error, too.
fn guarded<T>(read: impl FnOnce() -> Result<T, ParquetError>) -> Result<T, ParquetError> {
    let result = catch_unwind(AssertUnwindSafe(read));
    result.unwrap_or_else(|_| Err(sound::damaged()))
}
