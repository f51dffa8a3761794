//! How a user drives a vehicle, in place of its driver.

use laneweave_network::Side;
use serde::{Deserialize, Serialize};

/// How a user drives a vehicle. It stays in force until the user gives another control.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Control {
    /// The vehicle drives in lanes. Each of the two parts may be left to its own driver.
    Drive {
        /// How fast it drives.
        longitudinal: Longitudinal,
        /// Whether it changes lanes.
        lateral: Lateral,
    },
}

/// How fast a vehicle drives.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Longitudinal {
    /// As its own driver does.
    Driver,
    /// With this acceleration [m/s²], whatever is ahead, but never backwards.
    Acceleration(f64),
    /// At this speed [m/s], whatever is ahead. The vehicle reaches it as soon as it can: with the maximum acceleration
    /// of its class, or braking at 8 m/s².
    Speed(f64),
}

/// Whether a vehicle changes lanes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Lateral {
    /// As its own driver does.
    Driver,
    /// It keeps its lane. It gives up a desired change, and aborts a change before the centre crosses the line.
    Keep,
    /// It changes once to this side, as soon as its driver accepts the gap there. It signals until then: other drivers
    /// may let it in. After the change it keeps its lane.
    Change(Side),
}

impl Control {
    /// All is left to the driver of the vehicle.
    pub const DRIVER: Control =
        Control::Drive { longitudinal: Longitudinal::Driver, lateral: Lateral::Driver };
    /// The hardest acceleration and braking that a user may ask for [m/s²]. Followers rely on it: they stay clear of a
    /// vehicle that brakes as hard as vehicles can.
    pub const HARDEST: f64 = laneweave_models::braking::HARDEST_BRAKING;
    /// The highest speed that a user may ask for [m/s]: 300 km/h.
    pub const FASTEST: f64 = 300.0 / 3.6;

    /// Whether a user drives the vehicle in any way.
    pub fn is_external(self) -> bool {
        self != Control::DRIVER
    }
}
