//! How a driver uses the travel times that it gets: bounded rationality. The paper has it in words; the forms are
//! ours.

use serde::{Deserialize, Serialize};

/// How a driver uses the travel times of its route and of others.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Guidance {
    /// σ of the lognormal error in its belief of a travel time, with a new random number whenever there are new
    /// times; 0: it knows them.
    pub route_error: f64,
    /// It leaves its route only for a gain above this [s].
    pub indifference: f64,
    /// Share of drivers who always keep their route.
    pub habit: f64,
    /// Chance that it uses new times when they come.
    pub compliance: f64,
    /// What it adds to the time of a route for each turn on it [s].
    pub turn_s: f64,
    /// The same for each traffic light [s].
    pub light_s: f64,
}

impl Default for Guidance {
    /// A driver who knows the times, and follows them if it gains half a minute; turns and lights count as much as
    /// they take. Ours.
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

    /// Turns and lights add nothing to the time that they take.
    #[inline]
    pub fn minds_time_only(&self) -> bool {
        self.turn_s == 0.0 && self.light_s == 0.0
    }

    /// What it adds to the time of a route with so many turns and lights [s].
    #[inline]
    pub fn added(&self, turns: u16, lights: u16) -> f64 {
        self.turn_s * f64::from(turns) + self.light_s * f64::from(lights)
    }
}
