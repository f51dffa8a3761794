//! How a run ended.

use super::queues::Queue;
use super::short_trips::ShortTrips;

/// How a run ended.
#[derive(Clone, Debug, PartialEq)]
pub struct Ending {
    /// Simulated time at which measuring began [s].
    pub measured_from_s: f64,
    /// Simulated and measured time [s].
    pub measured_s: f64,
    /// Whether it was interrupted before its end.
    pub is_interrupted: bool,
    /// The remaining queues at the entrances, the longest first.
    pub queues: Vec<Queue>,
    /// The trips within one lanelet.
    pub short_trips: ShortTrips,
}
