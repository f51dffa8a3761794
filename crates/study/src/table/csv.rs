//! Comma-separated values after RFC 4180, lines ended by a line feed.

use std::fs::File;
use std::io::{self, Write};

use super::{Cell, Cells, Column};

/// Text is collected up to this length before it is written [bytes].
const BUFFER: usize = 1 << 16;

/// Writes rows of cells that fit the columns.
pub(super) struct CsvSink {
    file: File,
    buffer: Vec<u8>,
}

impl CsvSink {
    pub(super) fn new(file: File, columns: &[Column]) -> CsvSink {
        let mut sink = CsvSink { file, buffer: Vec::with_capacity(2 * BUFFER) };
        for column in columns {
            sink.text(&column.name);
            sink.buffer.push(b',');
        }
        sink.end_line();
        sink
    }

    pub(super) fn row(&mut self, cells: &[Cell<'_>]) -> io::Result<()> {
        for cell in cells {
            match cell {
                Cell::F64(value) if value.is_nan() => {}
                Cell::F64(value) => self.buffer.extend(zmij::Buffer::new().format(*value).as_bytes()),
                Cell::I64(value) => self.buffer.extend(itoa::Buffer::new().format(*value).as_bytes()),
                Cell::Text(value) => self.text(value),
                Cell::Missing => {}
            }
            self.buffer.push(b',');
        }
        self.end_line();
        if self.buffer.len() >= BUFFER { self.flush() } else { Ok(()) }
    }

    pub(super) fn rows(&mut self, count: usize, columns: &[Cells<'_>]) -> io::Result<()> {
        let mut cells = Vec::with_capacity(columns.len());
        for row in 0..count {
            cells.clear();
            cells.extend(columns.iter().map(|it| it.get(row)));
            self.row(&cells)?;
        }
        Ok(())
    }

    pub(super) fn finish(mut self) -> io::Result<()> {
        self.flush()
    }

    /// Quoted where necessary; an empty text is quoted, too, because an empty field is a missing value.
    fn text(&mut self, value: &str) {
        let is_special = |byte: u8| matches!(byte, b',' | b'"' | b'\n' | b'\r');
        if value.is_empty() || value.bytes().any(is_special) {
            self.buffer.push(b'"');
            self.buffer.extend(value.replace('"', "\"\"").as_bytes());
            self.buffer.push(b'"');
        } else {
            self.buffer.extend(value.as_bytes());
        }
    }

    /// This replaces the comma after the last cell.
    fn end_line(&mut self) {
        self.buffer.pop();
        self.buffer.push(b'\n');
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.write_all(&self.buffer)?;
        self.buffer.clear();
        Ok(())
    }
}
