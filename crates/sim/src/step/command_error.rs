//! Why a command is refused.

use laneweave_models::Parameter;
use laneweave_network::Id;
use thiserror::Error;

use crate::state::lane::VehicleId;

/// Why a command is refused.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum CommandError {
    /// There is no such vehicle on the road.
    #[error(
        "vehicle {0} is not on the road: it has left, was removed, or has not entered yet; ask which vehicles there are"
    )]
    NoVehicle(VehicleId),
    /// There is already a command of this kind for the same thing in this step.
    #[error("{0} already has a command of this kind in this step; simulate a step before the next one")]
    Twice(String),
    /// A vehicle off the road cannot drive in lanes.
    #[error("vehicle {0} is in no lane; give it a pose in a lane first, along the lane, and simulate a step")]
    Astray(VehicleId),
    /// The vehicle is to be removed in this step.
    #[error("vehicle {0} is removed before the next step, and takes no other command with it")]
    Removed(VehicleId),
    /// A number is not in its range.
    #[error("{what} of {value}: choose {from} to {to} {unit}")]
    Number {
        /// What it is.
        what: &'static str,
        /// Its value.
        value: f64,
        /// The least value allowed.
        from: f64,
        /// The greatest value allowed.
        to: f64,
        /// Its unit.
        unit: &'static str,
    },
    /// There is no such thing.
    #[error("there is no {what} {name}; {remedy}")]
    Unknown {
        /// What it is.
        what: &'static str,
        /// The name under which it was looked for.
        name: String,
        /// What to do.
        remedy: String,
    },
    /// Its place is not free, or a vehicle cannot be there.
    #[error("nothing can be put at {position_m:.1} m of lanelet {lanelet}: {why}")]
    Place {
        /// The lanelet.
        lanelet: Id,
        /// The position along it [m].
        position_m: f64,
        /// Why not, and what to do.
        why: String,
    },
    /// The headways of the scenario are impossible at this demand.
    #[error("{0}; choose a lower demand")]
    Headways(String),
    /// No style would be left for the drivers who arrive.
    #[error("no style would have a weight, so nobody could arrive; give another style a weight first")]
    NoStyle,
    /// The plan of a light has no offset.
    #[error("light {light} has no offset: {why}; choose a light with a fixed plan")]
    Offset {
        /// The light.
        light: Id,
        /// Why not.
        why: &'static str,
    },
    /// A lanelet cannot be closed.
    #[error("lanelet {lanelet} cannot be closed: {why}")]
    Closing {
        /// The lanelet.
        lanelet: Id,
        /// Why not, and what to do.
        why: &'static str,
    },
    /// A style cannot have this value of a number.
    #[error("{} of style {style} cannot be {value}: {why}", .parameter.key())]
    Parameter {
        /// The style.
        style: String,
        /// The number.
        parameter: Parameter,
        /// The value.
        value: f64,
        /// Why not, and what to do.
        why: String,
    },
    /// The driver cannot have this destination now.
    #[error("vehicle {vehicle} cannot drive to {destination}: {why}")]
    Destination {
        /// The vehicle.
        vehicle: VehicleId,
        /// The destination.
        destination: Id,
        /// Why not, and what to do.
        why: &'static str,
    },
}

pub(super) fn in_range(
    what: &'static str,
    value: f64,
    [from, to]: [f64; 2],
    unit: &'static str,
) -> Result<(), CommandError> {
    if (from..=to).contains(&value) {
        return Ok(());
    }
    Err(CommandError::Number { what, value, from, to, unit })
}
