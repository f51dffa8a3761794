//! Lines of a file, without the file in memory.

use std::io::{self, BufRead};

/// Longest line that is read [B].
pub(super) const MAXIMUM_LINE: usize = 1 << 16;

/// The lines of a reader.
pub(crate) struct Lines<R> {
    from: R,
    line: Vec<u8>,
    number: usize,
}

/// A line of a file.
pub(crate) struct Line<'a> {
    /// Without its end; at most [`MAXIMUM_LINE`] of it.
    pub(crate) text: &'a [u8],
    /// Number, from 1 on.
    pub(crate) number: usize,
    /// Bytes in the file beyond the text.
    pub(crate) more: u64,
}

impl<R: BufRead> Lines<R> {
    pub(crate) fn of(from: R) -> Lines<R> {
        Lines { from, line: Vec::new(), number: 0 }
    }

    /// The next line; `None` after the last one.
    pub(crate) fn next(&mut self) -> io::Result<Option<Line<'_>>> {
        self.line.clear();
        let (mut more, mut is_any) = (0, false);
        loop {
            let buffer = self.from.fill_buf()?;
            if buffer.is_empty() {
                break;
            }
            is_any = true;
            let end = memchr::memchr(b'\n', buffer);
            let part = &buffer[..end.unwrap_or(buffer.len())];
            let room = part.len().min(MAXIMUM_LINE - self.line.len());
            self.line.extend_from_slice(&part[..room]);
            more += (part.len() - room) as u64;
            let used = end.map_or(buffer.len(), |it| it + 1);
            self.from.consume(used);
            if end.is_some() {
                break;
            }
        }
        if !is_any {
            return Ok(None);
        }
        self.number += 1;
        let text = self.line.strip_suffix(b"\r").unwrap_or(&self.line);
        Ok(Some(Line { text, number: self.number, more }))
    }
}
