//! Errors of the map generator.

use thiserror::Error;

/// Why a map cannot be made.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum GenerateError {
    /// A count is out of range.
    #[error("{count} {what}; choose {from} to {to}")]
    Count {
        /// What is counted.
        what: &'static str,
        /// The number given.
        count: usize,
        /// The least that is possible.
        from: usize,
        /// The most that is possible.
        to: usize,
    },
    /// A number is out of range, or NaN.
    #[error("{what} of {value} {unit}; choose {from} to {to} {unit}")]
    OutOfRange {
        /// What the number means.
        what: &'static str,
        /// The number.
        value: f64,
        /// Its unit.
        unit: &'static str,
        /// The least that is possible.
        from: f64,
        /// The most that is possible.
        to: f64,
    },
    /// More lanelets than the generator makes.
    #[error("about {0:.0} lanelets; choose fewer lanes, a shorter road or longer lanelets")]
    TooMany(f64),
    /// The only lane ends.
    #[error("the only lane cannot end; choose two lanes or no lane drop")]
    OnlyLaneEnds,
    /// A ramp or lane drop does not fit on the road.
    #[error(
        "the {what} needs the road from {from} m to {to} m, but its length is {length} m; move it or lengthen the road"
    )]
    OutsideRoad {
        /// Which one.
        what: String,
        /// Where it begins [m].
        from: f64,
        /// Where it ends [m].
        to: f64,
        /// Length of the road [m].
        length: f64,
    },
    /// Two of them need the same place.
    #[error("the {0} and the {1} overlap or nearly touch; move one of them")]
    Overlap(String, String),
}

/// Refuses a count that is out of range.
pub(super) fn check_count(
    what: &'static str,
    count: usize,
    [from, to]: [usize; 2],
) -> Result<(), GenerateError> {
    if (from..=to).contains(&count) {
        return Ok(());
    }
    Err(GenerateError::Count { what, count, from, to })
}

/// Refuses a number that is out of range, or NaN.
pub(super) fn check_range(
    what: &'static str,
    value: f64,
    unit: &'static str,
    [from, to]: [f64; 2],
) -> Result<(), GenerateError> {
    if (from..=to).contains(&value) {
        return Ok(());
    }
    Err(GenerateError::OutOfRange { what, value, unit, from, to })
}
