//! The state of a vehicle, as plain data.

use laneweave_network::{Id, Position};
use laneweave_sim::{Class, Phase, Vehicle, VehicleId, World};
use serde::{Deserialize, Serialize};

/// The state of a vehicle at one instant. Its fields have the names of the columns of the table `trajectories`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct VehicleState {
    /// Its id. No other vehicle of the simulation ever has it.
    pub id: VehicleId,
    /// Its class.
    pub class: Class,
    /// The style of its driver.
    pub style: String,
    /// The id of the lanelet on which its front bumper is.
    pub lanelet: Id,
    /// Position of its front bumper along the lanelet [m].
    pub position_m: f64,
    /// Distance of its centre to the left of the centre of the lane [m].
    pub offset_m: f64,
    /// Position of its centre on the map, to the east [m].
    pub x_m: f64,
    /// Position of its centre on the map, to the north [m].
    pub y_m: f64,
    /// Height of its centre on the map [m].
    pub z_m: f64,
    /// Its heading, counter-clockwise from east [rad].
    pub heading_rad: f64,
    /// Speed [m/s].
    pub speed_mps: f64,
    /// Acceleration of the last step [m/s²].
    pub acceleration_mps2: f64,
    /// Length [m].
    pub length_m: f64,
    /// Width [m].
    pub width_m: f64,
    /// The phase of its lane change.
    pub state: Phase,
    /// The id of its destination: the smallest id of its lanelets. `None`: it follows the road.
    pub destination: Option<Id>,
    /// Whether a user drives it.
    pub is_external: bool,
}

impl VehicleState {
    pub(super) fn of(world: &World, vehicle: &Vehicle) -> VehicleState {
        let (motion, driver) = (vehicle.motion, vehicle.driver);
        let (lanelet, position_m) = world.network().lanelet_at(Position::new(vehicle.spot.chain, motion.x));
        let (pose, [length_m, width_m]) = (vehicle.pose(), vehicle.size());
        VehicleState {
            id: motion.id,
            class: driver.class,
            style: vehicle.style().name.clone(),
            lanelet: lanelet.id,
            position_m,
            offset_m: vehicle.offset(),
            x_m: pose.at.x,
            y_m: pose.at.y,
            z_m: pose.at.z,
            heading_rad: pose.heading,
            speed_mps: vehicle.speed(),
            acceleration_mps2: f64::from(motion.acceleration),
            length_m,
            width_m,
            state: driver.phase,
            destination: vehicle.destination(),
            is_external: driver.is_external,
        }
    }
}
