//! A vehicle of a world.

use laneweave_models::Style;
use laneweave_network::{Id, Point, Pose};

use crate::state::externals::Body;
use crate::state::lane::{DriverState, Kinematics, LaneChangeState, VehicleId};
use crate::step::world::World;
use crate::view::pose::{bumpers, lateral_offset, pose};
use crate::view::scene::Spot;

/// A vehicle on the road.
#[derive(Clone, Copy)]
pub struct Vehicle<'a> {
    pub(super) world: &'a World,
    /// Position of its main entry; in no lane, the chain of the last one, and [`Vehicle::NO_ENTRY`].
    pub spot: Spot,
    /// Its kinematics.
    pub motion: &'a Kinematics,
    /// The state of its driver, needed at every step.
    pub driver: &'a DriverState,
    /// Its lane-change state, needed less often.
    pub lane_change: &'a LaneChangeState,
}

impl Vehicle<'_> {
    /// The index of a main entry that is in no lane.
    pub const NO_ENTRY: usize = usize::MAX;

    /// Whether it is in a lane: not so if a user drives it off the road.
    pub fn is_in_lane(&self) -> bool {
        self.spot.index != Vehicle::NO_ENTRY
    }

    /// Whether a user drives it by poses, along no lane's centre line.
    pub fn is_on_its_own_path(&self) -> bool {
        self.body().is_some()
    }

    /// Its body, if a user drives it by poses.
    fn body(&self) -> Option<&Body> {
        self.driver.is_external.then(|| self.world.traffic.externals().body(self.motion.id)).flatten()
    }

    /// Its id.
    pub fn id(&self) -> VehicleId {
        self.motion.id
    }

    /// Position of the front bumper along its chain [m].
    pub fn x(&self) -> f64 {
        self.motion.x
    }

    /// Speed [m/s]. At an angle to its lane, `motion` has only the part along the lane.
    pub fn speed(&self) -> f64 {
        self.body().map_or(self.motion.speed, |it| it.speed)
    }

    /// Its length and its width [m]. At an angle to its lane, `motion` has the length along the lane.
    pub fn size(&self) -> [f64; 2] {
        match self.body() {
            Some(body) => [body.length, body.width],
            None => [f64::from(self.motion.length), self.driver.class.body().width],
        }
    }

    /// The pose of its body.
    pub fn pose(&self) -> Pose {
        self.body().map_or_else(|| pose(&self.world.scene(), self.spot), |it| it.pose)
    }

    /// The midpoints of its front and rear bumpers.
    pub fn bumpers(&self) -> [Point; 2] {
        match self.body() {
            Some(body) => body.rectangle().ends(),
            None => bumpers(&self.world.scene(), self.spot),
        }
    }

    /// Lateral offset to the left of the centre of its lane [m]. Off the road, of its last place there.
    pub fn lateral_offset(&self) -> f64 {
        match self.body() {
            Some(_) => {
                let centre = &self.world.network().chain(self.spot.chain).centre;
                let (foot, heading) = (centre.at(self.motion.x), centre.heading(self.motion.x));
                let [front, _] = self.bumpers();
                (front.y - foot.y) * heading.cos() - (front.x - foot.x) * heading.sin()
            }
            None => lateral_offset(&self.world.scene(), self.spot),
        }
    }

    /// Its driver's style.
    pub fn style(&self) -> &Style {
        self.world.roads.style(self.driver.parameters)
    }

    /// The number of its driver's style: styles are numbered as they first occur in the driver parameters.
    pub fn style_number(&self) -> u32 {
        self.world.roads.changed_parameters().styles()[self.driver.parameters as usize]
    }

    /// The smallest lanelet id of its destination. `None`: it follows the road.
    pub fn destination(&self) -> Option<Id> {
        let number = self.world.roads.navigator().number(self.driver.goal.destination())?;
        Some(self.world.demand().destinations.get(number)?.id())
    }

    /// Distance of its centre to the left of the centre of its lane [m]; exactly 0 where it keeps its lane.
    pub fn offset(&self) -> f64 {
        let is_in_one_lane = !(self.driver.phase.is_between_lanes() || self.is_on_its_own_path());
        if is_in_one_lane { 0.0 } else { self.lateral_offset() }
    }
}
