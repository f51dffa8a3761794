//! What the names in commands stand for.

use laneweave_network::{InPlan, LaneletIndex, LightIndex, Network};

use crate::demand::{Demand, Share};
use crate::route::place::Place;
use crate::route::roads::Roads;
use crate::state::goal::Destination;
use crate::state::lane::VehicleId;
use crate::state::random::Purpose;
use crate::step::command::CommandError;
use crate::step::world::World;

/// A list of names in a remedy has at most this many.
const LISTED: usize = 20;

/// The index of a set of driver parameters of `style` for the vehicle `id`, drawn at random from the sets of the
/// population.
pub(super) fn parameters_of(roads: &Roads, demand: &Demand, style: &str, id: VehicleId) -> Option<u32> {
    let Share { first, count, .. } = demand.population[self::style(roads, demand, style)?];
    let drawn = (roads.random().uniform(id, Purpose::Character, 0) * f64::from(count)) as u32;
    Some(first + drawn.min(count - 1))
}

/// The place of the style with this name in the population.
pub(super) fn style(roads: &Roads, demand: &Demand, name: &str) -> Option<usize> {
    let is_named = |it: u32| roads.driver_parameters().get(it as usize).is_some_and(|it| it.name == name);
    demand.population.iter().position(|it| it.count > 0 && is_named(it.first))
}

/// The destination with this name.
pub(super) fn destination(demand: &Demand, name: i64) -> Destination {
    demand.destinations.iter().zip(0..).find(|(it, _)| it.id() == name).map(|(_, number)| number)
}

/// The origin with this name.
pub(super) fn origin(demand: &Demand, name: i64) -> Option<usize> {
    demand.origins.iter().position(|it| it.place.id() == name)
}

/// The light with this name.
pub(super) fn light(network: &Network, name: i64) -> Option<LightIndex> {
    let lights = network.junctions.lights.iter().zip(0..);
    lights.into_iter().find(|(it, _)| it.id == name).map(|(_, index)| LightIndex(index))
}

/// The plan of the light with this name, if it has one, and the length of its cycle [s].
pub(super) fn plan(network: &Network, name: i64) -> Option<(InPlan, f64)> {
    let light = &network.junctions.lights[self::light(network, name)?.at()];
    light.plan.map(|it| (it, light.program.cycle))
}

impl World {
    /// The same, checked.
    ///
    /// # Errors
    /// If no driver of the world has this style.
    pub(super) fn parameters_of(&self, style: &str, id: VehicleId) -> Result<u32, CommandError> {
        parameters_of(&self.roads, self.arrivals.demand(), style, id).ok_or_else(|| {
            let mut known: Vec<&str> = self.driver_parameters().iter().map(|it| it.name.as_str()).collect();
            known.dedup();
            unknown("style", style, known.into_iter().map(String::from))
        })
    }

    /// # Errors
    /// If there is no such destination.
    pub(super) fn destination(&self, name: i64) -> Result<u16, CommandError> {
        let demand = self.arrivals.demand();
        destination(demand, name)
            .ok_or_else(|| unknown("destination", &name.to_string(), ids(demand.destinations.iter())))
    }

    /// # Errors
    /// If there is no such origin.
    pub(super) fn origin(&self, name: i64) -> Result<usize, CommandError> {
        let demand = self.arrivals.demand();
        let places = || ids(demand.origins.iter().map(|it| &it.place));
        origin(demand, name).ok_or_else(|| unknown("origin", &name.to_string(), places()))
    }

    /// # Errors
    /// If there is no such lanelet.
    pub(super) fn lanelet_with(&self, name: i64) -> Result<LaneletIndex, CommandError> {
        self.roads.network().lanelet_with(name).ok_or_else(|| CommandError::Unknown {
            what: "lanelet",
            name: name.to_string(),
            remedy: "choose one that vehicles may use".into(),
        })
    }

    /// # Errors
    /// If there is no such light.
    pub(super) fn light_with(&self, name: i64) -> Result<LightIndex, CommandError> {
        let network = self.roads.network();
        let lights = || network.junctions.lights.iter().map(|it| it.id.to_string());
        light(network, name).ok_or_else(|| unknown("light", &name.to_string(), lights()))
    }
}

fn ids<'a>(places: impl Iterator<Item = &'a Place>) -> impl Iterator<Item = String> {
    places.map(|it| it.id().to_string())
}

fn unknown(what: &'static str, name: &str, known: impl Iterator<Item = String>) -> CommandError {
    let mut known: Vec<String> = known.collect();
    let more = known.len().saturating_sub(LISTED);
    known.truncate(LISTED);
    let remedy = match (known.is_empty(), more) {
        (true, _) => format!("this world has no {what}"),
        (false, 0) => format!("known are {}", known.join(", ")),
        (false, more) => format!("known are {} and {more} more", known.join(", ")),
    };
    CommandError::Unknown { what, name: name.into(), remedy }
}
