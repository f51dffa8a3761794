//! The vehicles nearest to another one.

use std::f64::consts::PI;

use laneweave::network::{Point, Pose, turn};
use laneweave::sim::Vehicle;
use laneweave::{Phase, Simulation, VehicleId};

use super::{Memory, scaled};

/// The columns of another vehicle: whether there is one (1 or 0); how far its centre is ahead and to the left, in the
/// frame of the lane; how much faster it is; its heading against that of the lane; its length and width; the side to
/// which it signals, 1 for the left and −1 for the right. All are between −1 and 1; the number behind a slash is what
/// is 1.
pub const VEHICLE_COLUMNS: [&str; 8] = [
    "is_there",
    "ahead_m/100",
    "left_m/10",
    "faster_mps/40",
    "heading_rad/pi",
    "length_m/20",
    "width_m/3",
    "signals",
];

/// Distance ahead and to the left [m], speed [m/s], length and width [m] that are 1.
pub(super) const AHEAD: f64 = 100.0;
pub(super) const LEFT: f64 = 10.0;
pub(super) const SPEED: f64 = 40.0;
const LENGTH: f64 = 20.0;
/// The centre of a vehicle is at most so far from its front on the centre line of its lane [m].
const NEAR: f64 = 30.0;
const WIDTH: f64 = 3.0;

/// A vehicle near another one.
pub(super) struct Seen {
    distance: f64,
    id: VehicleId,
    row: [f32; VEHICLE_COLUMNS.len()],
}

/// The frame of a vehicle's lane: its origin is on the centre line, beside the centre of the vehicle.
pub(super) struct Frame {
    origin: Pose,
    sine_cosine: (f64, f64),
    /// Speed of the vehicle [m/s].
    speed: f64,
}

impl Frame {
    pub(super) fn of(simulation: &Simulation, ego: &Vehicle) -> Frame {
        let centre = &simulation.network().chain(ego.spot.chain).centre;
        let station = ego.x() - 0.5 * f64::from(ego.motion.length);
        let heading = centre.heading(station);
        let origin = Pose { at: centre.at(station), heading };
        Frame { origin, sine_cosine: heading.sin_cos(), speed: ego.speed() }
    }

    /// A place on the map in this frame: ahead and to the left [m].
    pub(super) fn local(&self, x: f64, y: f64) -> [f64; 2] {
        let (sine, cosine) = self.sine_cosine;
        let [east, north] = [x - self.origin.at.x, y - self.origin.at.y];
        [east * cosine + north * sine, north * cosine - east * sine]
    }

    /// Its origin on the map.
    pub(super) fn origin(&self) -> Point {
        self.origin.at
    }

    /// A heading against that of the lane [rad].
    pub(super) fn turn(&self, heading: f64) -> f64 {
        turn(self.origin.heading, heading)
    }

    /// How much faster another vehicle is, as a share.
    pub(super) fn faster(&self, speed: f64) -> f32 {
        scaled(speed - self.speed, SPEED)
    }

    fn seen(&self, other: &Vehicle) -> Seen {
        let (pose, [length, width]) = (other.pose(), other.size());
        let [ahead, left] = self.local(pose.at.x, pose.at.y);
        let signals = if other.driver.phase == Phase::Cruises { 0.0 } else { other.lane_change.side.sign() };
        let row = [
            1.0,
            scaled(ahead, AHEAD),
            scaled(left, LEFT),
            self.faster(other.speed()),
            scaled(self.turn(pose.heading), PI),
            scaled(length, LENGTH),
            scaled(width, WIDTH),
            signals as f32,
        ];
        Seen { distance: ahead.hypot(left), id: other.id(), row }
    }
}

/// Writes the rows of the `nearest` vehicles, the nearest first; those further away than what is 1 are not seen.
pub(super) fn write(
    simulation: &Simulation,
    ego: &Vehicle,
    frame: &Frame,
    nearest: usize,
    memory: &mut Memory,
    numbers: &mut [f32],
) {
    let seen = &mut memory.seen;
    seen.clear();
    // The front on the centre line takes less time than the centre between two lanes, and is near it.
    let is_near = |it: &Vehicle| {
        let front = simulation.network().chain(it.spot.chain).centre.at(it.x());
        let [ahead, left] = frame.local(front.x, front.y);
        it.is_on_its_own_path() || ahead.hypot(left) <= AHEAD + NEAR
    };
    let others = simulation.views().filter(|it| it.id() != ego.id() && is_near(it));
    seen.extend(others.map(|it| frame.seen(&it)).filter(|it| it.distance <= AHEAD));
    seen.sort_unstable_by(|a, b| a.distance.total_cmp(&b.distance).then(a.id.cmp(&b.id)));
    for (place, seen) in numbers.chunks_exact_mut(VEHICLE_COLUMNS.len()).zip(seen.iter().take(nearest)) {
        place.copy_from_slice(&seen.row);
    }
}
