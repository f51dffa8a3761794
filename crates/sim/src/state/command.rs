//! What a user does to a world: commands, in the words of the road.

use std::fmt;

use laneweave_models::Parameter;
use laneweave_network::{Id, LightState};
use serde::{Deserialize, Serialize};

use crate::state::control::Control;
use crate::state::lane::VehicleId;
use crate::state::vehicle::Class;

/// Something that a user does to a world.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Command {
    /// Puts a vehicle on the road, at once.
    Insert(NewVehicle),
    /// Takes a vehicle off the road. Its trip does not count as completed.
    Remove(VehicleId),
    /// Drives a vehicle, or leaves it to its driver.
    Control(VehicleId, Control),
    /// Gives the driver of a vehicle another style, by its name.
    SetStyle(VehicleId, String),
    /// Gives a driver another destination, by its smallest lanelet id. `None`: it follows the road.
    SetDestination(VehicleId, Option<Id>),
    /// Sets the demand at an origin from now on.
    SetDemand {
        /// The smallest lanelet id of the origin.
        origin: Id,
        /// Vehicles that arrive per hour.
        vehicles_per_hour: f64,
    },
    /// Sets the weight of a style among those of the drivers who arrive from now on.
    SetShare {
        /// The name of the style.
        style: String,
        /// Its weight; the shares of the styles are in proportion to their weights.
        weight: f64,
    },
    /// Makes a light show a state, whatever its program says. `None`: it follows its program again.
    SetLight {
        /// The id of the light.
        light: Id,
        /// What it shows.
        shows: Option<LightState>,
    },
    /// Gives the signal plan of a light another offset. The phases of the plan take longer until it is there.
    SetOffset {
        /// The id of a light of the plan.
        light: Id,
        /// When the first phase of the plan begins, and of every further cycle [s].
        offset_s: f64,
    },
    /// Closes a lanelet to all vehicles, or opens it again. Those on it drive off it.
    CloseLanelet {
        /// The id of the lanelet.
        lanelet: Id,
        /// Whether it is closed from now on.
        is_closed: bool,
    },
    /// Changes a number of a style, for all of its drivers on the road and for those who enter later.
    SetParameter {
        /// The name of the style.
        style: String,
        /// The number.
        parameter: Parameter,
        /// Its new value.
        value: f64,
    },
}

/// A vehicle that a user puts on the road.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NewVehicle {
    /// The id of the lanelet on which its front bumper is.
    pub lanelet: Id,
    /// Position of its front bumper along the lanelet [m].
    pub position_m: f64,
    /// Speed [m/s].
    pub speed_mps: f64,
    /// Class.
    pub class: Class,
    /// The name of its driver's style: one of the styles of the scenario.
    pub style: String,
    /// The smallest lanelet id of its destination. `None`: it follows the road.
    pub destination: Option<Id>,
}

/// A command that was carried out.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Commanded {
    /// The step before whose decisions it was carried out.
    pub step: u32,
    /// The vehicle that it concerns, or that it put on the road.
    pub vehicle: Option<VehicleId>,
    /// The command.
    pub command: Command,
}

/// What a command concerns. A target gets at most one command of a kind in a step. It displays as its kind and id.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Target {
    /// A lanelet, by its id.
    Lanelet(Id),
    /// An origin, by its smallest lanelet id.
    Origin(Id),
    /// A light, by its id.
    Light(Id),
    /// The signal plan of a light, by the light's id.
    Plan(Id),
    /// A parameter of a style, by the style's name.
    Parameter(String, Parameter),
    /// A style, by its name.
    Style(String),
    /// A vehicle.
    Vehicle(VehicleId),
}

impl fmt::Display for Target {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Target::Origin(id) => write!(f, "origin {id}"),
            Target::Lanelet(id) => write!(f, "lanelet {id}"),
            Target::Light(id) => write!(f, "light {id}"),
            Target::Plan(id) => write!(f, "the plan of light {id}"),
            Target::Parameter(style, parameter) => write!(f, "style {style} with its {}", parameter.key()),
            Target::Style(style) => write!(f, "style {style}"),
            Target::Vehicle(id) => write!(f, "vehicle {id}"),
        }
    }
}

impl Command {
    /// What it concerns; `None` for a new vehicle.
    pub fn target(&self) -> Option<Target> {
        Some(match self {
            Command::Insert(_) => return None,
            Command::Remove(id)
            | Command::Control(id, _)
            | Command::SetStyle(id, _)
            | Command::SetDestination(id, _) => Target::Vehicle(*id),
            Command::SetDemand { origin, .. } => Target::Origin(*origin),
            Command::SetShare { style, .. } => Target::Style(style.clone()),
            Command::SetLight { light, .. } => Target::Light(*light),
            Command::SetOffset { light, .. } => Target::Plan(*light),
            Command::CloseLanelet { lanelet, .. } => Target::Lanelet(*lanelet),
            Command::SetParameter { style, parameter, .. } => Target::Parameter(style.clone(), *parameter),
        })
    }

    /// The vehicle that it concerns, if it concerns one.
    pub fn vehicle(&self) -> Option<VehicleId> {
        match self.target() {
            Some(Target::Vehicle(id)) => Some(id),
            _ => None,
        }
    }

    /// The place of the vehicle that it concerns, if it concerns one.
    pub fn vehicle_mut(&mut self) -> Option<&mut VehicleId> {
        match self {
            Command::Remove(id)
            | Command::Control(id, _)
            | Command::SetStyle(id, _)
            | Command::SetDestination(id, _) => Some(id),
            Command::Insert(_)
            | Command::SetDemand { .. }
            | Command::SetShare { .. }
            | Command::SetLight { .. }
            | Command::SetOffset { .. }
            | Command::CloseLanelet { .. }
            | Command::SetParameter { .. } => None,
        }
    }

    /// The order in which the commands for one vehicle are carried out.
    pub(crate) fn rank(&self) -> u8 {
        match self {
            Command::Insert(_) => 0,
            Command::SetStyle(..) => 1,
            Command::SetDestination(..) => 2,
            Command::Control(..) => 3,
            Command::Remove(_) => 4,
            Command::SetDemand { .. }
            | Command::SetShare { .. }
            | Command::SetLight { .. }
            | Command::SetOffset { .. }
            | Command::CloseLanelet { .. }
            | Command::SetParameter { .. } => 5,
        }
    }
}
