//! A stage of a program: which lights are green together, and how much of the time they need.

use crate::junction::LightIndex;

/// A stage of a program.
#[derive(Clone)]
pub(super) struct Stage {
    /// Its lights.
    pub(super) lights: Vec<LightIndex>,
    /// That of its critical lane.
    pub(super) flow_ratio: f64,
    /// All-red time after it [s].
    pub(super) all_red: f64,
}
