//! The poses of all vehicles, as columns. Most vehicles keep their lane: one walk along each lane finds where they are.

use laneweave_network::{ChainIndex, LineWalk, Pose};

use crate::state::lane::{DriverState, Kinematics, LaneChangeState};
use crate::step::columns::{Rows, take};
use crate::step::world::World;
use crate::view::pose::{between, pose};
use crate::view::scene::Spot;

/// Whether a vehicle is in the middle of its lane with all of its length.
#[inline]
fn keeps_lane(motion: &Kinematics, driver: &DriverState, lane_change: &LaneChangeState) -> bool {
    lane_change.counterpart.is_none()
        && lane_change.progress == 0.0
        && motion.rear() >= 0.0
        && !driver.is_external
}

/// A walk along a lane in driving order.
struct Bumpers<'a> {
    front: LineWalk<'a>,
    rear: LineWalk<'a>,
}

impl Bumpers<'_> {
    /// The pose of a body with its bumpers at these places along the lane [m].
    #[inline]
    fn pose(&mut self, [front, rear]: [f64; 2]) -> Pose {
        match self.front.straight([front, rear]) {
            Some((at, heading)) => Pose { at, heading },
            None => between([self.front.at(front), self.rear.at(rear)]),
        }
    }
}

impl World {
    /// Fills the columns of the poses, in the order of [`World::vehicles`].
    pub(super) fn fill_poses(&self, rows: &mut Rows) {
        let (network, scene) = (self.roads.network(), self.scene());
        for (lane, number) in self.traffic.lanes().iter().zip(0..) {
            let chain = ChainIndex(number);
            let walk = network.chain(chain).centre.walk();
            let mut bumpers = Bumpers { front: walk.clone(), rear: walk };
            let entries = lane.motions().iter().zip(lane.drivers()).zip(lane.lane_change_states());
            for (index, ((motion, driver), lane_change)) in entries.enumerate() {
                if driver.is_shadow {
                    continue;
                }
                let there = if keeps_lane(motion, driver, lane_change) {
                    bumpers.pose([motion.x, motion.rear()])
                } else {
                    let body = self.traffic.externals().body(motion.id).filter(|_| driver.is_external);
                    body.map_or_else(|| pose(&scene, Spot { chain, index }), |it| it.pose)
                };
                rows.fill_pose(there);
            }
        }
        let off_road = self.traffic.externals().all().iter().filter(|it| it.off_road().is_some());
        let bodies = off_road.filter_map(|it| self.traffic.externals().body(it.id));
        bodies.for_each(|it| rows.fill_pose(it.pose));
    }
}

impl Rows<'_> {
    #[inline]
    fn fill_pose(&mut self, Pose { at, heading }: Pose) {
        let columns = [&mut self.x_m, &mut self.y_m, &mut self.z_m, &mut self.heading_rad];
        for (column, value) in columns.into_iter().zip([at.x, at.y, at.z, heading]) {
            if let [place] = take(column, 1) {
                *place = value;
            }
        }
    }
}
