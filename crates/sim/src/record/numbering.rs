//! Vehicles by their number: those of the demand, and apart from them those that users put on the road.

use serde::{Deserialize, Serialize};

use crate::state::externals::FIRST_INSERTED;
use crate::state::lane::VehicleId;

/// Something for the vehicles of the demand, and the same for those that users put on the road.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Both<T> {
    arrived: T,
    inserted: T,
}

impl<T> Both<T> {
    /// The one of the vehicle `id`, and the number of the vehicle there.
    pub(crate) fn of(&self, id: VehicleId) -> (&T, u32) {
        match id.checked_sub(FIRST_INSERTED) {
            Some(number) => (&self.inserted, number),
            None => (&self.arrived, id),
        }
    }

    /// The same, mutable.
    pub(crate) fn of_mut(&mut self, id: VehicleId) -> (&mut T, u32) {
        match id.checked_sub(FIRST_INSERTED) {
            Some(number) => (&mut self.inserted, number),
            None => (&mut self.arrived, id),
        }
    }

    /// Both.
    pub(crate) fn all(&self) -> [&T; 2] {
        [&self.arrived, &self.inserted]
    }
}
