//! External vehicles in a scenario.

use super::WrittenId;
use laneweave_network::Id;
use laneweave_sim::{Class, Control, Lateral, Longitudinal, NewVehicle};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// An external vehicle: the scenario puts it on the road, and a program may drive it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct External {
    /// The name under which a program asks for its id.
    pub name: Option<String>,
    /// Time from which on it is put on the road, as soon as its place is free [s], counted from the start of the
    /// simulation (with the warm-up).
    #[serde(default)]
    pub time_s: f64,
    /// The id of the lanelet on which its front bumper is.
    #[schemars(with = "WrittenId")]
    pub lanelet: Id,
    /// Position of its front bumper along the lanelet [m].
    pub position_m: f64,
    /// Its speed [m/s].
    pub speed_mps: f64,
    /// Its class.
    #[serde(default = "car")]
    #[schemars(with = "String", extend("enum" = ["car", "truck", "bus", "motorcycle", "taxi", "emergency"]))]
    pub class: Class,
    /// The style of its driver: the name of one of the styles of the scenario.
    pub style: String,
    /// The smallest lanelet id of its destination; default: it follows the road.
    #[schemars(with = "Option<WrittenId>")]
    pub destination: Option<Id>,
    /// The speed at which it drives, whatever is ahead [m/s]; default: as its own driver does.
    pub held_speed_mps: Option<f64>,
    /// Whether it keeps its lane; otherwise its own driver changes lanes.
    #[serde(default)]
    pub keeps_lane: bool,
}

fn car() -> Class {
    Class::Car
}

impl External {
    /// The vehicle as a command puts it on the road.
    pub(crate) fn vehicle(&self) -> NewVehicle {
        let External { lanelet, position_m, speed_mps, class, ref style, destination, .. } = *self;
        NewVehicle { lanelet, position_m, speed_mps, class, style: style.clone(), destination }
    }

    /// How it drives from then on.
    pub(crate) fn control(&self) -> Control {
        Control::Drive {
            longitudinal: self.held_speed_mps.map_or(Longitudinal::Driver, Longitudinal::Speed),
            lateral: if self.keeps_lane { Lateral::Keep } else { Lateral::Driver },
        }
    }
}
