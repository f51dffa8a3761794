//! What one vehicle of each simulation sees: itself and those nearest to it, in the frame of its lane.

use laneweave_network::{Pose, turn};
use laneweave_scenario::Fault;
use laneweave_sim::{Vehicle, VehicleId};

use super::{Fleet, check_length};
use crate::simulation::Simulation;

/// The columns of a row of sight: whether there is a vehicle (1 or 0); where its centre is in the frame of the lane,
/// ahead and to the left [m]; its speed [m/s]; its heading against that of the lane [rad]; its length and its width
/// [m].
pub const SIGHT_COLUMNS: [&str; 7] =
    ["is_there", "ahead_m", "left_m", "speed_mps", "heading_rad", "length_m", "width_m"];

type Row = [f32; SIGHT_COLUMNS.len()];

/// The frame of a vehicle's lane: its origin is on the centre line, beside the centre of the vehicle.
struct Frame {
    origin: Pose,
    sine_cosine: (f64, f64),
}

impl Frame {
    fn of(simulation: &Simulation, vehicle: &Vehicle) -> Frame {
        let centre = &simulation.network().chain(vehicle.spot.chain).centre;
        let station = vehicle.x() - 0.5 * f64::from(vehicle.motion.length);
        let heading = centre.heading(station);
        Frame { origin: Pose { at: centre.at(station), heading }, sine_cosine: heading.sin_cos() }
    }

    fn row(&self, vehicle: &Vehicle, pose: Pose) -> Row {
        let (sine, cosine) = self.sine_cosine;
        let [east, north] = [pose.at.x - self.origin.at.x, pose.at.y - self.origin.at.y];
        let [length, width] = vehicle.size();
        let (ahead, left) = (east * cosine + north * sine, north * cosine - east * sine);
        let heading = turn(self.origin.heading, pose.heading);
        [1.0, ahead, left, vehicle.speed(), heading, length, width].map(|it| it as f32)
    }
}

impl Fleet {
    /// Fills `sight` with what the vehicle of each simulation in `egos` sees: a row for itself, then one for each of
    /// the `nearest` others, the nearest first. A row has the [`SIGHT_COLUMNS`]. Rows are 0 where there is no vehicle,
    /// and all of them where the vehicle itself is not on the road.
    ///
    /// # Errors
    /// If `egos` has not one vehicle for each simulation, or `sight` has not as many places as there are numbers.
    pub fn sight(&self, egos: &[VehicleId], nearest: usize, sight: &mut [f32]) -> Result<(), Fault> {
        let each = (1 + nearest) * SIGHT_COLUMNS.len();
        check_length("egos", egos.len(), self.len())?;
        check_length("sight", sight.len(), self.len() * each)?;
        let mut others = Vec::new();
        let places = sight.chunks_exact_mut(each);
        for ((simulation, ego), place) in self.simulations().iter().zip(egos).zip(places) {
            place.fill(0.0);
            let Some(vehicle) = simulation.view(*ego) else { continue };
            let own = vehicle.pose();
            let frame = Frame::of(simulation, &vehicle);
            let seen = simulation.views().filter(|it| it.id() != *ego).map(|it| {
                let pose = it.pose();
                let [east, north] = [pose.at.x - own.at.x, pose.at.y - own.at.y];
                (east * east + north * north, it.id(), frame.row(&it, pose))
            });
            others.clear();
            others.extend(seen);
            others.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            let rows = std::iter::once(frame.row(&vehicle, own)).chain(others.iter().map(|it| it.2));
            for (place, row) in place.chunks_exact_mut(SIGHT_COLUMNS.len()).zip(rows) {
                place.copy_from_slice(&row);
            }
        }
        Ok(())
    }
}
