//! What users can set, as it is now. What waits for the next step counts as set: a program that has just set something
//! reads what it has set.

use laneweave_models::Parameter;
use laneweave_network::{Id, LightState};

use crate::state::command::Command;
use crate::state::control::Control;
use crate::state::externals::Kind;
use crate::state::lane::VehicleId;
use crate::step::command_error::CommandError;
use crate::step::names;
use crate::step::world::World;

impl World {
    /// The value of a number of a style: the mean over its drivers. `None` if no driver has this style, or the style
    /// has no such number.
    pub fn parameter(&self, style: &str, parameter: Parameter) -> Option<f64> {
        let waiting = self.waiting_command(|it| match it {
            Command::SetParameter { style: of, parameter: number, value } => {
                (of == style && *number == parameter).then_some(*value)
            }
            _ => None,
        });
        waiting.or_else(|| {
            let own = self.driver_parameters().iter().filter(|it| it.name == style);
            let values: Vec<f64> = own.filter_map(|it| parameter.value(it)).collect();
            // Equal values have exactly their mean.
            let first = *values.first()?;
            Some(first + values.iter().map(|it| it - first).sum::<f64>() / values.len() as f64)
        })
    }

    /// The weight of a style among those of the drivers who arrive.
    pub fn share(&self, style: &str) -> Option<f64> {
        let waiting = self.waiting_command(|it| match it {
            Command::SetShare { style: of, weight } => (of == style).then_some(*weight),
            _ => None,
        });
        waiting.or_else(|| {
            let number = names::style(&self.roads, self.arrivals.demand(), style)?;
            Some(self.arrivals.weights()[number])
        })
    }

    /// The demand at an origin now [veh/h].
    pub fn demand_at(&self, origin: Id) -> Option<f64> {
        let waiting = self.waiting_command(|it| match it {
            Command::SetDemand { origin: of, vehicles_per_hour } => {
                (*of == origin).then_some(*vehicles_per_hour)
            }
            _ => None,
        });
        waiting.or_else(|| {
            let demand = self.arrivals.demand();
            let number = names::origin(demand, origin)?;
            let planned = || demand.origins[number].rate.at(self.clock().time());
            Some(self.arrivals.sources()[number].user_rate().unwrap_or_else(planned))
        })
    }

    /// What a user makes a light show, whatever its program says; the inner `None` if its program decides.
    pub fn light_override(&self, light: Id) -> Option<Option<LightState>> {
        let waiting = self.waiting_command(|it| match it {
            Command::SetLight { light: of, shows } => (*of == light).then_some(*shows),
            _ => None,
        });
        waiting.or_else(|| {
            let index = names::light(self.roads.network(), light)?;
            Some(self.junctions.signals().user_set(index))
        })
    }

    /// The offset of the plan of a light: when its first phase begins, and every further cycle [s]. A plan that comes
    /// to a new offset has the new one. `None` if the light has no plan.
    pub fn offset(&self, light: Id) -> Option<f64> {
        let network = self.roads.network();
        let (plan, _) = names::plan(network, light)?;
        let waiting = self.waiting_command(|it| match it {
            Command::SetOffset { light: of, offset_s } => {
                names::plan(network, *of).is_some_and(|it| it.0.first == plan.first).then_some(*offset_s)
            }
            _ => None,
        });
        Some(waiting.unwrap_or_else(|| self.junctions.signals().offset(plan)))
    }

    /// Whether a lanelet is closed. `None` if there is no such lanelet.
    pub fn is_closed(&self, lanelet: Id) -> Option<bool> {
        let waiting = self.waiting_command(|it| match it {
            Command::CloseLanelet { lanelet: of, is_closed } => (*of == lanelet).then_some(*is_closed),
            _ => None,
        });
        let index = self.roads.network().lanelet_with(lanelet)?;
        Some(waiting.unwrap_or_else(|| self.roads.navigator().closures().closed().contains(&index)))
    }

    /// How a user drives a vehicle; [`Control::DRIVER`] if its driver does.
    pub fn control_of(&self, id: VehicleId) -> Control {
        let waiting = self.waiting_command(|it| match it {
            Command::Control(of, control) => (*of == id).then_some(*control),
            _ => None,
        });
        waiting.unwrap_or_else(|| {
            let external = self.traffic.externals().of(id);
            external.filter(|it| !matches!(it.kind, Kind::Line(_))).map_or(Control::DRIVER, |it| it.control)
        })
    }

    /// The style of the driver of a vehicle on the road.
    pub fn style_of(&self, id: VehicleId) -> Option<&str> {
        let vehicle = self.vehicle(id)?;
        let waiting = self.commands.waiting().iter().find_map(|it| match &it.command {
            Command::SetStyle(of, style) => (*of == id).then_some(style.as_str()),
            _ => None,
        });
        Some(waiting.unwrap_or(&self.roads.style(vehicle.driver.parameters).name))
    }

    /// Whether a vehicle is taken off the road in the next step.
    pub fn is_leaving(&self, id: VehicleId) -> bool {
        self.waiting_command(|it| (*it == Command::Remove(id)).then_some(())).is_some()
    }

    /// Gives a command as [`World::command`] does, in place of those that wait for the next step and contradict it: one
    /// of its kind for the same thing, and all others for a vehicle that is to be removed.
    ///
    /// # Errors
    /// If it is impossible. Nothing changes then.
    pub fn replace_command(&mut self, command: Command) -> Result<Option<VehicleId>, CommandError> {
        let before = self.commands.clone();
        self.commands.withdraw(&command);
        self.command(command).inspect_err(|_| self.commands = before)
    }

    /// What `found` finds in a command that waits for the next step.
    fn waiting_command<T>(&self, found: impl Fn(&Command) -> Option<T>) -> Option<T> {
        self.commands.waiting().iter().find_map(|it| found(&it.command))
    }
}
