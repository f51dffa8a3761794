//! Why a file does not make a network at all.

use std::io;

use laneweave_network::NetworkError;
use thiserror::Error;

use crate::problem::Problem;
use crate::xml::XmlError;

/// Why a map cannot be read. Messages name the place inside the file and the remedy, not the file.
#[derive(Debug, Error)]
pub enum MapError {
    /// There is no such file.
    #[error("there is no such file; check the path")]
    Missing,
    /// It is a folder.
    #[error("this is a folder; name a map file inside it")]
    Folder,
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
    /// It is larger than any map this program can hold.
    #[error("the file has {bytes} bytes, the limit is {limit}; cut the map into smaller ones")]
    TooLarge {
        /// Its size [B].
        bytes: u64,
        /// The largest size that is read [B].
        limit: u64,
    },
    /// It is no text.
    #[error("line {line}: the bytes are not UTF-8 text; save the map as UTF-8 XML")]
    NotText {
        /// Where the text ends.
        line: usize,
    },
    /// It is no well-formed XML.
    #[error("line {line}: not well-formed XML ({what}); save the map again, or mend this line")]
    Xml {
        /// Where it breaks.
        line: usize,
        /// How.
        what: String,
    },
    /// It is XML of another kind.
    #[error("line {line}: the outermost element is <{found}>, not <osm>; is this a Lanelet2 map?")]
    NotOsm {
        /// Where the element begins.
        line: usize,
        /// Its name, empty if the file has none.
        found: String,
    },
    /// It is XML of another kind than its format's.
    #[error("line {line}: the outermost element is <{found}>, not <{expected}>; choose a map of that kind")]
    OtherXml {
        /// Where the element begins.
        line: usize,
        /// Its name, empty if the file has none.
        found: String,
        /// The name that was expected.
        expected: &'static str,
    },
    /// The origin given for the projection is no place on earth that UTM covers.
    #[error("the origin ({0}, {1}) is no latitude within ±84° and longitude within ±180°; correct it")]
    Origin(f64, f64),
    /// No lanelet is left that vehicles can use.
    #[error("none of its {lanelets} lanelets can be used by vehicles{}; {NOT_DRIVABLE}", first(.problems))]
    NotDrivable {
        /// Lanelets in the file.
        lanelets: usize,
        /// Why they were left out; those not meant for vehicles are not listed.
        problems: Vec<Problem>,
    },
    /// No lanelet of a CommonRoad map is left that vehicles can use.
    #[error("none of its {lanelets} lanelets can be used by vehicles{}; {NO_LANE}", first(.problems))]
    NoLane {
        /// Lanelets in the file.
        lanelets: usize,
        /// Why they were left out; those not meant for vehicles are not listed.
        problems: Vec<Problem>,
    },
    /// The lanelets do not make a network.
    #[error(transparent)]
    Network(#[from] NetworkError),
}

const NOT_DRIVABLE: &str = "give roads the tags type=lanelet and subtype=road, or participant:vehicle=yes";

const NO_LANE: &str = "give lanelets two bounds and a laneletType for cars, such as urban";

impl From<XmlError> for MapError {
    fn from(error: XmlError) -> MapError {
        match error {
            XmlError::NotText { line } => MapError::NotText { line },
            XmlError::Broken { line, what } => MapError::Xml { line, what },
            XmlError::OtherRoot { line, found, expected } => MapError::OtherXml { line, found, expected },
        }
    }
}

fn first(problems: &[Problem]) -> String {
    problems.first().map_or(String::new(), |it| format!(" (the first problem is {it})"))
}
