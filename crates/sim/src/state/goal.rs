//! Where a driver goes.

use serde::{Deserialize, Serialize};

/// Where a driver goes and which way: at first the destination's place in the list of destinations. `None`: it drives
/// on as the road leads.
pub type Destination = Option<u16>;

/// A destination in two bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Goal(u16);

impl Goal {
    /// In place of a destination where there is none.
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

/// Where on a chain the trips to a destination end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TripEnd {
    /// Along the chain [m].
    pub(crate) station: f64,
    /// For whom.
    pub(crate) goal: Goal,
}
