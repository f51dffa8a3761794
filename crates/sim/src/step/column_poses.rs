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
            let (motions, drivers, states) = (lane.motions(), lane.drivers(), lane.lane_change_states());
            let count = drivers.iter().filter(|it| !it.is_shadow).count();
            let mut places = rows.poses(count);
            // A loop over indices: adapters of the three lists together are not inlined.
            for index in 0..drivers.len() {
                let (motion, driver, lane_change) = (&motions[index], &drivers[index], &states[index]);
                if driver.is_shadow {
                    continue;
                }
                let Some(place) = places.next() else { break };
                let there = if keeps_lane(motion, driver, lane_change) {
                    bumpers.pose([motion.x, motion.rear()])
                } else {
                    let body = self.traffic.externals().body(motion.id).filter(|_| driver.is_external);
                    body.map_or_else(|| pose(&scene, Spot { chain, index }), |it| it.pose)
                };
                fill(place, &there);
            }
        }
        let externals = self.traffic.externals();
        let off_road = externals.all().iter().filter(|it| it.off_road().is_some());
        let bodies = off_road.filter_map(|it| externals.body(it.id));
        bodies.for_each(|it| rows.poses(1).for_each(|place| fill(place, &it.pose)));
    }
}

/// The places of a pose in the columns: to the east, to the north, its height and its heading.
type Places<'a> = [&'a mut f64; 4];

#[inline]
fn fill([x, y, z, heading]: Places, pose: &Pose) {
    (*x, *y, *z, *heading) = (pose.at.x, pose.at.y, pose.at.z, pose.heading);
}

impl<'a> Rows<'a> {
    /// The places of the next `count` poses.
    #[inline]
    fn poses(&mut self, count: usize) -> impl Iterator<Item = Places<'a>> + use<'a> {
        let across = take(&mut self.x_m, count).iter_mut().zip(take(&mut self.y_m, count));
        let others = take(&mut self.z_m, count).iter_mut().zip(take(&mut self.heading_rad, count));
        across.zip(others).map(|((x, y), (z, heading))| [x, y, z, heading])
    }
}
