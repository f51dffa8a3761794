//! The external vehicles: those that a user drives.

use laneweave_network::Position;
use serde::{Deserialize, Serialize};

use crate::state::control::Control;
use crate::state::lane::{Phase, VehicleId};

/// The external vehicles, in the order of their ids.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Externals {
    vehicles: Vec<External>,
}

/// A vehicle that a user drives.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct External {
    /// The vehicle.
    pub(crate) id: VehicleId,
    /// How the user drives it.
    pub(crate) control: Control,
    /// Position of its main entry.
    pub(crate) at: Position,
    /// The phase of its lane change.
    pub(crate) phase: Phase,
}

impl Externals {
    /// All of them.
    pub(crate) fn all(&self) -> &[External] {
        &self.vehicles
    }

    /// The external vehicle with this id.
    pub(crate) fn of(&self, id: VehicleId) -> Option<&External> {
        self.vehicles.binary_search_by_key(&id, |it| it.id).ok().map(|it| &self.vehicles[it])
    }

    /// Whether they are in order, and on chains of a network with this many.
    pub(crate) fn fit(&self, chains: usize) -> bool {
        self.vehicles.iter().all(|it| it.at.chain.at() < chains) && self.vehicles.is_sorted_by_key(|it| it.id)
    }

    /// Sets how the user drives a vehicle.
    pub(crate) fn set(&mut self, external: External) {
        match self.vehicles.binary_search_by_key(&external.id, |it| it.id) {
            Ok(place) => self.vehicles[place] = external,
            Err(place) => self.vehicles.insert(place, external),
        }
    }

    /// Forgets a vehicle that its driver drives again, or that is no longer on the road.
    pub(crate) fn forget(&mut self, id: VehicleId) {
        self.vehicles.retain(|it| it.id != id);
    }

    /// Renews each vehicle by `renew`; forgets those for which it returns `None`.
    pub(crate) fn renew(&mut self, mut renew: impl FnMut(External) -> Option<External>) {
        self.vehicles.retain_mut(|it| renew(*it).map(|new| *it = new).is_some());
    }
}
