//! Commands of the user: what a program does to the traffic.
//!
//! A command is checked when it is given, and carried out before the decisions of the next step. Only an inserted
//! vehicle is on the road at once. The order of commands between two steps changes nothing.

use laneweave_models::Parameter;
use laneweave_network::{Id, LightState};
use laneweave_scenario::{Fault, refused};
use laneweave_sim::{Command, Control, NewVehicle, Placement, VehicleId};

use super::Simulation;

impl Simulation {
    /// Puts a vehicle on the road, at once, and returns its id. Its own driver drives it.
    ///
    /// # Errors
    /// If it cannot be there, if another vehicle could not stay clear of it, or if something that it names does not
    /// exist.
    pub fn insert(&mut self, vehicle: NewVehicle) -> Result<VehicleId, Fault> {
        let place = format!("insert on lanelet {}", vehicle.lanelet);
        let inserted = self.command(&place, Command::Insert(vehicle))?;
        inserted.ok_or_else(|| Fault::bug(place, "the new vehicle has no id"))
    }

    /// Takes a vehicle off the road. Its trip does not count as completed.
    ///
    /// # Errors
    /// If it is not on the road, or has another command in this step.
    pub fn remove(&mut self, id: VehicleId) -> Result<(), Fault> {
        self.for_vehicle("remove", id, Command::Remove(id))
    }

    /// Drives a vehicle in place of its driver, until the next control. [`Control::DRIVER`] gives it back.
    ///
    /// # Errors
    /// If it is not on the road, if a number is not in its range, or if it has a control in this step.
    pub fn control(&mut self, id: VehicleId, control: Control) -> Result<(), Fault> {
        self.for_vehicle("control", id, Command::Control(id, control))
    }

    /// Gives the driver of a vehicle another style of the scenario, by its name.
    ///
    /// # Errors
    /// If the vehicle is not on the road, if no driver of the scenario has this style, or if the vehicle has such a
    /// command in this step.
    pub fn set_style(&mut self, id: VehicleId, style: impl Into<String>) -> Result<(), Fault> {
        self.for_vehicle("set_style", id, Command::SetStyle(id, style.into()))
    }

    /// Gives the driver of a vehicle another destination: the smallest lanelet id of an exit. `None`: it follows the
    /// road.
    ///
    /// # Errors
    /// If the vehicle is not on the road, if there is no such destination, if no route leads there, or if the vehicle
    /// has such a command in this step.
    pub fn set_destination(&mut self, id: VehicleId, destination: Option<Id>) -> Result<(), Fault> {
        self.for_vehicle("set_destination", id, Command::SetDestination(id, destination))
    }

    /// Sets the demand at an entrance from now on [veh/h]. `origin` is the smallest lanelet id of the entrance.
    ///
    /// # Errors
    /// If there is no such entrance, if the demand is not in its range, or if the entrance has such a command in this
    /// step.
    pub fn set_demand(&mut self, origin: impl Into<Id>, vehicles_per_hour: f64) -> Result<(), Fault> {
        let origin = origin.into();
        let command = Command::SetDemand { origin, vehicles_per_hour };
        self.command(&format!("set_demand of origin {origin}"), command).map(|_| ())
    }

    /// Sets the weight of a style among those of the drivers who arrive from now on. The shares of the styles are in
    /// proportion to their weights.
    ///
    /// # Errors
    /// If no driver of the scenario has this style, if the weight is not between 0 and 1,000,000, if no style would
    /// have a weight, or if the style has such a command in this step.
    pub fn set_share(&mut self, style: impl Into<String>, weight: f64) -> Result<(), Fault> {
        let style = style.into();
        let place = format!("set_share of style {style}");
        self.command(&place, Command::SetShare { style, weight }).map(|_| ())
    }

    /// Makes a light show a state, whatever its program says. `None`: it follows its program again.
    ///
    /// # Errors
    /// If there is no such light, or if it has such a command in this step.
    pub fn set_light(&mut self, light: impl Into<Id>, shows: Option<LightState>) -> Result<(), Fault> {
        let light = light.into();
        let command = Command::SetLight { light, shows };
        self.command(&format!("set_light of light {light}"), command).map(|_| ())
    }

    /// Gives the signal plan of a light another offset: when its first phase begins, and every further cycle [s]. The
    /// phases of the plan take a quarter longer until it is there, which is after at most five cycles.
    ///
    /// # Errors
    /// If there is no such light, if it has no plan, if traffic extends the greens of the plan, if the offset is not
    /// between 0 and 86,400 s, or if the plan of the light has such a command in this step.
    pub fn set_offset(&mut self, light: impl Into<Id>, offset_s: f64) -> Result<(), Fault> {
        let light = light.into();
        self.command(&format!("set_offset of light {light}"), Command::SetOffset { light, offset_s })
            .map(|_| ())
    }

    /// Closes a lanelet to all vehicles, or opens it again. Vehicles on it drive off it. Drivers change to a lane
    /// beside it in time, as before the end of a lane.
    ///
    /// # Errors
    /// If there is no such lanelet, if drivers could not leave its lane before it, or if it has such a command in this
    /// step.
    pub fn close_lanelet(&mut self, lanelet: impl Into<Id>, is_closed: bool) -> Result<(), Fault> {
        let lanelet = lanelet.into();
        let command = Command::CloseLanelet { lanelet, is_closed };
        self.command(&format!("close_lanelet of lanelet {lanelet}"), command).map(|_| ())
    }

    /// Changes a number of a style, such as the [weight](Parameter::Weight) of courtesy: for all of its drivers on the
    /// road, and for those who enter later. A number that is distributed becomes the same for all of them.
    ///
    /// # Errors
    /// If no driver of the scenario has this style, if it has no such number, if the value is not in its range, or if
    /// the number has such a command in this step.
    pub fn set_parameter(
        &mut self,
        style: impl Into<String>,
        parameter: Parameter,
        value: f64,
    ) -> Result<(), Fault> {
        let style = style.into();
        let place = format!("set_parameter of style {style}");
        self.command(&place, Command::SetParameter { style, parameter, value }).map(|_| ())
    }

    /// Gives a command. A new vehicle is on the road at once, and its id is returned; everything else is carried out
    /// before the decisions of the next step.
    ///
    /// # Errors
    /// If it is not possible. Nothing changes then.
    pub fn give(&mut self, command: Command) -> Result<Option<VehicleId>, Fault> {
        let place = place_of(&command);
        self.command(&place, command)
    }

    /// The same, in place of the commands that wait for the next step and contradict it: one of its kind for the same
    /// thing, and all others for a vehicle that is to be removed. For sliders that move while time stands.
    ///
    /// # Errors
    /// If it is not possible. Nothing changes then.
    pub fn replace(&mut self, command: Command) -> Result<Option<VehicleId>, Fault> {
        let place = place_of(&command);
        let given = self.prepared.world.replace_command(command);
        self.is_commanded = true;
        given.map_err(|error| refused(place, &error))
    }

    /// Checks the numbers of a command, and whether the things that it names exist, not whether the vehicle that it
    /// concerns is on the road.
    ///
    /// # Errors
    /// If one of them is not so.
    pub fn check_command(&self, command: &Command) -> Result<(), Fault> {
        self.world().check_content(command).map_err(|error| refused(place_of(command), &error))
    }

    /// Puts a vehicle on the road, even where it touches another one: for tests.
    ///
    /// # Errors
    /// If there is no such place.
    #[doc(hidden)]
    pub fn place(&mut self, vehicle: Placement) -> Result<VehicleId, Fault> {
        self.prepared.world.place(vehicle).map_err(|error| Fault::new("place", error, "choose another place"))
    }

    fn for_vehicle(&mut self, act: &str, id: VehicleId, command: Command) -> Result<(), Fault> {
        self.command(&format!("{act} of vehicle {id}"), command).map(|_| ())
    }

    fn command(&mut self, place: &str, command: Command) -> Result<Option<VehicleId>, Fault> {
        let given = self.prepared.world.command(command).map_err(|error| refused(place, &error))?;
        self.is_commanded = true;
        Ok(given)
    }
}

/// What a command concerns, as the place of its faults.
fn place_of(command: &Command) -> String {
    command.target().map_or_else(|| "a new vehicle".to_owned(), |it| it.to_string())
}
