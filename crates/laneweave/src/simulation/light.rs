//! Traffic lights.

use laneweave_network::{Id, LightIndex, LightState};
use serde::{Deserialize, Serialize};

use super::Simulation;

/// A traffic light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Light {
    /// Its id: the smallest id of its regulatory elements.
    pub id: Id,
    /// What it shows.
    pub state: LightState,
}

impl Simulation {
    /// All traffic lights.
    pub fn lights(&self) -> Vec<Light> {
        let scene = self.world().scene();
        let lights = self.network().junctions.lights.iter().zip(0..);
        lights.map(|(it, index)| Light { id: it.id, state: scene.light(LightIndex(index)) }).collect()
    }
}
