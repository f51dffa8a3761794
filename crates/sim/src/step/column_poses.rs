//! The poses of all vehicles, as columns: one walk along each lane finds where they are, another one along each lane
//! beside it finds those who change lanes.

use laneweave_network::{ChainIndex, LineWalk, Network, Pose};

use crate::state::lane::{DriverState, Entry, Kinematics, LaneChangeState};
use crate::step::columns::{Rows, take};
use crate::step::world::World;
use crate::view::pose::{between, bumpers_between, places_between, pose};
use crate::view::scene::{Scene, Spot};

/// Whether a vehicle is in the middle of its lane with all of its length.
#[inline]
fn keeps_lane(motion: &Kinematics, driver: &DriverState, lane_change: &LaneChangeState) -> bool {
    lane_change.counterpart.is_none()
        && lane_change.progress == 0.0
        && motion.rear() >= 0.0
        && !driver.is_external
}

/// Walks along a lane in driving order, and along those to which its vehicles change.
struct Walks<'a> {
    network: &'a Network,
    along: LineWalk<'a>,
    /// Along the last two other lanes.
    beside: [Option<(ChainIndex, LineWalk<'a>)>; 2],
}

impl<'a> Walks<'a> {
    fn new(network: &'a Network, chain: ChainIndex) -> Walks<'a> {
        Walks { network, along: network.chain(chain).centre.walk(0.0), beside: [const { None }; 2] }
    }

    /// The pose of a body with its bumpers at these places along the lane [m].
    #[inline]
    fn pose(&mut self, [front, rear]: [f64; 2]) -> Pose {
        match self.along.straight([front, rear]) {
            Some((at, heading)) => Pose { at, heading },
            None => between([front, rear].map(|it| self.along.at(it))),
        }
    }

    /// The pose of the vehicle of an entry between two lanes, if all of it is on them.
    #[inline]
    fn between_lanes(&mut self, scene: &Scene, entry: &Entry) -> Option<Pose> {
        let counterpart = entry.lane_change.counterpart?;
        let [own, other] = places_between(entry, counterpart);
        if own[1] < 0.0 || other[1] < 0.0 {
            return None;
        }
        let [along, beside] = self.along(counterpart.chain, counterpart.x);
        let points = [own.map(|it| along.at(it)), other.map(|it| beside.at(it))];
        Some(between(bumpers_between(scene, entry, points)))
    }

    /// The walk along the lane, and one along another lane, which begins at `x` [m] if it is new.
    #[inline]
    fn along(&mut self, chain: ChainIndex, x: f64) -> [&mut LineWalk<'a>; 2] {
        let Walks { network, along, beside } = self;
        let is_there = |it: &Option<(ChainIndex, LineWalk)>| it.as_ref().is_some_and(|it| it.0 == chain);
        if !is_there(&beside[0]) {
            beside.swap(0, 1);
        }
        if !is_there(&beside[0]) {
            beside[0] = None;
        }
        let (_, other) = beside[0].get_or_insert_with(|| (chain, network.chain(chain).centre.walk(x)));
        [along, other]
    }
}

impl World {
    /// Fills the columns of the poses, in the order of [`World::vehicles`].
    pub(super) fn fill_poses(&self, rows: &mut Rows) {
        let (network, scene, externals) = (self.roads.network(), self.scene(), self.traffic.externals());
        for (lane, number) in self.traffic.lanes().iter().zip(0..) {
            let chain = ChainIndex(number);
            let mut walks = Walks::new(network, chain);
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
                    walks.pose([motion.x, motion.rear()])
                } else if driver.is_external
                    && let Some(body) = externals.body(motion.id)
                {
                    body.pose
                } else {
                    let on_lanes = walks.between_lanes(&scene, &lane.entry(index));
                    on_lanes.unwrap_or_else(|| pose(&scene, Spot { chain, index }))
                };
                fill(place, &there);
            }
        }
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
