//! Errors by which a file gives no network.

use std::io;

use laneweave_network::NetworkError;
use thiserror::Error;

use crate::foreign::FROM_STREETS;
use crate::problem::Problem;
use crate::size::Size;
use crate::xml::XmlError;

/// Why a map cannot be read. Messages name the place inside the file and the remedy, not the file.
#[derive(Debug, Error)]
pub enum MapError {
    /// There is no such file.
    #[error("there is no such file; check the path")]
    Missing,
    /// It is a folder.
    #[error("this is a folder; give a map file in it")]
    Folder,
    /// There is nothing in it.
    #[error("the file is empty; download the map again, or choose another file")]
    Empty,
    /// The system refuses to read it.
    #[error("the file cannot be read: {0}; check its permissions")]
    Unreadable(io::Error),
    /// No format has this extension.
    #[error("no map format has the extension {found:?}; known are {known}")]
    UnknownFormat {
        /// The file's extension, empty if it has none.
        found: String,
        /// The formats with their extensions.
        known: String,
    },
    /// It is something else than a map.
    #[error("by its {told_by} this is {what}, not a map; {remedy}")]
    OtherKind {
        /// What it is.
        what: String,
        /// What tells that: its name or its content.
        told_by: &'static str,
        /// What to give in its place.
        remedy: String,
    },
    /// It is of a format that is not read as a map.
    #[error("by its content this is {what}, which is not read as a map; {remedy}")]
    Foreign {
        /// What it is.
        what: &'static str,
        /// How to get a map from it.
        remedy: &'static str,
    },
    /// It is a street map of OpenStreetMap, with streets as lines and without lanes.
    #[error(
        "line {line}: this is a street map of OpenStreetMap, with {streets} streets (way {way} is the first) and no lanelet, so nothing \
         is known of its lanes; {FROM_STREETS}; or draw lanelets"
    )]
    Streets {
        /// The line of the first street.
        line: usize,
        /// Its id.
        way: i64,
        /// The number of streets.
        streets: usize,
    },
    /// It is a map of another format than its name says.
    #[error("by its content this is a {format} map; rename it so that its name ends in .{extension}")]
    Misnamed {
        /// Its format.
        format: &'static str,
        /// The extension of files of that format.
        extension: &'static str,
    },
    /// It is larger than the limit; unpacked, if it is compressed.
    #[error(
        "the map is larger than the limit of {largest}; split it into smaller ones, or increase the limit"
    )]
    TooLarge {
        /// The largest size that is read.
        largest: Size,
    },
    /// Its name says that it is compressed, but it cannot be unpacked.
    #[error(
        "the file cannot be unpacked ({0}); compress it again, or remove .gz from its name if it is not compressed"
    )]
    Compressed(io::Error),
    /// It is not valid XML of its format.
    #[error(transparent)]
    Xml(#[from] XmlError),
    /// The origin given for the projection is not in the area of UTM.
    #[error("the origin ({0}, {1}) is not a latitude within ±84° and a longitude within ±180°; correct it")]
    Origin(f64, f64),
    /// No lanelet is left that vehicles can use.
    #[error("none of its {lanelets} lanelets can be used by vehicles{}; {remedy}", first(.problems))]
    NotDrivable {
        /// Lanelets in the file.
        lanelets: usize,
        /// Why they were left out; those not meant for vehicles are not listed.
        problems: Vec<Problem>,
        /// What would make them roads for vehicles.
        remedy: &'static str,
    },
    /// The lanelets do not make a network.
    #[error(transparent)]
    Network(#[from] NetworkError),
}

impl MapError {
    /// The line of the file with the error, where it has one place.
    pub fn line(&self) -> Option<usize> {
        match self {
            MapError::Xml(error) => Some(error.line()),
            MapError::Streets { line, .. } => Some(*line),
            _ => None,
        }
    }
}

fn first(problems: &[Problem]) -> String {
    problems.first().map_or(String::new(), |it| format!(" (the first problem is {it})"))
}
