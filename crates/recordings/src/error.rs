//! Errors by which a file gives no recording.

use std::fmt::Display;
use std::io;

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
        column: String,
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
        "line {line}: frames are {step_ms} ms apart from here on; correct {columns}, so that it is {from} to {to} ms"
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
        /// The columns that give it.
        columns: String,
    },
    /// A time does not agree with the number of its frame.
    #[error(
        "line {line}: frame {frame} is at {found_ms} ms, but should be at {expected_ms} ms with {step_ms} ms \
         between frames; correct {columns}"
    )]
    Timestamp {
        /// The row.
        line: usize,
        /// Its frame.
        frame: i64,
        /// Its time [ms].
        found_ms: f64,
        /// The time by the first and the last frame [ms].
        expected_ms: f64,
        /// The time between frames by the first and the last frame [ms].
        step_ms: f64,
        /// The columns that give it.
        columns: String,
    },
    /// A table has numbers of frames, but nothing says how many frames a second has.
    #[error(
        "nothing says how many frames a second has; put the dataset's recordingMeta file beside it, or give the layout \
         frames_per_second"
    )]
    NoFrameRate,
    /// A layout names neither a column of frames nor one of times.
    #[error("its layout names neither a column `frame` nor a column `time`; add one of them")]
    NoTime,
    /// A table holds several recordings.
    #[error(
        "line {line}: {column} is {other:?}, and {first:?} above: the table holds several recordings; keep the rows of one"
    )]
    Several {
        /// The first row of another recording.
        line: usize,
        /// The column that tells recordings apart.
        column: String,
        /// The value of the first recording.
        first: String,
        /// That of the other one.
        other: String,
    },
    /// The file has no content.
    #[error("the file is empty; download the recording again, or choose another file")]
    EmptyFile,
    /// It is something else than a recording.
    #[error("by its content this is {what}, not a recording; {remedy}")]
    OtherKind {
        /// What it is.
        what: String,
        /// What to give in its place.
        remedy: &'static str,
    },
    /// It is no text.
    #[error(
        "this is not a text file, so it cannot be a recording; choose another file, or decompress it first"
    )]
    NoText,
    /// It is Parquet that cannot be read.
    #[error("it cannot be read as Parquet: {what}; write it without compression or with Snappy, or as CSV")]
    Parquet {
        /// Why not.
        what: String,
    },
    /// A table whose columns are those of no dataset that we know.
    #[error(
        "line 1: its columns are of no dataset that is known ({known}): {found}; say what its columns hold, in a TOML file for \
         --columns"
    )]
    UnknownTable {
        /// The header, cut if it is long.
        found: String,
        /// The datasets that are known.
        known: String,
    },
    /// A layout is no TOML that says what columns hold.
    #[error(
        "{what}; the keys are columns, units, point, axes, frames_per_second, reused_after_s, same, header, classes"
    )]
    Layout {
        /// What is wrong with it, and where.
        what: String,
    },
    /// The file cannot be read to its end.
    #[error("it cannot be read to its end: {what}; check the file or the drive")]
    Unreadable {
        /// What the system says.
        what: String,
    },
}

impl From<io::Error> for RecordingError {
    fn from(error: io::Error) -> RecordingError {
        RecordingError::Unreadable { what: error.to_string() }
    }
}

fn first(problem: Option<&impl Display>) -> String {
    problem.map_or(String::new(), |it| format!(" (the first problem is {it})"))
}
