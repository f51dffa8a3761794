//! How a driver takes what it is told of travel times: bounded rationality. The paper has it in words; the forms are
//! ours.

use serde::{Deserialize, Serialize};

/// How a driver takes the travel times of its way and of others.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Guidance {
    /// σ of the lognormal error in what it believes of a travel time, drawn anew whenever times are; 0: it knows them.
    pub route_error: f64,
    /// It leaves its route only for a gain above this [s].
    pub indifference: f64,
    /// Share of drivers who keep their route whatever they hear.
    pub habit: f64,
    /// Chance that it minds new times when they come.
    pub compliance: f64,
    /// What it adds to the time of a way for each turn on it [s].
    pub turn_s: f64,
    /// The same for each traffic light [s].
    pub light_s: f64,
}

impl Default for Guidance {
    /// A driver who knows the times, and goes by them if half a minute is to be gained; turns and lights count as much
    /// as they take. Ours.
    fn default() -> Guidance {
        Guidance {
            route_error: 0.0,
            indifference: 30.0,
            habit: 0.0,
            compliance: 1.0,
            turn_s: 0.0,
            light_s: 0.0,
        }
    }
}

impl Guidance {
    /// What a driver believes of a travel time, as a multiple of it: lognormal with median 1, at the standard normal
    /// `deviate`.
    pub fn belief(&self, deviate: f64) -> f64 {
        libm::exp(self.route_error * deviate)
    }

    /// Turns and lights count for nothing beside the time that they take.
    #[inline]
    pub fn minds_time_only(&self) -> bool {
        self.turn_s == 0.0 && self.light_s == 0.0
    }

    /// What it adds to the time of a way with so many turns and lights [s].
    #[inline]
    pub fn added(&self, turns: u16, lights: u16) -> f64 {
        self.turn_s * f64::from(turns) + self.light_s * f64::from(lights)
    }
}
