//! Departures: single vehicles whose time, way and driver are known before.

use std::ops::RangeInclusive;

use crate::demand::Demand;
use crate::state::vehicle::{Class, LONGEST};

/// A vehicle that departs once. Where nobody else arrives, its id is the number of its departure.
#[derive(Clone, Debug, PartialEq)]
pub struct Departure {
    /// Its name.
    pub name: String,
    /// When it wants to start [s].
    pub time_s: f64,
    /// Index of its origin in [`Demand::origins`].
    pub origin: usize,
    /// Index of its destination in [`Demand::destinations`].
    pub destination: usize,
    /// Index in [`Demand::lines`] of the line whose stops it serves.
    pub line: Option<usize>,
    /// Its class.
    pub class: Class,
    /// Length of its vehicle [m]; `None`: as usual for its class.
    pub length_m: Option<f64>,
    /// Index of its driver's style in [`Demand::population`]; `None`: it is drawn by the weights of the styles.
    pub style: Option<usize>,
}

impl Departure {
    /// Lengths that vehicles may have [m]: junctions are made for the longest one.
    pub const LENGTHS: RangeInclusive<f64> = 0.5..=LONGEST;

    /// Whether its places and its style are those of `demand`, and its time is one.
    pub(crate) fn fits(&self, demand: &Demand) -> bool {
        self.origin < demand.origins.len()
            && self.destination < demand.exits().len()
            && self.line.is_none_or(|it| it < demand.lines.len())
            && self.style.is_none_or(|it| it < demand.population.len())
            && self.time_s >= 0.0
            && self.length_m.is_none_or(|it| Departure::LENGTHS.contains(&it))
    }
}
