//! Rows of a table as text, read from a stream without the file in memory.

use std::io::{self, BufRead};

use csv_core::{ReadRecordResult, Reader, ReaderBuilder};

use super::dialect::{Dialect, Separator};

/// Longest row that is read [B].
pub(super) const MAXIMUM_ROW: usize = 1 << 16;

/// The rows of a reader. Those without any value are skipped.
pub(crate) struct Rows<R> {
    from: R,
    reader: Reader,
    separator: Separator,
    /// The fields of a row, without separators and quotes.
    text: Vec<u8>,
    /// Where each of them ends in the text.
    ends: Vec<usize>,
}

/// A row.
pub(crate) struct Fields<'a> {
    text: &'a [u8],
    ends: &'a [usize],
    /// The line in the file where it begins, from 1 on.
    pub(crate) line: usize,
    /// Whether it is longer than [`MAXIMUM_ROW`]: then it has no fields.
    pub(crate) is_too_long: bool,
}

/// Where a row is that was read.
struct Place {
    line: usize,
    /// The number of its fields; `None` if it is too long.
    count: Option<usize>,
}

impl<R: BufRead> Rows<R> {
    /// The rows of `from`, from its beginning on.
    pub(crate) fn of(from: R, dialect: Dialect) -> Rows<R> {
        Rows {
            from,
            reader: ReaderBuilder::new().delimiter(dialect.separator.byte()).build(),
            separator: dialect.separator,
            text: vec![0; MAXIMUM_ROW],
            ends: vec![0; MAXIMUM_ROW],
        }
    }

    /// The next row; `None` after the last one.
    pub(crate) fn next(&mut self) -> io::Result<Option<Fields<'_>>> {
        while let Some(Place { line, count }) = self.read()? {
            let ends = count.unwrap_or(0);
            let length = self.ends[..ends].last().map_or(0, |it| *it);
            if count.is_none() || !self.text[..length].trim_ascii_start().is_empty() {
                let is_too_long = count.is_none();
                return Ok(Some(Fields { text: &self.text, ends: &self.ends[..ends], line, is_too_long }));
            }
        }
        Ok(None)
    }

    fn read(&mut self) -> io::Result<Option<Place>> {
        self.skip(|it| it.iter().position(|byte| !matches!(byte, b'\r' | b'\n')))?;
        let line = self.reader.line() as usize;
        let (mut length, mut count) = (0, 0);
        loop {
            let input = self.from.fill_buf()?;
            let (text, ends) = (&mut self.text[length..], &mut self.ends[count..]);
            let (result, used, written, ended) = self.reader.read_record(input, text, ends);
            self.from.consume(used);
            (length, count) = (length + written, count + ended);
            match result {
                ReadRecordResult::InputEmpty => {}
                ReadRecordResult::Record => break,
                ReadRecordResult::End => return Ok(None),
                ReadRecordResult::OutputFull | ReadRecordResult::OutputEndsFull => {
                    self.pass_over()?;
                    return Ok(Some(Place { line, count: None }));
                }
            }
        }
        if self.separator == Separator::Blanks {
            count = without_empty(&mut self.ends[..count]);
        }
        Ok(Some(Place { line, count: Some(count) }))
    }

    /// Goes on with the line after this one. Quotes that were never closed are forgotten.
    fn pass_over(&mut self) -> io::Result<()> {
        let line = self.reader.line();
        self.reader.reset();
        self.reader.set_line(line);
        self.skip(|it| memchr::memchr(b'\n', it))
    }

    /// Skips bytes up to where `end` finds the end, and counts their lines.
    fn skip(&mut self, end: impl Fn(&[u8]) -> Option<usize>) -> io::Result<()> {
        loop {
            let input = self.from.fill_buf()?;
            let found = end(input);
            let used = found.unwrap_or(input.len());
            let lines = memchr::memchr_iter(b'\n', &input[..used]).count() as u64;
            self.reader.set_line(self.reader.line() + lines);
            self.from.consume(used);
            if found.is_some() || used == 0 {
                return Ok(());
            }
        }
    }
}

impl<'a> Fields<'a> {
    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.ends.len()
    }

    /// The field at this place without blanks and quotes around it; empty beyond the last one.
    pub(crate) fn get(&self, at: usize) -> &'a [u8] {
        let from = if at == 0 { 0 } else { self.ends.get(at - 1).copied().unwrap_or(0) };
        self.ends.get(at).map_or(&[], |end| bare(&self.text[from..*end]))
    }

    /// All of them.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &'a [u8]> {
        (0..self.len()).map(|it| self.get(it))
    }

    /// The place of the first field with one of these names.
    pub(crate) fn place(&self, names: &[&str]) -> Option<usize> {
        self.iter().position(|it| names.iter().any(|name| it == name.as_bytes()))
    }

    /// The beginning of the row, for messages.
    pub(crate) fn excerpt(&self) -> String {
        let joined = self.iter().collect::<Vec<_>>().join(&b","[..]);
        String::from_utf8_lossy(&joined[..joined.len().min(200)]).into_owned()
    }
}

/// Moves the ends of fields that are not empty to the front; their number.
fn without_empty(ends: &mut [usize]) -> usize {
    let (mut last, mut count) = (0, 0);
    for at in 0..ends.len() {
        if ends[at] > last {
            last = ends[at];
            ends[count] = last;
            count += 1;
        }
    }
    count
}

/// A field without blanks and quotes around it.
fn bare(field: &[u8]) -> &[u8] {
    let field = field.trim_ascii();
    field.strip_prefix(b"\"").and_then(|it| it.strip_suffix(b"\"")).unwrap_or(field)
}
