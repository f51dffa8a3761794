//! XML as a stream of elements with their lines, within limits, for all formats that are XML. Names and attributes
//! are borrowed from the file.

mod root;

use std::borrow::Cow;
use std::fmt::Display;

use quick_xml::XmlVersion;
use quick_xml::escape::resolve_predefined_entity;
use quick_xml::events::attributes::Attributes;
use quick_xml::events::{BytesRef, Event};
use quick_xml::reader::Reader;
use thiserror::Error;

pub(crate) use root::root;

/// Maximum depth of nested elements; no map format comes near.
const MAXIMUM_DEPTH: usize = 32;

/// Maximum length of a name [B]: the path of each element contains its own name and those around it.
const MAXIMUM_NAME: usize = 128;

/// Why a file is not the expected XML.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum XmlError {
    /// It is not text.
    #[error("line {line}: the bytes are not UTF-8 text; save the file as UTF-8 XML")]
    NotText {
        /// Where the valid text ends.
        line: usize,
    },
    /// It is not well-formed XML.
    #[error("line {line}: not well-formed XML ({what}); save the file again, or correct this line")]
    Broken {
        /// The line of the error.
        line: usize,
        /// The error.
        what: String,
    },
    /// A number has a decimal comma.
    #[error(
        "line {line}: {key} is {value:?}, with a decimal comma; write a point in all numbers, such as {better}, for example by \
         another language in the settings of the program that exported the map"
    )]
    DecimalComma {
        /// The line of the number.
        line: usize,
        /// What it is called.
        key: String,
        /// The number as text.
        value: String,
        /// The same with a point.
        better: String,
    },
    /// It is XML of another kind.
    #[error(
        "line {line}: the outermost element is <{found}>, not <{expected}>; is this a file of another format?"
    )]
    OtherRoot {
        /// Where the element begins.
        line: usize,
        /// Its name, empty if the file has none.
        found: String,
        /// The name that was expected.
        expected: &'static str,
    },
}

/// The next token of an XML file.
#[derive(Debug)]
pub(crate) enum Token<'a> {
    /// An element begins; an empty one also gets a closing token of its own.
    Open(Element<'a>),
    /// Text inside an element; it may come in several pieces.
    Text(Cow<'a, str>),
    /// The innermost open element ends.
    Close,
    /// The file ends, with every element closed.
    End,
}

/// The beginning of an element.
#[derive(Clone, Copy, Debug)]
pub struct Element<'a> {
    /// Its name.
    pub name: &'a str,
    /// The line in which it begins.
    pub line: usize,
    /// Name and attributes as text.
    content: &'a str,
}

impl<'a> Element<'a> {
    /// Its attributes in order, unescaped. One that is given twice comes twice: a search for duplicates would take
    /// quadratic time.
    pub fn attributes(&self) -> impl Iterator<Item = Result<(&'a str, Cow<'a, str>), XmlError>> + use<'a> {
        let line = self.line;
        let mut attributes = Attributes::new(self.content, self.name.len());
        attributes.with_checks(false);
        attributes.map(move |attribute| {
            let attribute = attribute.map_err(|error| broken(line, error))?;
            let value = match attribute.value {
                // Almost every value contains no escapes.
                Cow::Borrowed(value) if is_plain(value) => Cow::Borrowed(value),
                _ => {
                    let value = attribute.normalized_value(XmlVersion::Implicit1_0);
                    Cow::Owned(value.map_err(|error| broken(line, error))?.into_owned())
                }
            };
            Ok((attribute.key.0, value))
        })
    }
    /// The values of the attributes with these keys.
    ///
    /// # Errors
    /// If they are not well-formed.
    pub fn values<const N: usize>(&self, keys: [&str; N]) -> Result<[Option<Cow<'a, str>>; N], XmlError> {
        let mut values = [const { None }; N];
        for attribute in self.attributes() {
            let (key, value) = attribute?;
            if let Some(place) = keys.iter().position(|it| *it == key).filter(|it| values[*it].is_none()) {
                values[place] = Some(value);
            }
        }
        Ok(values)
    }
}

impl XmlError {
    /// The same error, so many lines further on.
    pub(crate) fn moved(mut self, lines: usize) -> XmlError {
        match &mut self {
            XmlError::NotText { line }
            | XmlError::Broken { line, .. }
            | XmlError::DecimalComma { line, .. }
            | XmlError::OtherRoot { line, .. } => *line += lines,
        }
        self
    }

    /// The line of the error.
    pub fn line(&self) -> usize {
        match self {
            XmlError::NotText { line }
            | XmlError::Broken { line, .. }
            | XmlError::DecimalComma { line, .. }
            | XmlError::OtherRoot { line, .. } => *line,
        }
    }
}

/// A receiver for the elements of a document, see [`walk`].
///
/// A path names an element by those around it, without the outermost one: `lanelet/leftBound/point`. The path of the
/// outermost element itself is empty.
pub trait Visitor {
    /// An element begins.
    ///
    /// # Errors
    /// If its attributes are not well-formed.
    fn open(&mut self, path: &str, element: &Element) -> Result<(), XmlError>;

    /// An element ends; `text` is the text between its last child, or else its beginning, and its end.
    fn close(&mut self, path: &str, text: &str);
}

/// As the name of the outermost element: any.
pub const ANY: &str = "";

/// Reads a document with the outermost element `root`, or with [`ANY`], and calls the receiver.
///
/// # Errors
/// If it is not well-formed, is nested too deeply, uses an entity of its own, or has another outermost element.
pub fn walk(bytes: &[u8], root: &'static str, visitor: &mut impl Visitor) -> Result<(), XmlError> {
    let mut tokens = Tokens::of(text(bytes)?, root);
    let (mut path, mut content) = (String::new(), String::new());
    // Lengths of the paths around the element.
    let mut around: Vec<usize> = Vec::new();
    loop {
        match tokens.next()? {
            Token::Open(element) => {
                let is_root = around.is_empty();
                around.push(path.len());
                if !is_root {
                    path.push_str(if path.is_empty() { "" } else { "/" });
                    path.push_str(element.name);
                }
                content.clear();
                visitor.open(&path, &element)?;
            }
            Token::Text(it) => content.push_str(&it),
            Token::Close => {
                visitor.close(&path, content.trim());
                content.clear();
                path.truncate(around.pop().unwrap_or(0));
            }
            Token::End => return Ok(()),
        }
    }
}

/// The text of a file, without its byte order mark, which the reader does not count.
///
/// # Errors
/// If the bytes are not UTF-8.
pub(crate) fn text(bytes: &[u8]) -> Result<&str, XmlError> {
    let text = std::str::from_utf8(bytes);
    let text = text.map_err(|error| XmlError::NotText { line: 1 + lines(&bytes[..error.valid_up_to()]) })?;
    Ok(text.trim_start_matches('\u{feff}'))
}

fn is_plain(value: &str) -> bool {
    value.bytes().all(|it| it != b'&' && it >= b' ')
}

/// The tokens of an XML file.
pub(crate) struct Tokens<'a> {
    reader: Reader<&'a [u8]>,
    text: &'a str,
    root: &'static str,
    has_root: bool,
    /// Position up to which lines were counted, and the line there.
    counted: usize,
    line: usize,
    depth: usize,
    /// Whether an empty element was opened and has to be closed.
    is_empty: bool,
}

impl<'a> Tokens<'a> {
    /// The tokens of a file with this text and the outermost element `root`.
    pub(crate) fn of(text: &'a str, root: &'static str) -> Tokens<'a> {
        let reader = Reader::from_str(text);
        Tokens { reader, text, root, has_root: false, counted: 0, line: 1, depth: 0, is_empty: false }
    }

    /// The tokens of the rest of a file; it begins inside of the outermost element, between two others. Lines are
    /// counted from there.
    pub(crate) fn inside(rest: &'a str, root: &'static str) -> Tokens<'a> {
        let mut tokens = Tokens { has_root: true, depth: 1, ..Tokens::of(rest, root) };
        tokens.reader.config_mut().allow_unmatched_ends = true;
        tokens
    }

    /// The position in the text at which the next token begins.
    pub(crate) fn position(&self) -> usize {
        self.reader.buffer_position() as usize
    }

    /// The number of lines that end before the next token.
    pub(crate) fn lines(&mut self) -> usize {
        self.count_to(self.position());
        self.line - 1
    }

    /// The number of open elements.
    pub(crate) fn depth(&self) -> usize {
        self.depth
    }

    /// The next token.
    ///
    /// # Errors
    /// If the file is no well-formed XML from here on, or nests too deeply.
    pub(crate) fn next(&mut self) -> Result<Token<'a>, XmlError> {
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
                Event::End(element) => {
                    // The reader knows the others.
                    let is_root = self.root == ANY || element.name().as_ref() == self.root;
                    if self.depth == 0 || self.depth == 1 && !is_root {
                        let what =
                            format!("</{}> closes an element that is not open", element.name().as_ref());
                        return Err(broken(self.line, what));
                    }
                    self.depth -= 1;
                    return Ok(Token::Close);
                }
                Event::Text(_) if self.depth > 0 => {
                    return Ok(Token::Text(Cow::Borrowed(&self.text[start..end])));
                }
                Event::CData(text) => return Ok(Token::Text(text.into_inner())),
                Event::GeneralRef(reference) => {
                    return resolved(&reference, self.line).map(|it| Token::Text(it.into()));
                }
                Event::Eof if self.depth > 0 => {
                    return Err(broken(self.line, "the file ends inside an element"));
                }
                Event::Eof if !self.has_root => return Err(self.other_root("")),
                Event::Eof => return Ok(Token::End),
                _ => {}
            }
        }
    }

    /// The element with the markup from `start` to `end`, without the closing sign.
    fn open(&mut self, start: usize, end: usize, name: usize) -> Result<Token<'a>, XmlError> {
        if self.depth == MAXIMUM_DEPTH {
            return Err(broken(self.line, "elements are nested too deeply"));
        }
        if name > MAXIMUM_NAME {
            return Err(broken(self.line, "the name of an element is too long"));
        }
        let content = &self.text[start + 1..end];
        let name = &content[..name];
        if self.depth == 0 {
            if std::mem::replace(&mut self.has_root, true) {
                return Err(broken(self.line, "there is a second outermost element"));
            }
            if self.root != ANY && name != self.root {
                return Err(self.other_root(name));
            }
        }
        self.depth += 1;
        Ok(Token::Open(Element { name, line: self.line, content }))
    }

    fn other_root(&self, found: &str) -> XmlError {
        XmlError::OtherRoot { line: self.line, found: found.into(), expected: self.root }
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

/// The text for which `reference` stands. Entities that a document defines itself are refused: they can grow without
/// bound.
fn resolved(reference: &BytesRef, line: usize) -> Result<String, XmlError> {
    match reference.resolve_char_ref().map_err(|error| broken(line, error))? {
        Some(character) => Ok(character.into()),
        None => match resolve_predefined_entity(reference) {
            Some(known) => Ok(known.into()),
            None => Err(broken(line, format_args!("the entity &{}; is unknown", &**reference))),
        },
    }
}

/// The error that `what`, in `line`, makes the file no well-formed XML.
fn broken(line: usize, what: impl Display) -> XmlError {
    XmlError::Broken { line, what: what.to_string() }
}

/// The number in `text` with a decimal point, if it is one with a decimal comma.
pub(crate) fn with_point(text: &str) -> Option<String> {
    let has_comma = text.matches(',').count() == 1;
    let better = text.trim().replace(',', ".");
    (has_comma && !number(&better).is_nan()).then_some(better)
}

/// Refuses the `text` of a coordinate with a decimal comma, whose value is not a number: whatever wrote it writes all
/// numbers so.
pub(crate) fn refuse_comma(value: f64, line: usize, key: &str, text: &str) -> Result<(), XmlError> {
    match Some(text).filter(|_| value.is_nan()).and_then(with_point) {
        Some(better) => {
            Err(XmlError::DecimalComma { line, key: key.into(), value: text.trim().into(), better })
        }
        None => Ok(()),
    }
}

/// The number in `text`; NaN where it is unreadable.
pub fn number(text: &str) -> f64 {
    text.trim().parse().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests;
