//! All vehicles as columns: a struct of arrays in buffers of the caller.

use std::iter::Zip;
use std::slice::Iter;

use laneweave_network::{Chain, Id, LaneletIndex};

use crate::state::lane::{Kinematics, Phase, VehicleId};
use crate::state::vehicle::Class;
use crate::step::world::World;

/// All vehicles of one instant as columns, with a row for each vehicle. The buffers are reused from call to call.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Columns {
    /// Ids.
    pub id: Vec<VehicleId>,
    /// Lanelets on which the front bumpers are, as indices of [`laneweave_network::Network::lanelets`].
    pub lanelet: Vec<u32>,
    /// Positions of the front bumpers along the lanelets [m].
    pub position_m: Vec<f64>,
    /// Speeds [m/s].
    pub speed_mps: Vec<f64>,
    /// Accelerations of the last step [m/s²].
    pub acceleration_mps2: Vec<f32>,
    /// Positions of the centres on the map, to the east [m]. Only with poses, otherwise empty.
    pub x_m: Vec<f64>,
    /// Positions of the centres on the map, to the north [m]. Only with poses, otherwise empty.
    pub y_m: Vec<f64>,
    /// Headings, counter-clockwise from east [rad]. Only with poses, otherwise empty.
    pub heading_rad: Vec<f64>,
    /// Heights of the centres on the map [m]. Only with poses, otherwise empty.
    pub z_m: Vec<f64>,
    /// Classes. Only with drivers, otherwise empty; as are all that follow.
    pub class: Vec<Class>,
    /// Styles of the drivers, as indices of the styles of the scenario.
    pub style: Vec<u32>,
    /// Destinations, by their smallest lanelet ids; `None` where the driver follows the road.
    pub destination: Vec<Option<Id>>,
    /// Lengths [m].
    pub length_m: Vec<f64>,
    /// Widths [m].
    pub width_m: Vec<f64>,
    /// Distances of the centres to the left of the centres of their lanes [m].
    pub offset_m: Vec<f64>,
    /// Phases of lane changes.
    pub state: Vec<Phase>,
    /// Whether users drive the vehicles.
    pub is_external: Vec<bool>,
    has_poses: bool,
    has_drivers: bool,
}

impl Columns {
    /// Empty columns, with those of the poses. A pose is a computation, the other columns are copies.
    pub fn with_poses() -> Columns {
        Columns { has_poses: true, ..Columns::default() }
    }

    /// Empty columns with all that a vehicle has: with poses, and with drivers.
    pub fn complete() -> Columns {
        Columns { has_poses: true, has_drivers: true, ..Columns::default() }
    }

    /// Number of vehicles.
    pub fn len(&self) -> usize {
        self.id.len()
    }

    /// Whether there is no vehicle.
    pub fn is_empty(&self) -> bool {
        self.id.is_empty()
    }

    /// As many rows as there are vehicles, to be filled.
    fn rows(&mut self, count: usize) -> Rows<'_> {
        let Columns { id, lanelet, position_m, speed_mps, acceleration_mps2, .. } = self;
        let Columns { x_m, y_m, z_m, heading_rad, has_poses, .. } = self;
        let poses = if *has_poses { count } else { 0 };
        id.resize(count, 0);
        lanelet.resize(count, 0);
        [&mut *position_m, speed_mps].into_iter().for_each(|it| it.resize(count, 0.0));
        acceleration_mps2.resize(count, 0.0);
        [&mut *x_m, y_m, z_m, heading_rad].into_iter().for_each(|it| it.resize(poses, 0.0));
        Rows { id, lanelet, position_m, speed_mps, acceleration_mps2, x_m, y_m, z_m, heading_rad }
    }
}

/// The rows that are not filled yet, in slices of the caller. They are as many in each column; in those of the poses,
/// they may be none.
#[derive(Debug, Default)]
pub struct Rows<'a> {
    /// As in [`Columns`]; so are all others.
    pub id: &'a mut [VehicleId],
    /// Lanelets, as indices.
    pub lanelet: &'a mut [u32],
    /// Positions along the lanelets [m].
    pub position_m: &'a mut [f64],
    /// Speeds [m/s].
    pub speed_mps: &'a mut [f64],
    /// Accelerations [m/s²].
    pub acceleration_mps2: &'a mut [f32],
    /// Positions of the centres, to the east [m].
    pub x_m: &'a mut [f64],
    /// Positions of the centres, to the north [m].
    pub y_m: &'a mut [f64],
    /// Heights of the centres [m].
    pub z_m: &'a mut [f64],
    /// Headings [rad].
    pub heading_rad: &'a mut [f64],
}

/// A walk along the lanelets of a chain.
struct Walk<'a> {
    /// The lanelet, and where it starts [m].
    lanelet: u32,
    start: f64,
    /// Where the next one starts [m], infinite after the last one, and which one it is.
    next: (f64, u32),
    rest: Zip<Iter<'a, f64>, Iter<'a, LaneletIndex>>,
}

impl Rows<'_> {
    /// Fills a row for each of these vehicles of a lane, which are the next ones on the walk along it.
    #[inline(always)]
    fn fill(&mut self, motions: &[Kinematics], walk: &mut Walk) {
        let count = motions.len();
        let (speeds, accelerations) =
            (take(&mut self.speed_mps, count), take(&mut self.acceleration_mps2, count));
        let rows = take(&mut self.id, count).iter_mut().zip(speeds).zip(accelerations);
        for (motion, ((id, speed), acceleration)) in motions.iter().zip(rows) {
            (*id, *speed, *acceleration) = (motion.id, motion.speed, motion.acceleration);
        }
        // Two loops: one would need more registers than there are.
        let rows = take(&mut self.lanelet, count).iter_mut().zip(take(&mut self.position_m, count));
        for (motion, (lanelet, position)) in motions.iter().zip(rows) {
            // Vehicles come in driving order, and so do lanelets.
            while walk.next.0 <= motion.x {
                walk.go_on();
            }
            (*lanelet, *position) = (walk.lanelet, motion.x - walk.start);
        }
    }
}

/// The first `count` rows of a column, which are no longer in `rest`.
#[inline(always)]
pub(super) fn take<'a, T>(rest: &mut &'a mut [T], count: usize) -> &'a mut [T] {
    let count = count.min(rest.len());
    let (taken, others) = std::mem::take(rest).split_at_mut(count);
    *rest = others;
    taken
}

impl Walk<'_> {
    /// A walk that begins where the first lanelet does.
    #[inline(always)]
    fn along(chain: &Chain) -> Walk<'_> {
        let rest = chain.starts.iter().zip(&chain.lanelets);
        let mut walk = Walk { lanelet: 0, start: 0.0, next: (0.0, 0), rest };
        walk.go_on();
        walk.go_on();
        walk
    }

    /// Goes on to the next lanelet.
    #[inline(always)]
    fn go_on(&mut self) {
        (self.start, self.lanelet) = self.next;
        self.next = self.rest.next().map_or((f64::INFINITY, 0), |(start, lanelet)| (*start, lanelet.0));
    }
}

impl World {
    /// Fills `columns` with all vehicles, in the order of [`World::vehicles`].
    pub fn columns(&self, columns: &mut Columns) {
        let count = self.traffic.crowd() + self.traffic.externals().off_road();
        self.fill(&mut columns.rows(count));
        self.drivers(columns);
    }

    /// Fills as many of the next `rows` as there are vehicles, in the order of [`World::vehicles`]. If there are fewer
    /// rows, the last vehicles are left out.
    pub fn fill(&self, rows: &mut Rows) {
        if !rows.x_m.is_empty() {
            self.fill_poses(rows);
        }
        for (lane, chain) in self.traffic.lanes().iter().zip(&self.roads.network().chains) {
            if lane.motions().is_empty() {
                continue;
            }
            let (mut motions, mut drivers) = (lane.motions(), lane.drivers());
            let mut walk = Walk::along(chain);
            while let Some(count) = drivers.iter().position(|it| it.is_shadow) {
                rows.fill(&motions[..count], &mut walk);
                (motions, drivers) = (&motions[count + 1..], &drivers[count + 1..]);
            }
            rows.fill(motions, &mut walk);
        }
        for external in self.traffic.externals().all() {
            let Some(entry) = external.off_road() else { continue };
            let mut walk = Walk::along(self.roads.network().chain(external.at.chain));
            rows.fill(std::slice::from_ref(&entry.motion), &mut walk);
        }
    }

    /// Fills the columns of the drivers, if they are wanted.
    fn drivers(&self, columns: &mut Columns) {
        if !columns.has_drivers {
            return;
        }
        let Columns { class, style, destination, length_m, width_m, offset_m, state, is_external, .. } =
            columns;
        class.clear();
        style.clear();
        destination.clear();
        state.clear();
        is_external.clear();
        [&mut *length_m, &mut *width_m, &mut *offset_m].into_iter().for_each(Vec::clear);
        let styles = self.roads.changed_parameters().styles();
        for vehicle in self.vehicles() {
            let [length, width] = vehicle.size();
            class.push(vehicle.driver.class);
            style.push(styles[vehicle.driver.parameters as usize]);
            destination.push(vehicle.destination());
            length_m.push(length);
            width_m.push(width);
            offset_m.push(vehicle.offset());
            state.push(vehicle.driver.phase);
            is_external.push(vehicle.driver.is_external);
        }
    }
}
