//! XML read element by element, with lines and within limits: what all formats that are XML share.

use std::fmt::Display;

use quick_xml::XmlVersion;
use quick_xml::escape::resolve_predefined_entity;
use quick_xml::events::{BytesRef, BytesStart, Event};
use quick_xml::reader::Reader;
use thiserror::Error;

/// Elements nested deeper than this are refused; no format of ours has more than ten levels.
pub(crate) const MAXIMUM_DEPTH: usize = 32;

/// Why a file is not the XML that was expected.
#[derive(Debug, Error, PartialEq, Eq)]
pub enum XmlError {
    /// It is no text.
    #[error("line {line}: the bytes are not UTF-8 text; save the file as UTF-8 XML")]
    NotText {
        /// Where the text ends.
        line: usize,
    },
    /// It is no well-formed XML.
    #[error("line {line}: not well-formed XML ({what}); save the file again, or mend this line")]
    Broken {
        /// Where it breaks.
        line: usize,
        /// How.
        what: String,
    },
    /// It is XML of another kind.
    #[error("line {line}: the outermost element is <{found}>, not <{expected}>; choose a file of that kind")]
    OtherRoot {
        /// Where the element begins.
        line: usize,
        /// Its name, empty if the file has none.
        found: String,
        /// The name that was expected.
        expected: &'static str,
    },
}

/// What reads a document as [`walk`] goes through it.
///
/// A path names an element by those around it, without the outermost one: `lanelet/leftBound/point`. That of
/// the outermost element itself is empty.
pub trait Visitor {
    /// An element begins.
    ///
    /// # Errors
    /// If its attributes are not well-formed.
    fn open(&mut self, path: &str, element: &Element) -> Result<(), XmlError>;

    /// An element ends; `text` is what stands between its last child, or else its beginning, and its end.
    fn close(&mut self, path: &str, text: &str);
}

/// The beginning of an element.
#[derive(Debug)]
pub struct Element<'a> {
    start: &'a BytesStart<'a>,
    /// The line in which it begins.
    pub line: usize,
}

impl Element<'_> {
    /// The values of some attributes.
    ///
    /// # Errors
    /// If they are not well-formed.
    pub fn attributes<const N: usize>(&self, keys: [&str; N]) -> Result<[Option<String>; N], XmlError> {
        attributes(self.start, self.line, keys)
    }
}

/// Goes through a document whose outermost element is `root`.
///
/// # Errors
/// If it is not well-formed, is nested too deeply, uses an entity of its own, or has another outermost
/// element.
pub fn walk(bytes: &[u8], root: &'static str, visitor: &mut impl Visitor) -> Result<(), XmlError> {
    let mut xml = Xml::new(bytes)?;
    xml.reader.config_mut().expand_empty_elements = true;
    let (mut path, mut text) = (String::new(), String::new());
    // Lengths of the paths around the element.
    let mut around: Vec<usize> = Vec::new();
    let mut found_root = false;
    loop {
        let (event, line) = xml.next()?;
        match event {
            Event::Start(start) => {
                let name = start.name();
                match around.len() {
                    0 if found_root => return Err(broken(line, "there is a second outermost element")),
                    0 if name.as_ref() != root => {
                        return Err(XmlError::OtherRoot {
                            line,
                            found: name.as_ref().into(),
                            expected: root,
                        });
                    }
                    MAXIMUM_DEPTH => return Err(broken(line, "elements are nested too deeply")),
                    _ => {}
                }
                around.push(path.len());
                if found_root {
                    path.push_str(if path.is_empty() { "" } else { "/" });
                    path.push_str(name.as_ref());
                }
                found_root = true;
                text.clear();
                visitor.open(&path, &Element { start: &start, line })?;
            }
            Event::End(_) => {
                visitor.close(&path, text.trim());
                text.clear();
                path.truncate(around.pop().unwrap_or(0));
            }
            Event::Text(it) => text.push_str(&it),
            Event::CData(it) => text.push_str(&it),
            Event::GeneralRef(it) => push_reference(&mut text, &it, line)?,
            Event::Eof if !around.is_empty() => return Err(broken(line, "the file ends inside an element")),
            Event::Eof if !found_root => {
                return Err(XmlError::OtherRoot { line, found: String::new(), expected: root });
            }
            Event::Eof => return Ok(()),
            _ => {}
        }
    }
}

/// Adds the character for which `reference` stands. What a document defines itself is refused: such entities
/// can grow without bound.
fn push_reference(text: &mut String, reference: &BytesRef, line: usize) -> Result<(), XmlError> {
    match reference.resolve_char_ref().map_err(|error| broken(line, error))? {
        Some(character) => text.push(character),
        None => match resolve_predefined_entity(reference) {
            Some(known) => text.push_str(known),
            None => return Err(broken(line, format_args!("the entity &{}; is unknown", &**reference))),
        },
    }
    Ok(())
}

/// Events with the lines in which they begin.
pub(crate) struct Xml<'a> {
    reader: Reader<&'a [u8]>,
    text: &'a str,
    counted: usize,
    line: usize,
}

impl<'a> Xml<'a> {
    pub(crate) fn new(bytes: &'a [u8]) -> Result<Xml<'a>, XmlError> {
        let text = std::str::from_utf8(bytes)
            .map_err(|error| XmlError::NotText { line: 1 + count_lines(&bytes[..error.valid_up_to()]) })?;
        // The reader does not count a byte order mark.
        let text = text.trim_start_matches('\u{feff}');
        Ok(Xml { reader: Reader::from_str(text), text, counted: 0, line: 1 })
    }

    pub(crate) fn next(&mut self) -> Result<(Event<'a>, usize), XmlError> {
        let start = self.reader.buffer_position() as usize;
        let event = self.reader.read_event();
        let at = if event.is_ok() { start } else { self.reader.error_position() as usize };
        let at = at.clamp(self.counted, self.text.len());
        self.line += count_lines(&self.text.as_bytes()[self.counted..at]);
        self.counted = at;
        event.map(|event| (event, self.line)).map_err(|error| broken(self.line, error))
    }
}

fn count_lines(bytes: &[u8]) -> usize {
    bytes.iter().filter(|it| **it == b'\n').count()
}

pub(crate) fn broken(line: usize, what: impl Display) -> XmlError {
    XmlError::Broken { line, what: what.to_string() }
}

/// The values of some attributes. Where one is given twice the first one counts: to look for such doubles
/// would take time quadratic in their number.
pub(crate) fn attributes<const N: usize>(
    start: &BytesStart,
    line: usize,
    keys: [&str; N],
) -> Result<[Option<String>; N], XmlError> {
    let mut values = [const { None }; N];
    for attribute in start.attributes().with_checks(false) {
        let attribute = attribute.map_err(|error| broken(line, error))?;
        let Some(place) = keys.iter().position(|key| *key == attribute.key.as_ref()) else { continue };
        if values[place].is_none() {
            let value = attribute.normalized_value(XmlVersion::Implicit1_0);
            values[place] = Some(value.map_err(|error| broken(line, error))?.into_owned());
        }
    }
    Ok(values)
}

/// The number that `text` is; not a number where it is unreadable.
pub fn number(text: &str) -> f64 {
    text.trim().parse().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Notes what it sees.
    #[derive(Default)]
    struct Notes(Vec<String>);

    impl Visitor for Notes {
        fn open(&mut self, path: &str, element: &Element) -> Result<(), XmlError> {
            let [id] = element.attributes(["id"])?;
            self.0.push(format!("{}: <{path} {}>", element.line, id.unwrap_or_default()));
            Ok(())
        }

        fn close(&mut self, path: &str, text: &str) {
            self.0.push(format!("{path}={text}"));
        }
    }

    fn refusal(text: &str) -> String {
        walk(text.as_bytes(), "r", &mut Notes::default()).unwrap_err().to_string()
    }

    #[test]
    fn elements_come_with_path_line_and_text() {
        let mut notes = Notes::default();
        let text = concat!(
            "\u{feff}<?xml version='1.0'?>\n<r id='0'>\n <a>\n",
            "  <b id='&lt;'/> 1&#46;<![CDATA[5]]>&amp; </a>\n</r>\n"
        );
        walk(text.as_bytes(), "r", &mut notes).unwrap();
        assert_eq!(notes.0, ["2: < 0>", "3: <a >", "4: <a/b <>", "a/b=", "a=1.5&", "="]);
    }

    #[test]
    fn what_is_no_such_document_is_refused_with_its_line() {
        assert_eq!(
            refusal("\n<osm/>"),
            "line 2: the outermost element is <osm>, not <r>; choose a file of that kind"
        );
        assert!(refusal("").starts_with("line 1: the outermost element is <>"));
        assert!(refusal("<r/>\n<r/>").starts_with("line 2: not well-formed XML (there is a second"));
        assert!(refusal("<r>\n<a>").starts_with("line 2: not well-formed XML (the file ends inside"));
        assert!(refusal("<r>\n\n</a></r>").starts_with("line 3: not well-formed XML"));
        assert!(refusal(&"<r>".repeat(33)).contains("nested too deeply"));
        assert!(refusal("<r>\n<a>&#0;</a></r>").starts_with("line 2: not well-formed XML"));
    }

    #[test]
    fn entities_of_a_documents_own_are_not_expanded() {
        let bomb = "<!DOCTYPE r [<!ENTITY a 'aa'>\n<!ENTITY b '&a;&a;'>]>\n<r>\n<a>&b;</a></r>";
        assert_eq!(
            refusal(bomb),
            "line 4: not well-formed XML (the entity &b; is unknown); save the file again, or mend this line"
        );
    }
}
