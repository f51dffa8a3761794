//! Names for the numbers in batches: lanelets, styles, origins and destinations, and SUMO's names of lanes.

use std::sync::Arc;

use laneweave_network::{Lanelet, LaneletIndex, Network, Position};
use laneweave_sim::{Place, World};

use super::sumo::Lanes;

/// The data that all writers look up.
pub(super) struct Names {
    /// The roads.
    pub(super) network: Arc<Network>,
    /// For each set of driver parameters the name of its style, and its speed factor.
    driver_parameters: Vec<(String, f64)>,
    /// The ids of the origins and of the destinations, in the order of the demand.
    origins: Vec<i64>,
    destinations: Vec<i64>,
    /// The lanelets as lanes of SUMO.
    pub(super) lanes: Lanes,
    /// Length of a step [s].
    pub(super) step_s: f64,
}

impl Names {
    pub(super) fn of(world: &World) -> Names {
        let network = world.shared_network();
        let driver_parameters =
            world.scene().driver_parameters.iter().map(|it| (it.name.clone(), it.speed_factor));
        let demand = world.demand();
        Names {
            driver_parameters: driver_parameters.collect(),
            origins: demand.origins.iter().map(|it| it.place.id()).collect(),
            destinations: demand.destinations.iter().map(Place::id).collect(),
            lanes: Lanes::of(&network),
            step_s: world.clock().dt,
            network,
        }
    }

    /// The lanelet at a place, and the station on it [m].
    pub(super) fn lanelet(&self, at: Position) -> (LaneletIndex, &Lanelet, f64) {
        let (index, along) = self.network.chain(at.chain).lanelet(at.x);
        (index, &self.network.lanelets[index.at()], along)
    }

    /// Whether there is such a place.
    pub(super) fn has_place(&self, at: Position) -> bool {
        at.chain.at() < self.network.chains.len() && at.x.is_finite()
    }

    /// Whether there is such a set of driver parameters.
    pub(super) fn has_driver(&self, parameters: u32) -> bool {
        (parameters as usize) < self.driver_parameters.len()
    }

    /// The style of a set of driver parameters.
    pub(super) fn style(&self, parameters: u32) -> &str {
        &self.driver_parameters[parameters as usize].0
    }

    /// The styles of all sets of driver parameters.
    pub(super) fn styles(&self) -> impl Iterator<Item = &str> {
        self.driver_parameters.iter().map(|(style, _)| style.as_str())
    }

    /// Speed factor of a set of driver parameters: multiple of the speed limit.
    pub(super) fn speed_factor(&self, parameters: u32) -> f64 {
        self.driver_parameters[parameters as usize].1
    }

    /// The id of an origin of the demand.
    pub(super) fn origin(&self, number: Option<usize>) -> Option<i64> {
        number.and_then(|it| self.origins.get(it)).copied()
    }

    /// The id of a destination of the demand.
    pub(super) fn destination(&self, number: Option<usize>) -> Option<i64> {
        number.and_then(|it| self.destinations.get(it)).copied()
    }
}
