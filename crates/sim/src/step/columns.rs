//! All vehicles as columns: a struct of arrays in buffers of the caller.

use crate::state::lane::VehicleId;
use crate::step::world::World;

/// All vehicles of one instant as columns, with a row for each vehicle. The buffers are reused from call to call.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Columns {
    /// Ids.
    pub id: Vec<VehicleId>,
    /// Ids of the lanelets on which the front bumpers are.
    pub lanelet: Vec<i64>,
    /// Positions of the front bumpers along the lanelets [m].
    pub position_m: Vec<f64>,
    /// Speeds [m/s].
    pub speed_mps: Vec<f64>,
    /// Accelerations of the last step [m/s²].
    pub acceleration_mps2: Vec<f64>,
    /// Positions of the centres on the map, to the east [m]. Only with poses, otherwise empty.
    pub x_m: Vec<f64>,
    /// Positions of the centres on the map, to the north [m]. Only with poses, otherwise empty.
    pub y_m: Vec<f64>,
    /// Headings, counter-clockwise from east [rad]. Only with poses, otherwise empty.
    pub heading_rad: Vec<f64>,
    has_poses: bool,
}

impl Columns {
    /// Empty columns, with those of the poses. A pose is a computation, the other columns are copies.
    pub fn with_poses() -> Columns {
        Columns { has_poses: true, ..Columns::default() }
    }

    /// Number of vehicles.
    pub fn len(&self) -> usize {
        self.id.len()
    }

    /// Whether there is no vehicle.
    pub fn is_empty(&self) -> bool {
        self.id.is_empty()
    }

    fn resize(&mut self, count: usize) {
        let Columns { id, lanelet, position_m, speed_mps, acceleration_mps2, .. } = self;
        id.resize(count, 0);
        lanelet.resize(count, 0);
        [position_m, speed_mps, acceleration_mps2].into_iter().for_each(|it| it.resize(count, 0.0));
    }
}

impl World {
    /// Fills `columns` with all vehicles, in the order of [`World::vehicles`].
    pub fn columns(&self, columns: &mut Columns) {
        columns.resize(self.traffic.crowd());
        let Columns { id, lanelet, position_m, speed_mps, acceleration_mps2, .. } = &mut *columns;
        let places = id.iter_mut().zip(lanelet).zip(position_m);
        let mut rows = places.zip(speed_mps).zip(acceleration_mps2);
        let network = self.roads.network();
        for (lane, chain) in self.traffic.lanes().iter().zip(&network.chains) {
            if lane.motions().is_empty() {
                continue;
            }
            let name = |number: usize| network.lanelets[chain.lanelets[number].at()].id;
            let (mut number, mut on, mut start) = (0, name(0), chain.starts[0]);
            let mut next = chain.starts.get(1).copied().unwrap_or(f64::INFINITY);
            for (motion, driver) in lane.motions().iter().zip(lane.drivers()) {
                if driver.is_shadow {
                    continue;
                }
                // Vehicles come in driving order, and so do lanelets.
                while next <= motion.x {
                    number += 1;
                    (on, start) = (name(number), chain.starts[number]);
                    next = chain.starts.get(number + 1).copied().unwrap_or(f64::INFINITY);
                }
                let Some(((((id, lanelet), position), speed), acceleration)) = rows.next() else { break };
                *id = motion.id;
                *lanelet = on;
                *position = motion.x - start;
                *speed = motion.speed;
                *acceleration = f64::from(motion.acceleration);
            }
        }
        self.poses(columns);
    }

    /// Fills the columns of the poses, if they are wanted.
    fn poses(&self, columns: &mut Columns) {
        let Columns { x_m, y_m, heading_rad, has_poses, .. } = columns;
        if !*has_poses {
            return;
        }
        [&mut *x_m, &mut *y_m, &mut *heading_rad].into_iter().for_each(Vec::clear);
        for pose in self.vehicles().map(|it| it.pose()) {
            x_m.push(pose.at.x);
            y_m.push(pose.at.y);
            heading_rad.push(pose.heading);
        }
    }
}
