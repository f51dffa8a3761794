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
    /// Position of its main entry.
    pub spot: Spot,
    /// Its kinematics.
    pub motion: &'a Kinematics,
    /// The state of its driver, needed at every step.
    pub driver: &'a DriverState,
    /// Its lane-change state, needed less often.
    pub lane_change: &'a LaneChangeState,
}

impl Vehicle<'_> {
    /// Its id.
    pub fn id(&self) -> VehicleId {
        self.motion.id
    }

    /// Position of the front bumper along its chain [m].
    pub fn x(&self) -> f64 {
        self.motion.x
    }

    /// Speed [m/s].
    pub fn speed(&self) -> f64 {
        self.motion.speed
    }

    /// The pose of its body.
    pub fn pose(&self) -> Pose {
        pose(&self.world.scene(), self.spot)
    }

    /// The midpoints of its front and rear bumpers.
    pub fn bumpers(&self) -> [Point; 2] {
        bumpers(&self.world.scene(), self.spot)
    }

    /// Lateral offset to the left of the centre of its lane [m].
    pub fn lateral_offset(&self) -> f64 {
        lateral_offset(&self.world.scene(), self.spot)
    }

    /// Its driver's style.
    pub fn style(&self) -> &Style {
        self.world.roads.style(self.driver.parameters)
    }
}
