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
    /// The centre of the vehicle is at this place at the end of the next step, wherever that is: in a lane, between
    /// two lanes, or off the road. It stays there until the user gives another pose.
    Pose {
        /// East, in the frame of the map [m].
        x: f64,
        /// North, in the frame of the map [m].
        y: f64,
        /// Heading, counter-clockwise from east [rad].
        heading: f64,
        /// Speed along the heading that other drivers see [m/s]. They see no more than the vehicle really moves.
        speed: f64,
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
    /// As its own driver does, but no faster than this [m/s]. Above it, the vehicle brakes gently: at 2 m/s².
    AtMost(f64),
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
    /// A vehicle that is too fast for its user brakes so hard [m/s²] (ours).
    pub(crate) const GENTLE: f64 = 2.0;
    /// The highest speed that a user may ask for [m/s]: 300 km/h.
    pub const FASTEST: f64 = 300.0 / 3.6;
    /// No coordinate of a pose is further from 0 than this [m], and no heading [rad].
    pub const FARTHEST: f64 = 1e7;

    /// Whether its numbers are in their ranges.
    pub(crate) fn is_sound(self) -> bool {
        match self {
            Control::Drive { longitudinal, .. } => match longitudinal {
                Longitudinal::Driver => true,
                Longitudinal::Acceleration(it) => it.abs() <= Control::HARDEST,
                Longitudinal::Speed(it) | Longitudinal::AtMost(it) => (0.0..=Control::FASTEST).contains(&it),
            },
            Control::Pose { x, y, heading, speed } => {
                [x, y, heading].iter().all(|it| it.abs() <= Control::FARTHEST)
                    && (0.0..=Control::FASTEST).contains(&speed)
            }
        }
    }

    /// Whether the vehicle is held at a speed of 0, whatever is ahead of it.
    pub fn holds_still(self) -> bool {
        matches!(self, Control::Drive { longitudinal: Longitudinal::Speed(0.0), .. })
    }

    /// Whether a user drives the vehicle in any way.
    pub fn is_external(self) -> bool {
        self != Control::DRIVER
    }
}
