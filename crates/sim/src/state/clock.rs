//! Simulated time in whole steps.

use serde::{Deserialize, Serialize};

/// The current step.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Clock {
    /// Number of the step.
    pub step: u32,
    /// Length of a step [s].
    pub dt: f64,
}

impl Clock {
    /// Time since the start [s].
    pub fn time(&self) -> f64 {
        f64::from(self.step) * self.dt
    }

    /// Time since step `step` [s].
    #[inline]
    pub(crate) fn since(&self, step: u32) -> f64 {
        f64::from(self.step - step) * self.dt
    }

    /// Time until step `step` [s]; 0 if it is over.
    #[inline]
    pub(crate) fn until(&self, step: u32) -> f64 {
        f64::from(step.saturating_sub(self.step)) * self.dt
    }

    /// Whether a step begins at a whole second: work that is done once a second is done now.
    pub fn begins_a_second(&self) -> bool {
        self.step.is_multiple_of(self.steps(1.0))
    }

    /// A duration [s] as a whole number of steps, at least one.
    #[inline]
    pub fn steps(&self, duration: f64) -> u32 {
        ((duration / self.dt + 0.5) as u32).max(1)
    }
}
