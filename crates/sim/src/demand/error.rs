//! Why a world cannot be made.

use thiserror::Error;

use crate::demand::headways::HeadwayError;

/// Why a world cannot be made.
#[derive(Debug, Error, PartialEq)]
pub enum WorldError {
    /// The step is not a sensible length of time.
    #[error("a step of {0} s: it must lie between 0.01 and 1 s")]
    Step(f64),
    /// The number of sets of driver parameters differs from the present one.
    #[error("{found} sets of driver parameters in place of {expected}")]
    Characters {
        /// The new number.
        found: usize,
        /// The present number.
        expected: usize,
    },
    /// There are no driver parameters.
    #[error("there is no style to drive with")]
    NoDriverParameters,
    /// A vehicle cannot be put at this place, or is unknown.
    #[error("a vehicle cannot be put on the road: {0}")]
    Vehicle(&'static str),
    /// A rate, weight or share is not a sensible number.
    #[error("{what} is {value}: it must be a number not below 0{limit}")]
    Demand {
        /// Which number it is.
        what: &'static str,
        /// Its value.
        value: f64,
        /// Its upper limit, in words.
        limit: String,
    },
    /// The demand has more stops than destinations.
    #[error("{stops} of {destinations} destinations cannot be stops of lines")]
    Stops {
        /// Number of stops.
        stops: usize,
        /// Number of destinations.
        destinations: usize,
    },
    /// A line has places that the demand has not, or impossible times.
    #[error(
        "line {0} has an origin, a stop or a destination that the demand does not have, or an impossible time"
    )]
    Line(String),
    /// A departure has places or a style that the demand has not, or an impossible time.
    #[error(
        "the departures of single vehicles are not in order, name places or styles that the demand does not have, or have \
         vehicles shorter than 0.5 m or longer than 12 m"
    )]
    Departures,
    /// The headways are impossible.
    #[error(transparent)]
    Headways(#[from] HeadwayError),
    /// More destinations than a vehicle can distinguish.
    #[error("{0} destinations: there can be {1} at most")]
    Destinations(usize, usize),
    /// The routes to all destinations would not fit into memory.
    #[error(
        "the ways to {destinations} destinations over {chains} lanes, for the different classes of vehicles, would \
         not fit into memory"
    )]
    Ways {
        /// Number of destinations.
        destinations: usize,
        /// Number of chains.
        chains: usize,
    },
    /// The system does not start so many threads.
    #[error("{threads} threads cannot be started: {why}")]
    Threads {
        /// Number of threads.
        threads: usize,
        /// What the system says.
        why: String,
    },
}
