//! Lines: buses that leave at fixed times, and stop at places on their way.

use crate::state::vehicle::Class;

/// A line: vehicles that start at an origin at fixed times, rest at stops on their way, and drive to a destination.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Its name.
    pub name: String,
    /// The class of its vehicles.
    pub class: Class,
    /// Index of its origin in [`Demand::origins`](crate::Demand::origins).
    pub origin: usize,
    /// Its stops in order.
    pub stops: Vec<LineStop>,
    /// Index of its destination in [`Demand::destinations`](crate::Demand::destinations).
    pub destination: usize,
    /// Times of its departures.
    pub departures: Departures,
}

/// A stop of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineStop {
    /// Index of the destination that lies [`LineStop::MARGIN`] beyond it.
    pub destination: usize,
    /// Time for which a vehicle rests there [s].
    pub rest_s: f64,
    /// It does not go on before this time [s]; `None`: whenever it has rested.
    pub until_s: Option<f64>,
}

impl LineStop {
    /// The trip end of a stop lies so far beyond the place where the front bumper stands [m] (ours): whoever rests
    /// there never reaches it.
    pub const MARGIN: f64 = 5.0;
    /// A stop in a lane that ends lies so far before the end [m] (ours): drivers keep that road to leave the lane.
    pub const BEFORE_A_LANE_END: f64 = 20.0;
}

/// Times at even intervals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Departures {
    /// The first one [s].
    pub first_s: f64,
    /// Time between two of them [s].
    pub every_s: f64,
    /// None is later than this [s].
    pub until_s: f64,
}

impl Departures {
    /// The least time between two departures [s]; ours.
    pub const SHORTEST: f64 = 1.0;

    /// The time of the departure with this `number`, from 0 on [s]; infinite if there is none.
    pub(crate) fn time(&self, number: u32) -> f64 {
        let time = self.first_s + self.every_s * f64::from(number);
        if time <= self.until_s { time } else { f64::INFINITY }
    }
}

impl Line {
    /// Index of the destination to which its vehicles drive after so many stops.
    pub(crate) fn goal(&self, stops: u16) -> u16 {
        self.stops.get(usize::from(stops)).map_or(self.destination, |it| it.destination) as u16
    }
}
