//! A vehicle of a world.

use laneweave_models::Style;
use laneweave_network::{Point, Pose};

use crate::state::lane::{DriverState, Kinematics, LaneChangeState, VehicleId};
use crate::step::world::World;
use crate::view::pose::{bumpers, lateral_offset, pose};
use crate::view::scene::Spot;

/// A vehicle on the road.
#[derive(Clone, Copy)]
pub struct Vehicle<'a> {
    pub(super) world: &'a World,
    /// Where its main entry stands.
    pub spot: Spot,
    /// How it moves.
    pub motion: &'a Kinematics,
    /// Its driver's hot part.
    pub driver: &'a DriverState,
    /// Its driver's warm part.
    pub lane_change: &'a LaneChangeState,
}

impl Vehicle<'_> {
    /// Who it is.
    pub fn id(&self) -> VehicleId {
        self.motion.id
    }

    /// Front bumper along its chain [m].
    pub fn x(&self) -> f64 {
        self.motion.x
    }

    /// Speed [m/s].
    pub fn speed(&self) -> f64 {
        self.motion.speed
    }

    /// Where its body is.
    pub fn pose(&self) -> Pose {
        pose(&self.world.scene(), self.spot)
    }

    /// The middles of its front and its rear bumper.
    pub fn bumpers(&self) -> [Point; 2] {
        bumpers(&self.world.scene(), self.spot)
    }

    /// How far it is to the left of the centre of its lane [m].
    pub fn lateral_offset(&self) -> f64 {
        lateral_offset(&self.world.scene(), self.spot)
    }

    /// Its driver's style.
    pub fn style(&self) -> &Style {
        self.world.roads.style(self.driver.parameters)
    }
}
