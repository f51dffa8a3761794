//! What the names in commands stand for.

use laneweave_network::{Id, InPlan, LightIndex, Network};

use crate::demand::{Demand, Share};
use crate::route::roads::Roads;
use crate::state::goal::Destination;
use crate::state::lane::VehicleId;
use crate::state::random::Purpose;

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
pub(super) fn destination(demand: &Demand, name: Id) -> Destination {
    demand.exits().iter().zip(0..).find(|(it, _)| it.id() == name).map(|(_, number)| number)
}

/// The origin with this name.
pub(super) fn origin(demand: &Demand, name: Id) -> Option<usize> {
    demand.origins.iter().position(|it| it.place.id() == name)
}

/// The light with this name.
pub(super) fn light(network: &Network, name: Id) -> Option<LightIndex> {
    let lights = network.junctions.lights.iter().zip(0..);
    lights.into_iter().find(|(it, _)| it.id == name).map(|(_, index)| LightIndex(index))
}

/// The plan of the light with this name, if it has one, and the length of its cycle [s].
pub(super) fn plan(network: &Network, name: Id) -> Option<(InPlan, f64)> {
    let light = &network.junctions.lights[self::light(network, name)?.at()];
    light.plan.map(|it| (it, light.program.cycle))
}
