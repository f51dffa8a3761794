//! Names for the numbers in batches: lanelets, styles, origins and destinations, and SUMO's names of lanes.

use std::sync::Arc;

use laneweave_network::{LaneletIndex, Network, Position};
use laneweave_scenario::scenario::Scenario;
use laneweave_sim::{Class, Demand, Trips, VehicleId, World};

use super::sumo::{Lanes, attribute};

/// The data that all writers look up.
pub(super) struct Names {
    /// The roads.
    pub(super) network: Arc<Network>,
    /// For each set of driver parameters the name of its style, and its speed factor.
    driver_parameters: Vec<(String, f64)>,
    /// The ids of the lanelets.
    lanelets: Vec<String>,
    /// The names of the first vehicles, if all of them have one: as text, and as XML.
    vehicles: [Vec<String>; 2],
    /// The ids of the origins and of the destinations, in the order of the demand.
    origins: Vec<String>,
    destinations: Vec<String>,
    /// The lanelets as lanes of SUMO.
    pub(super) lanes: Lanes,
    /// Length of a step [s].
    pub(super) step_s: f64,
    /// The time of SUMO's files at which the simulation begins [s].
    pub(super) begin_s: f64,
    /// For each set of driver parameters its type of SUMO, as XML; empty if drivers have other styles.
    types: Vec<String>,
}

impl Names {
    /// The names in a world with vehicles of SUMO, if there are any.
    pub(super) fn of(world: &World, scenario: &Scenario) -> Names {
        let network = world.shared_network();
        let styles = world.scene().driver_parameters;
        let driver_parameters = styles.iter().map(|it| (it.name.clone(), it.speed_factor));
        // Its types are styles, unless others take their place.
        let has_types = scenario.sumo.is_asked() && scenario.styles.is_empty();
        let types = styles.iter().filter(|_| has_types).map(|it| attribute(&it.name));
        let demand = world.demand();
        let vehicles = vehicles(demand);
        let in_xml = vehicles.iter().map(|it| attribute(it)).collect();
        Names {
            driver_parameters: driver_parameters.collect(),
            vehicles: [vehicles, in_xml],
            lanelets: network.lanelets.iter().map(|it| it.id.to_string()).collect(),
            origins: demand.origins.iter().map(|it| it.place.id().to_string()).collect(),
            destinations: demand.destinations.iter().map(|it| it.id().to_string()).collect(),
            lanes: Lanes::of(&network),
            step_s: world.clock().dt,
            begin_s: scenario.sumo.begin_s,
            types: types.collect(),
            network,
        }
    }

    /// The lanelet at a place, and the station on it [m].
    pub(super) fn lanelet(&self, at: Position) -> (LaneletIndex, f64) {
        self.network.chain(at.chain).lanelet(at.x)
    }

    /// The id of a lanelet.
    pub(super) fn id(&self, lanelet: LaneletIndex) -> &str {
        &self.lanelets[lanelet.at()]
    }

    /// The ids of all lanelets.
    pub(super) fn ids(&self) -> impl Iterator<Item = &str> {
        self.lanelets.iter().map(String::as_str)
    }

    /// The name of a vehicle, if it has one.
    pub(super) fn vehicle(&self, id: VehicleId) -> Option<&str> {
        self.vehicles[0].get(id as usize).map(String::as_str)
    }

    /// The same as the value of an attribute.
    pub(super) fn vehicle_in_xml(&self, id: VehicleId) -> Option<&str> {
        self.vehicles[1].get(id as usize).map(String::as_str)
    }

    /// The type of a vehicle for SUMO, as the value of an attribute: its own, or its class.
    pub(super) fn type_in_xml(&self, class: Class, parameters: u32) -> &str {
        self.types.get(parameters as usize).map_or(class.body().name, String::as_str)
    }

    /// The id of the lanelet at a place.
    pub(super) fn id_at(&self, at: Position) -> &str {
        self.id(self.lanelet(at).0)
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
    pub(super) fn origin(&self, number: Option<usize>) -> Option<&str> {
        number.and_then(|it| self.origins.get(it)).map(String::as_str)
    }

    /// The id of a destination of the demand.
    pub(super) fn destination(&self, number: Option<usize>) -> Option<&str> {
        number.and_then(|it| self.destinations.get(it)).map(String::as_str)
    }
}

/// The names of the vehicles of a demand, all of which departs as it is scheduled: the n-th one has the id n.
fn vehicles(demand: &Demand) -> Vec<String> {
    let is_scheduled = demand.origins.iter().all(|it| it.trips == Trips::Scheduled);
    let named = demand.departures.iter().filter(|_| is_scheduled);
    named.map(|it| it.name.clone()).collect()
}
