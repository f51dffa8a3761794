//! Errors by which a file gives no recording.

use std::fmt::Display;

use laneweave_maps::Problem;
use laneweave_maps::xml::XmlError;
use thiserror::Error;

/// Why a recording cannot be read. Messages name the place inside the file and the remedy, not the file.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum RecordingError {
    /// It is larger than any recording this program can hold.
    #[error("the file has {bytes} bytes, the limit is {limit}; split the recording into shorter ones")]
    TooLarge {
        /// Its size [B].
        bytes: u64,
        /// The largest size that is read [B].
        limit: u64,
    },
    /// A required column is missing.
    #[error("line 1: the column {column} is missing; add it to the header, which has: {found}")]
    MissingColumn {
        /// Its name.
        column: &'static str,
        /// The header, cut if it is long.
        found: String,
    },
    /// It is not valid XML of its format.
    #[error(transparent)]
    Xml(#[from] XmlError),
    /// It does not give the time between frames, or gives no number above zero.
    #[error("line {line}: {element} has no time between frames above 0 s; give it the attribute {attribute}")]
    NoStep {
        /// Where the element begins.
        line: usize,
        /// The element that should give it.
        element: &'static str,
        /// The attribute that should give it.
        attribute: &'static str,
    },
    /// No road user in it can be used.
    #[error("no road user moves in it{}; choose a recording with trajectories", first(problems.first()))]
    Empty {
        /// Why road users were left out.
        problems: Vec<Problem>,
    },
    /// No row can be used.
    #[error("none of its {rows} rows can be used{}; add rows of tracks below the header", first(problem.as_ref()))]
    NoRows {
        /// Rows in the file.
        rows: usize,
        /// The problem of the first one.
        problem: Option<String>,
    },
    /// All rows are of one frame, so that the time between frames is not known.
    #[error("line {line}: all rows are of the frame {frame}; a recording needs two frames at least")]
    OneFrame {
        /// The first row.
        line: usize,
        /// The frame.
        frame: i64,
    },
    /// The time between frames is out of range.
    #[error(
        "line {line}: frames are {step_ms} ms apart from here on; correct timestamp_ms or frame_id, \
         so that it is {from} to {to} ms"
    )]
    Step {
        /// The row of the first frame.
        line: usize,
        /// The time between frames [ms].
        step_ms: f64,
        /// The least time that is read [ms].
        from: f64,
        /// The greatest time that is read [ms].
        to: f64,
    },
    /// A time does not agree with the number of its frame.
    #[error(
        "line {line}: frame {frame} is at {found_ms} ms, but should be at {expected_ms} ms with {step_ms} ms \
         between frames; correct timestamp_ms or frame_id"
    )]
    Timestamp {
        /// The row.
        line: usize,
        /// Its frame.
        frame: i64,
        /// Its time [ms].
        found_ms: i64,
        /// The time by the first and the last frame [ms].
        expected_ms: f64,
        /// The time between frames by the first and the last frame [ms].
        step_ms: f64,
    },
}

fn first(problem: Option<&impl Display>) -> String {
    problem.map_or(String::new(), |it| format!(" (the first problem is {it})"))
}
