//! Why a file is no recording at all.

use laneweave_maps::Problem;
use laneweave_maps::xml::XmlError;
use thiserror::Error;

/// Why a recording cannot be read. Messages name the place inside the file and the remedy, not the file.
#[derive(Debug, Error)]
pub enum RecordingError {
    /// It is larger than any recording this program can hold.
    #[error("the file has {bytes} bytes, the limit is {limit}; cut the recording into shorter ones")]
    TooLarge {
        /// Its size [B].
        bytes: u64,
        /// The largest size that is read [B].
        limit: u64,
    },
    /// It is not the XML that was expected.
    #[error(transparent)]
    Xml(#[from] XmlError),
    /// The time between frames is missing, or no number above zero.
    #[error("line {line}: {element} has no time between frames above 0 s; give it the attribute {attribute}")]
    Step {
        /// Where the element begins.
        line: usize,
        /// The element that should say it.
        element: &'static str,
        /// The attribute in which it should.
        attribute: &'static str,
    },
    /// No road user in it can be used.
    #[error("no road user moves in it{}; choose a recording with trajectories", first(.problems))]
    Empty {
        /// Why road users were left out.
        problems: Vec<Problem>,
    },
}

fn first(problems: &[Problem]) -> String {
    problems.first().map_or(String::new(), |it| format!(" (the first problem is {it})"))
}
