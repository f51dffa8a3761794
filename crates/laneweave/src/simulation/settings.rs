//! What can be set, as it is now. A command that waits for the next step counts: a program that has just set something
//! reads what it has set.

use laneweave_models::{Parameter, Style};
use laneweave_network::{Id, LightState};
use laneweave_sim::{Commanded, Control, Place, VehicleId};

use super::Simulation;

/// A style of the scenario.
#[derive(Clone, Debug, PartialEq)]
pub struct StyleState {
    /// The name of the style, as commands take it.
    pub name: String,
    /// One sentence about it.
    pub description: String,
    /// Its weight among the styles of the drivers who arrive.
    pub weight: f64,
    /// Its numbers that can be set, with their values: the mean over its drivers.
    pub parameters: Vec<(Parameter, f64)>,
}

impl Simulation {
    /// The styles of the scenario, in the order of the indices in [`Columns::style`](laneweave_sim::Columns).
    pub fn styles(&self) -> Vec<StyleState> {
        self.prepared.conditions.styles.iter().map(|(name, _)| self.style_state(name)).collect()
    }

    fn style_state(&self, name: &str) -> StyleState {
        let mut own = self.world().driver_parameters().iter().filter(|it| it.name == name);
        let numbers = Parameter::ALL.iter();
        StyleState {
            name: name.to_owned(),
            description: own.next().map_or_else(String::new, |it| it.description.clone()),
            weight: self.share(name).unwrap_or_default(),
            parameters: numbers.filter_map(|it| Some((*it, self.parameter(name, *it)?))).collect(),
        }
    }

    /// The value of a number of a style: the mean over its drivers. `None` if no driver has this style, or the style
    /// has no such number.
    pub fn parameter(&self, style: &str, parameter: Parameter) -> Option<f64> {
        self.world().parameter(style, parameter)
    }

    /// The weight of a style among those of the drivers who arrive. `None` if no driver of the scenario has this style.
    pub fn share(&self, style: &str) -> Option<f64> {
        self.world().share(style)
    }

    /// Where trips start, by the smallest lanelet id, with the demand there now [veh/h].
    pub fn origins(&self) -> Vec<(Id, f64)> {
        let places = self.world().demand().origins.iter().map(|it| it.place.id());
        places.filter_map(|id| Some((id, self.demand_at(id)?))).collect()
    }

    /// Where trips can start, and where they can end.
    pub fn places(&self) -> [Vec<&Place>; 2] {
        let demand = self.world().demand();
        [demand.origins.iter().map(|it| &it.place).collect(), demand.exits().iter().collect()]
    }

    /// Where trips can end, by the smallest lanelet id.
    pub fn destinations(&self) -> Vec<Id> {
        self.world().demand().exits().iter().map(Place::id).collect()
    }

    /// Whether a trip can lead from one of the [`Simulation::origins`] to one of the [`Simulation::destinations`].
    pub fn leads(&self, origin: impl Into<Id>, destination: impl Into<Id>) -> bool {
        let [origins, destinations] = self.places();
        let [from, to] = [(origins, origin.into()), (destinations, destination.into())]
            .map(|(places, id)| places.iter().position(|it| it.id() == id));
        from.zip(to).is_some_and(|(from, to)| self.world().leads(from, to))
    }

    /// The demand at an entrance now [veh/h]. `None` if there is no such entrance.
    pub fn demand_at(&self, origin: impl Into<Id>) -> Option<f64> {
        self.world().demand_at(origin.into())
    }

    /// What a user makes a light show, whatever its program says; the inner `None` if its program decides. `None` if
    /// there is no such light.
    pub fn light_override(&self, light: impl Into<Id>) -> Option<Option<LightState>> {
        self.world().light_override(light.into())
    }

    /// The offset of the signal plan of a light [s]. `None` if it has no plan.
    pub fn offset(&self, light: impl Into<Id>) -> Option<f64> {
        self.world().offset(light.into())
    }

    /// Whether a lanelet is closed. `None` if there is no such lanelet.
    pub fn is_closed(&self, lanelet: impl Into<Id>) -> Option<bool> {
        self.world().is_closed(lanelet.into())
    }

    /// How a user drives a vehicle; [`Control::DRIVER`] if its driver does.
    pub fn control_of(&self, id: VehicleId) -> Control {
        self.world().control_of(id)
    }

    /// The style of the driver of a vehicle. `None` if the vehicle is not on the road.
    pub fn style_of(&self, id: VehicleId) -> Option<&str> {
        self.world().style_of(id)
    }

    /// The commands that were carried out in the last step, in their order.
    pub fn commands(&self) -> &[Commanded] {
        self.world().commands()
    }

    /// Whether a vehicle is taken off the road in the next step.
    pub fn is_leaving(&self, id: VehicleId) -> bool {
        self.world().is_leaving(id)
    }

    /// The driver parameters of all drivers, style by style.
    pub fn driver_parameters(&self) -> &[Style] {
        self.world().driver_parameters()
    }
}
