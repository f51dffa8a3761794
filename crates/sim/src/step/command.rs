//! Users give commands. A command is checked when it is given, and carried out before the decisions of the next step.
//! Only a new vehicle is on the road at once. The order in which a user gives commands between two steps changes
//! nothing.

use laneweave_models::Parameter;
use laneweave_network::Id;

use crate::demand::{Demand, SECONDS_PER_HOUR};
use crate::route::closures::Closures;
use crate::state::command::{Command, NewVehicle};
use crate::state::control::{Control, Lateral, Longitudinal};
use crate::state::lane::VehicleId;
use crate::step::command_error::{CommandError, in_range};
use crate::step::insert::check_place;
use crate::step::names;
use crate::step::put_vehicle::{Named, put};
use crate::step::world::World;

impl World {
    /// Gives a command. It is carried out before the decisions of the next step; a new vehicle is on the road at once,
    /// and its id is returned.
    ///
    /// # Errors
    /// If it is impossible. Nothing changes then.
    pub fn command(&mut self, command: Command) -> Result<Option<VehicleId>, CommandError> {
        self.check_command(&command)?;
        let step = self.clock().step;
        let vehicle = match &command {
            Command::Insert(vehicle) => Some(self.insert(vehicle)?),
            other => other.vehicle(),
        };
        self.commands.wait(step, vehicle, command);
        Ok(vehicle)
    }

    /// Puts a vehicle on the road that nobody but the command brought there.
    fn insert(&mut self, vehicle: &NewVehicle) -> Result<VehicleId, CommandError> {
        let placement = check_place(self, vehicle)?;
        self.forget_index();
        let World { roads, traffic, arrivals, log, .. } = self;
        let id = arrivals.new_inserted();
        let (now, length) = (traffic.clock().time(), placement.class.body().length);
        put(roads, traffic, log, placement, Named { id, arrived: now, length, line: None });
        Ok(id)
    }

    fn check_command(&self, command: &Command) -> Result<(), CommandError> {
        if let Some(id) = command.vehicle() {
            self.vehicle(id).ok_or(CommandError::NoVehicle(id))?;
        }
        self.check_other_commands(command)?;
        match command {
            // Its place is checked when it is put there.
            Command::Insert(_) => Ok(()),
            Command::SetDestination(id, destination) => self.check_destination(*id, *destination),
            Command::Control(id, control) => {
                check_control(*control)?;
                self.check_lane_for(*id, *control)
            }
            other => self.check_content(other),
        }
    }

    /// Checks the numbers of a command, and whether the things that it names exist; not whether the vehicle that it
    /// concerns is on the road. A new vehicle must be able to be at its place now.
    ///
    /// # Errors
    /// If one of them is not so.
    pub fn check_content(&self, command: &Command) -> Result<(), CommandError> {
        match command {
            Command::Insert(vehicle) => check_place(self, vehicle).map(|_| ()),
            Command::Remove(_) => Ok(()),
            Command::Control(_, control) => check_control(*control),
            Command::SetStyle(id, style) => self.parameters_of(style, *id).map(|_| ()),
            Command::SetDestination(_, destination) => {
                destination.map_or(Ok(()), |it| self.destination(it).map(|_| ()))
            }
            Command::SetDemand { origin, vehicles_per_hour } => {
                let origin = self.origin(*origin)?;
                in_range("a demand", *vehicles_per_hour, [0.0, Demand::LARGEST_RATE], "veh/h")?;
                let demand = self.demand();
                let lanes = demand.origins[origin].lanes(self.network()) as f64;
                let of_a_lane = vehicles_per_hour / (SECONDS_PER_HOUR * lanes);
                demand.headways.check(of_a_lane).map_err(|it| CommandError::Headways(it.to_string()))
            }
            Command::SetShare { style, weight } => self.check_share(style, *weight),
            Command::SetLight { light, .. } => self.light_with(*light).map(|_| ()),
            Command::SetOffset { light, offset_s } => self.check_offset(*light, *offset_s),
            Command::CloseLanelet { lanelet, is_closed } => self.check_closing(*lanelet, *is_closed),
            Command::SetParameter { style, parameter, value } => {
                self.check_parameter(style, *parameter, *value)
            }
        }
    }

    /// Checks that a style can have this weight, and that some style has one, with all that waits to be changed.
    fn check_share(&self, style: &str, weight: f64) -> Result<(), CommandError> {
        /// The largest weight: a share is one of a million at least.
        const LARGEST: f64 = 1e6;
        self.parameters_of(style, VehicleId::MAX)?;
        in_range("the weight of a style", weight, [0.0, LARGEST], "")?;
        let number = |it: &str| names::style(&self.roads, self.arrivals.demand(), it);
        let mut weights = self.arrivals.weights().to_vec();
        let mut set = |style: &str, weight| number(style).into_iter().for_each(|it| weights[it] = weight);
        for waiting in self.commands.waiting() {
            if let Command::SetShare { style, weight } = &waiting.command {
                set(style, *weight);
            }
        }
        set(style, weight);
        if weights.iter().sum::<f64>() > 0.0 { Ok(()) } else { Err(CommandError::NoStyle) }
    }

    /// Checks that the plan of a light can have this offset.
    fn check_offset(&self, light: Id, offset_s: f64) -> Result<(), CommandError> {
        /// A day [s].
        const LONGEST: f64 = 86_400.0;
        self.light_with(light)?;
        in_range("an offset", offset_s, [0.0, LONGEST], "s")?;
        let why = match names::plan(self.roads.network(), light) {
            None => "it is always green",
            Some((plan, _)) if plan.is_actuated => "traffic extends its greens",
            Some(_) => return Ok(()),
        };
        Err(CommandError::Offset { light, why })
    }

    /// Checks that a vehicle that is to drive in lanes is in one.
    fn check_lane_for(&self, id: VehicleId, control: Control) -> Result<(), CommandError> {
        let drives_in_lanes = matches!(control, Control::Drive { .. });
        let is_astray = drives_in_lanes && self.vehicle(id).is_some_and(|it| !it.is_in_lane());
        if is_astray { Err(CommandError::Astray(id)) } else { Ok(()) }
    }

    /// Checks that drivers can leave the lane of a lanelet before it, and of all that are closed with it.
    fn check_closing(&self, lanelet: Id, is_closed: bool) -> Result<(), CommandError> {
        let index = self.lanelet_with(lanelet)?;
        if !is_closed {
            return Ok(());
        }
        let network = self.roads.network();
        let mut closed = self.roads.navigator().closures().closed().to_vec();
        for waiting in self.commands.waiting() {
            if let Command::CloseLanelet { lanelet, is_closed: true } = waiting.command {
                closed.extend(network.lanelet_with(lanelet));
            }
        }
        closed.push(index);
        let closures = Closures::of(network, closed, Vec::new());
        let why = closures.closed().iter().find_map(|it| closures.flaw(network, *it));
        why.map_or(Ok(()), |why| Err(CommandError::Closing { lanelet, why }))
    }

    /// Checks that a style can have this value, with all that waits to be changed in it.
    fn check_parameter(&self, style: &str, parameter: Parameter, value: f64) -> Result<(), CommandError> {
        self.parameters_of(style, VehicleId::MAX)?;
        let parameters = self.roads.changed_parameters();
        let mut changes = parameters.changes().clone();
        changes.extend(self.commands.waiting().iter().filter_map(|it| match &it.command {
            Command::SetParameter { style, parameter, value } => Some(((style.clone(), *parameter), *value)),
            _ => None,
        }));
        changes.insert((style.into(), parameter), value);
        let refused = |why| CommandError::Parameter { style: style.into(), parameter, value, why };
        parameters.with(changes).map(|_| ()).map_err(refused)
    }

    /// Checks that the driver of a vehicle can take another destination now.
    fn check_destination(&self, id: VehicleId, destination: Option<Id>) -> Result<(), CommandError> {
        let Some(name) = destination else { return Ok(()) };
        let number = self.destination(name)?;
        let vehicle = self.vehicle(id).ok_or(CommandError::NoVehicle(id))?;
        if !vehicle.is_in_lane() {
            return Err(CommandError::Astray(id));
        }
        let (scene, navigator) = (self.scene(), self.roads.navigator());
        let refused = |why| Err(CommandError::Destination { vehicle: id, destination: name, why });
        if scene.has_reservation(vehicle.spot, f64::NEG_INFINITY) {
            return refused(
                "it is passing a junction on its old route; give the command again when it has left it",
            );
        }
        let (chain, x) = (vehicle.spot.chain, vehicle.x());
        let destination = navigator.seen_by(vehicle.driver.class, Some(number));
        if !navigator.waypoint_from(self.roads.network(), destination, chain, x).leads_on(x) {
            return refused("no route leads there from its place; choose another destination");
        }
        Ok(())
    }

    /// Checks that one thing gets one command of a kind in a step.
    fn check_other_commands(&self, command: &Command) -> Result<(), CommandError> {
        let Some(target) = command.target() else { return Ok(()) };
        let others =
            self.commands.waiting().iter().filter(|it| it.command.target().as_ref() == Some(&target));
        for other in others {
            match (&other.command, command) {
                (Command::Remove(id), _) => return Err(CommandError::Removed(*id)),
                (other, Command::Remove(id)) if other.rank() != command.rank() => {
                    return Err(CommandError::Twice(format!("vehicle {id}")));
                }
                (other, _) if other.rank() == command.rank() => {
                    return Err(CommandError::Twice(target.to_string()));
                }
                _ => {}
            }
        }
        Ok(())
    }
}

/// Checks the numbers of a control.
pub(super) fn check_control(control: Control) -> Result<(), CommandError> {
    let longitudinal = match control {
        Control::Drive { longitudinal, lateral: Lateral::Driver | Lateral::Keep | Lateral::Change(_) } => {
            longitudinal
        }
        Control::Pose { x, y, heading, speed } => {
            let place = [-Control::FARTHEST, Control::FARTHEST];
            in_range("a place to the east", x, place, "m")?;
            in_range("a place to the north", y, place, "m")?;
            in_range("a heading", heading, place, "rad")?;
            return in_range("a speed", speed, [0.0, Control::FASTEST], "m/s");
        }
    };
    match longitudinal {
        Longitudinal::Driver => Ok(()),
        Longitudinal::Acceleration(value) => {
            in_range("an acceleration", value, [-Control::HARDEST, Control::HARDEST], "m/s²")
        }
        Longitudinal::Speed(value) | Longitudinal::AtMost(value) => {
            in_range("a speed", value, [0.0, Control::FASTEST], "m/s")
        }
    }
}
