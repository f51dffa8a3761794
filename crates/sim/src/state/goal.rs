//! The destination of a driver.

use serde::{Deserialize, Serialize};

/// Destination and route of a driver: the index of its table of waypoints. At first this is the index of the
/// destination in the list of destinations. `None`: the driver follows the road.
pub type Destination = Option<u16>;

/// A destination in two bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Goal(u16);

impl Goal {
    /// Stands for no destination.
    pub(crate) const NONE: u16 = u16::MAX;

    /// The destination.
    #[inline]
    pub fn destination(self) -> Destination {
        (self.0 != Goal::NONE).then_some(self.0)
    }
}

impl From<Destination> for Goal {
    fn from(destination: Destination) -> Goal {
        Goal(destination.unwrap_or(Goal::NONE))
    }
}

/// A station on a chain where the trips to a destination end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TripEnd {
    /// Along the chain [m].
    pub(crate) station: f64,
    /// The destination.
    pub(crate) goal: Goal,
}
