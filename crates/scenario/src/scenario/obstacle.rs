//! Obstacles in a scenario.

use super::WrittenId;
use laneweave_network::Id;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Something that is no vehicle and stands on the road for some time, such as a lost load, a skip or a parked car.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Obstacle {
    /// The id of the lanelet on which its far end is.
    #[schemars(with = "WrittenId")]
    pub lanelet: Id,
    /// Position of its far end along the lanelet [m].
    pub position_m: f64,
    /// Its length along the lane [m].
    #[serde(default = "length_of_a_car")]
    pub length_m: f64,
    /// Its width, in the middle of the lane [m].
    #[serde(default = "width_of_a_car")]
    pub width_m: f64,
    /// Time from which on it stands there, as soon as its place is free [s], counted from the start of the simulation
    /// (with the warm-up).
    #[serde(default)]
    pub from_s: f64,
    /// Time at which it is taken away [s]; default: it stays.
    pub until_s: Option<f64>,
}

fn length_of_a_car() -> f64 {
    4.5
}

fn width_of_a_car() -> f64 {
    1.8
}
