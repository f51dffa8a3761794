//! What the names in a command stand for, or a refusal that says which names there are.

use laneweave_network::{Id, LaneletIndex, LightIndex};

use crate::route::place::Place;
use crate::state::lane::VehicleId;
use crate::step::command_error::CommandError;
use crate::step::names;
use crate::step::world::World;

/// A list of names in a remedy has at most this many.
const LISTED: usize = 20;

impl World {
    /// The index of a set of driver parameters of `style` for the vehicle `id`.
    ///
    /// # Errors
    /// If no driver of the world has this style.
    pub(super) fn parameters_of(&self, style: &str, id: VehicleId) -> Result<u32, CommandError> {
        names::parameters_of(&self.roads, self.arrivals.demand(), style, id).ok_or_else(|| {
            let mut known: Vec<&str> = self.driver_parameters().iter().map(|it| it.name.as_str()).collect();
            known.dedup();
            unknown("style", style, known.into_iter().map(String::from))
        })
    }

    /// # Errors
    /// If there is no such destination.
    pub(super) fn destination(&self, name: Id) -> Result<u16, CommandError> {
        let demand = self.arrivals.demand();
        names::destination(demand, name)
            .ok_or_else(|| unknown("destination", &name.to_string(), ids(demand.exits().iter())))
    }

    /// # Errors
    /// If there is no such origin.
    pub(super) fn origin(&self, name: Id) -> Result<usize, CommandError> {
        let demand = self.arrivals.demand();
        let places = || ids(demand.origins.iter().map(|it| &it.place));
        names::origin(demand, name).ok_or_else(|| unknown("origin", &name.to_string(), places()))
    }

    /// # Errors
    /// If there is no such lanelet.
    pub(super) fn lanelet_with(&self, name: Id) -> Result<LaneletIndex, CommandError> {
        self.roads.network().lanelet_with(name).ok_or_else(|| CommandError::Unknown {
            what: "lanelet",
            name: name.to_string(),
            remedy: "choose one that vehicles may use".into(),
        })
    }

    /// # Errors
    /// If there is no such light.
    pub(super) fn light_with(&self, name: Id) -> Result<LightIndex, CommandError> {
        let network = self.roads.network();
        let lights = || network.junctions.lights.iter().map(|it| it.id.to_string());
        names::light(network, name).ok_or_else(|| unknown("light", &name.to_string(), lights()))
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
