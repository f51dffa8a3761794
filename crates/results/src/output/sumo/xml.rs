//! Fast XML output: elements with attributes that are numbers, or names without special characters.

use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use laneweave_scenario::Fault;
use laneweave_sim::VehicleId;
use laneweave_study::{PartialFile, escaped};

use crate::outcome::Provenance;
use crate::output::names::Names;

/// Text is collected up to this length before it is written [bytes].
const BUFFER: usize = 1 << 18;
/// Digits of a number, with sign and point.
const DIGITS: usize = 24;
/// The numbers below a hundred, with two digits.
const PAIRS: [[u8; 2]; 100] = {
    let mut pairs = [[0; 2]; 100];
    let mut number = 0;
    while number < 100 {
        pairs[number] = [b'0' + (number / 10) as u8, b'0' + (number % 10) as u8];
        number += 1;
    }
    pairs
};
/// Space for a line, so that the text never has to move [bytes].
const LINE: usize = 1 << 10;

/// An XML file under a provisional name until it is complete.
pub(super) struct XmlFile {
    text: Vec<u8>,
    /// This comes before the file, so that the file is closed when it is removed.
    output: File,
    file: PartialFile,
}

impl XmlFile {
    /// Begins the file at `path` with its provenance and with `root`, the begin tag of its outermost element.
    pub(super) fn create(path: &Path, root: &str, provenance: &Provenance) -> Result<XmlFile, Fault> {
        let (file, output) =
            PartialFile::create(path).map_err(|error| Fault::refused(path, "created", &error))?;
        let mut text = Vec::with_capacity(BUFFER + LINE);
        text.extend(header(root, provenance).as_bytes());
        Ok(XmlFile { text, output, file })
    }

    /// Appends `markup`, which is already XML.
    pub(super) fn raw(&mut self, markup: &str) -> &mut XmlFile {
        self.text.extend_from_slice(markup.as_bytes());
        self
    }

    /// The name of a vehicle, or its id.
    pub(super) fn vehicle(&mut self, names: &Names, id: VehicleId) -> &mut XmlFile {
        match names.vehicle_in_xml(id) {
            Some(name) => self.raw(name),
            None => self.integer(id),
        }
    }

    pub(super) fn integer(&mut self, value: impl itoa::Integer) -> &mut XmlFile {
        self.text.extend_from_slice(itoa::Buffer::new().format(value).as_bytes());
        self
    }

    /// A number with two decimals.
    pub(super) fn number(&mut self, value: f64) -> &mut XmlFile {
        // Rounded to the nearest; the library's rounding takes as long as everything else.
        self.hundredths((100.0 * value + 0.5_f64.copysign(value)) as i64)
    }

    /// A time [s] with two decimals, or with three if a step is no whole number of hundredths.
    pub(super) fn time(&mut self, seconds: f64) -> &mut XmlFile {
        let thousandths = (1000.0 * seconds).round() as i64;
        self.hundredths(thousandths.div_euclid(10));
        match thousandths.rem_euclid(10) {
            0 => self,
            last => self.integer(last),
        }
    }

    fn hundredths(&mut self, value: i64) -> &mut XmlFile {
        // Digits are written from the end: most of a file are such numbers, and this is the fastest method.
        let (mut whole, decimals) = (value.unsigned_abs() / 100, value.unsigned_abs() % 100);
        let mut digits = [0; 2 * DIGITS];
        let mut at = DIGITS - 3;
        digits[at] = b'.';
        digits[at + 1..DIGITS].copy_from_slice(&PAIRS[decimals as usize]);
        loop {
            at -= 2;
            digits[at..at + 2].copy_from_slice(&PAIRS[(whole % 100) as usize]);
            whole /= 100;
            if whole == 0 {
                break;
            }
        }
        // A pair begins with a superfluous zero if the number of digits before the point is odd.
        at += usize::from(digits[at] == b'0');
        if value < 0 {
            at -= 1;
            digits[at] = b'-';
        }
        // Copying a fixed number of bytes is faster than copying only the necessary ones.
        self.text.extend_from_slice(&digits[at..at + DIGITS]);
        self.text.truncate(self.text.len() - at);
        self
    }

    /// Ends an element. At times the collected text is written.
    pub(super) fn end(&mut self, markup: &str) -> Result<(), Fault> {
        self.raw(markup);
        if self.text.len() < BUFFER {
            return Ok(());
        }
        self.flush().map_err(|error| Fault::refused(self.file.target(), "written", &error))
    }

    fn flush(&mut self) -> io::Result<()> {
        self.output.write_all(&self.text)?;
        self.text.clear();
        Ok(())
    }

    /// Ends the outermost element, and gives the file its final name.
    pub(super) fn finish(mut self, root: &str) -> Result<PathBuf, Fault> {
        self.raw(root);
        let path = self.file.target().to_owned();
        let written = self.flush().and_then(|()| self.file.complete());
        written.map_err(|error| Fault::refused(&path, "written", &error))?;
        Ok(path)
    }
}

/// Text as the value of an attribute.
pub(in crate::output) fn attribute(text: &str) -> String {
    escaped(text).replace('"', "&quot;")
}

/// The text before the first element.
fn header(root: &str, provenance: &Provenance) -> String {
    let Provenance { version, command, seed, scenario, .. } = provenance;
    let comment = format!(
        "generated by laneweave {version}\ncommand: {command}\nseed: {seed}\nscenario:\n\n{scenario}"
    );
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\n<!-- {}\n-->\n\n{root}\n",
        in_comment(comment.trim_end())
    )
}

/// Text for a comment: without control characters, and with a double minus written as SUMO's tools write it.
fn in_comment(text: &str) -> String {
    let can_be_held = |it: char| it == '\n' || !(it.is_control() || matches!(it, '\u{fffe}' | '\u{ffff}'));
    let held: String = text.chars().map(|it| if can_be_held(it) { it } else { ' ' }).collect();
    held.replace("--", "<doubleminus>")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(write: impl FnOnce(&mut XmlFile)) -> String {
        let name = format!("laneweave-xml-{}-{:?}.xml", std::process::id(), std::thread::current().id());
        let path = std::env::temp_dir().join(name);
        let provenance = Provenance {
            version: "1".into(),
            command: "laneweave --seed ---1".into(),
            fingerprint: String::new(),
            seed: 2,
            scenario: "map = \"a\u{7}\"\n".into(),
        };
        let mut file = XmlFile::create(&path, "<a>", &provenance).unwrap();
        write(&mut file);
        file.finish("</a>\n").unwrap();
        let text = std::fs::read_to_string(&path).unwrap();
        std::fs::remove_file(&path).unwrap();
        text
    }

    #[test]
    fn numbers_have_two_decimals_and_zero_has_no_sign() {
        let text = text(|it| {
            for value in [0.0, -0.004, 1.005, -1.5, 99.999, -0.01, 10.0, 1234567.891] {
                it.number(value).raw(" ");
            }
            it.time(12.0).raw(" ").time(0.1 + 0.2).raw(" ").time(0.125);
        });
        let body = text.split("<a>\n").nth(1).unwrap();
        assert_eq!(body, "0.00 0.00 1.00 -1.50 100.00 -0.01 10.00 1234567.89 12.00 0.30 0.125</a>\n");
    }

    #[test]
    fn the_comment_says_what_was_run_and_can_be_parsed() {
        let text = text(|_| ());
        let comment = text.split("<!--").nth(1).unwrap().split("-->").next().unwrap();
        assert_eq!(
            comment,
            " generated by laneweave 1\ncommand: laneweave <doubleminus>seed <doubleminus>-1\nseed: 2\nscenario:\n\n\
             map = \"a \"\n"
        );
    }
}
