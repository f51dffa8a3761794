//! XML as a stream of elements with their lines. Names, attributes and text are borrowed from the file.

use std::borrow::Cow;
use std::fmt::Display;

use quick_xml::XmlVersion;
use quick_xml::events::Event;
use quick_xml::events::attributes::Attributes;
use quick_xml::reader::Reader;

use crate::error::MapError;

/// Elements nested deeper than this are refused; no map format comes near.
const MAXIMUM_DEPTH: usize = 32;

/// What comes next in an XML file.
#[derive(Debug)]
pub(crate) enum Token<'a> {
    /// An element begins; an empty one is closed by a token of its own, too.
    Open(Element<'a>),
    /// Text inside an element, as it stands.
    Text,
    /// The innermost open element ends.
    Close,
    /// The file ends, with every element closed.
    End,
}

/// The beginning of an element.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Element<'a> {
    pub(crate) name: &'a str,
    pub(crate) line: usize,
    /// Name and attributes as they stand.
    content: &'a str,
}

impl<'a> Element<'a> {
    /// Its attributes in order, unescaped. One that is given twice comes twice: to look for such doubles would take time
    /// quadratic in their number.
    pub(crate) fn attributes(
        &self,
    ) -> impl Iterator<Item = Result<(&'a str, Cow<'a, str>), MapError>> + use<'a> {
        let line = self.line;
        let mut attributes = Attributes::new(self.content, self.name.len());
        attributes.with_checks(false);
        attributes.map(move |attribute| {
            let attribute = attribute.map_err(|error| broken(line, error))?;
            let value = match attribute.value {
                // Almost every value stands for itself.
                Cow::Borrowed(value) if is_plain(value) => Cow::Borrowed(value),
                _ => {
                    let value = attribute.normalized_value(XmlVersion::Implicit1_0);
                    Cow::Owned(value.map_err(|error| broken(line, error))?.into_owned())
                }
            };
            Ok((attribute.key.0, value))
        })
    }
}

fn is_plain(value: &str) -> bool {
    value.bytes().all(|it| it != b'&' && it >= b' ')
}

/// The tokens of an XML file.
pub(crate) struct Tokens<'a> {
    reader: Reader<&'a [u8]>,
    text: &'a str,
    /// Up to where lines were counted, and the line there.
    counted: usize,
    line: usize,
    depth: usize,
    /// An empty element was opened and is to be closed.
    is_empty: bool,
}

impl<'a> Tokens<'a> {
    /// The tokens of a file with these `bytes`.
    ///
    /// # Errors
    /// If they are no UTF-8 text.
    pub(crate) fn of(bytes: &'a [u8]) -> Result<Tokens<'a>, MapError> {
        let text = std::str::from_utf8(bytes)
            .map_err(|error| MapError::NotText { line: 1 + lines(&bytes[..error.valid_up_to()]) })?;
        // The reader does not count a byte order mark.
        let text = text.trim_start_matches('\u{feff}');
        Ok(Tokens { reader: Reader::from_str(text), text, counted: 0, line: 1, depth: 0, is_empty: false })
    }

    /// All of the file's text.
    pub(crate) fn text(&self) -> &'a str {
        self.text
    }

    /// How many elements are open.
    pub(crate) fn depth(&self) -> usize {
        self.depth
    }

    /// The line of the last token.
    pub(crate) fn line(&self) -> usize {
        self.line
    }

    /// The next token.
    ///
    /// # Errors
    /// If the file is no well-formed XML from here on, or nests too deeply.
    pub(crate) fn next(&mut self) -> Result<Token<'a>, MapError> {
        if std::mem::take(&mut self.is_empty) {
            self.depth -= 1;
            return Ok(Token::Close);
        }
        loop {
            let start = self.reader.buffer_position() as usize;
            let event = self.reader.read_event();
            let at = if event.is_ok() { start } else { self.reader.error_position() as usize };
            self.count_to(at);
            let end = self.reader.buffer_position() as usize;
            match event.map_err(|error| broken(self.line, error))? {
                Event::Start(element) => {
                    let length = element.name().as_ref().len();
                    return self.open(start, end - 1, length);
                }
                Event::Empty(element) => {
                    let length = element.name().as_ref().len();
                    self.is_empty = true;
                    return self.open(start, end - 2, length);
                }
                Event::End(_) => {
                    self.depth -= 1;
                    return Ok(Token::Close);
                }
                Event::Text(_) if self.depth > 0 => return Ok(Token::Text),
                Event::Eof if self.depth > 0 => {
                    return Err(broken(self.line, "the file ends inside an element"));
                }
                Event::Eof => return Ok(Token::End),
                _ => {}
            }
        }
    }

    /// The element whose markup stands from `start` to `end`, of which the closing sign is left out.
    fn open(&mut self, start: usize, end: usize, name: usize) -> Result<Token<'a>, MapError> {
        if self.depth == MAXIMUM_DEPTH {
            return Err(broken(self.line, "elements are nested too deeply"));
        }
        self.depth += 1;
        let content = &self.text[start + 1..end];
        Ok(Token::Open(Element { name: &content[..name], line: self.line, content }))
    }

    fn count_to(&mut self, at: usize) {
        let at = at.clamp(self.counted, self.text.len());
        self.line += lines(&self.text.as_bytes()[self.counted..at]);
        self.counted = at;
    }
}

fn lines(bytes: &[u8]) -> usize {
    memchr::memchr_iter(b'\n', bytes).count()
}

/// `what` makes the file no well-formed XML in `line`.
pub(crate) fn broken(line: usize, what: impl Display) -> MapError {
    MapError::Xml { line, what: what.to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(text: &str) -> Vec<String> {
        let mut tokens = Tokens::of(text.as_bytes()).unwrap();
        let mut found = Vec::new();
        loop {
            match tokens.next() {
                Ok(Token::Open(element)) => {
                    let attributes: Vec<_> =
                        element.attributes().map(|it| it.unwrap()).map(|(k, v)| format!("{k}={v}")).collect();
                    found.push(format!("{} {} {}", element.line, element.name, attributes.join(",")));
                }
                Ok(Token::Text) => found.push("text".into()),
                Ok(Token::Close) => found.push("close".into()),
                Ok(Token::End) => return found,
                Err(error) => {
                    found.push(error.to_string());
                    return found;
                }
            }
        }
    }

    #[test]
    fn tokens_come_in_order_with_their_lines() {
        assert_eq!(
            all("\u{feff}<?xml version='1.0'?>\n<a x='1' y=\"a &amp; b\">\n<b/>t<!-- \n --></a>"),
            ["2 a x=1,y=a & b", "text", "3 b ", "close", "text", "close"]
        );
    }

    #[test]
    fn what_is_not_well_formed_is_refused_with_its_line() {
        assert!(all("<a>\n\n<b></c></a>").last().unwrap().starts_with("line 3: not well-formed XML"));
        assert!(all("<a>\n<b>").last().unwrap().contains("line 2: not well-formed XML (the file ends"));
        assert!(all(&"<a>".repeat(33)).last().unwrap().contains("nested too deeply"));
        assert!(Tokens::of(b"<a>\n\xff</a>").err().unwrap().to_string().starts_with("line 2: the bytes"));
    }

    #[test]
    fn the_names_and_closings_of_empty_elements_do_not_mix() {
        assert_eq!(all("<a/>"), ["1 a ", "close"]);
        assert_eq!(all("<a x='/'/>"), ["1 a x=/", "close"]);
        assert_eq!(all("<a ><b x='>'  /></a >"), ["1 a ", "1 b x=>", "close", "close"]);
    }
}
