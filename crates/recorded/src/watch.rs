//! Simulated traffic as an exact recording.

use std::collections::BTreeMap;

use laneweave_recordings::{Recording, RoadUser, State, Track};
use laneweave_sim::{Class, VehicleId, World};

/// Notes the vehicles of a simulation at every step. A step is a frame.
#[derive(Clone, Debug)]
pub struct Watch {
    step: f64,
    /// The step of the simulation that is frame 0.
    first: u32,
    tracks: BTreeMap<VehicleId, Track>,
}

impl Watch {
    /// A watch whose frame 0 is the present step of `world`. It has seen nothing yet.
    pub fn from_now(world: &World) -> Watch {
        let clock = world.clock();
        Watch { step: clock.dt, first: clock.step, tracks: BTreeMap::new() }
    }

    /// Notes all vehicles on the road.
    pub fn see(&mut self, world: &World) {
        let frame = i64::from(world.clock().step) - i64::from(self.first);
        for vehicle in world.vehicles() {
            let track = self.tracks.entry(vehicle.id()).or_insert_with(|| {
                let class = vehicle.driver.class;
                let [length, width] = vehicle.size();
                Track {
                    id: i64::from(vehicle.id()),
                    class: road_user(class),
                    length,
                    width,
                    states: Vec::new(),
                }
            });
            let pose = vehicle.pose();
            let (x, y, heading) = (pose.at.x, pose.at.y, pose.heading);
            track.states.push(State { frame, x, y, speed: vehicle.speed(), heading });
        }
    }

    /// What it has seen, by vehicle.
    pub fn into_recording(self) -> Recording {
        let tracks = self.tracks.into_values().collect();
        Recording { step: self.step, tracks, ..Recording::default() }
    }
}

fn road_user(class: Class) -> RoadUser {
    if class.is_long() { RoadUser::Truck } else { RoadUser::Car }
}
