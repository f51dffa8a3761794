//! An obstacle stands for a vehicle in a lane that it touches, but along which it does not drive.

use laneweave_network::{Footprint, Network, Point, Rectangle};

use crate::junction::reservations::NO_RESERVATION;
use crate::state::lane::{DriverState, Entry, Kinematics, LaneChangeState, Phase};
use crate::state::previous_lanes::PreviousLanes;

/// Drivers stop for a vehicle that comes towards them where it will be after they have braked this hard [m/s²] (ours).
const BRAKES_FOR_ONCOMING: f64 = 4.0;

/// Drivers keep so far behind a vehicle that may stand at an angle [m] (ours).
const CLEARANCE: f64 = 0.2;

/// A vehicle at its new place on the ground.
#[derive(Clone, Copy)]
pub(super) struct Moved {
    /// The ground that it covers.
    pub(super) rectangle: Rectangle,
    /// The ground that it covered one step before, if it has not jumped since.
    pub(super) before: Option<Rectangle>,
    /// Speed that others see [m/s].
    pub(super) speed: f64,
    /// The speed is known better than the place: others see it, even if the vehicle has moved less.
    pub(super) has_known_speed: bool,
    /// Its way in the last step [m].
    pub(super) way: f64,
}

impl Moved {
    /// The station of its rearmost corner along the lane of a footprint, and a little behind [m]. A vehicle that comes
    /// into a lane at an angle is all in it, soon; the part that is on the path already does not move with it.
    pub(super) fn rear(&self, network: &Network, footprint: &Footprint) -> f64 {
        footprint.from + rear_of(&self.rectangle, network, footprint).min(0.0) - CLEARANCE
    }

    /// Its speed along the lane of a footprint [m/s], negative against the traffic. The rear of a vehicle that turns
    /// may be slower than its centre.
    pub(super) fn speed_along(&self, network: &Network, footprint: &Footprint, dt: f64) -> f64 {
        let heading = network.chain(footprint.chain).centre.heading(footprint.from);
        let along = self.speed * (self.rectangle.pose.heading - heading).cos();
        let rear = |it: &Rectangle| rear_of(it, network, footprint);
        self.before
            .filter(|_| !self.has_known_speed)
            .map_or(along, |before| along.min((rear(&self.rectangle) - rear(&before)) / dt))
    }
}

/// How far ahead of the beginning of a footprint the rearmost corner of a rectangle is, along the lane [m].
fn rear_of(rectangle: &Rectangle, network: &Network, footprint: &Footprint) -> f64 {
    let centre = &network.chain(footprint.chain).centre;
    let (foot, (sin, cos)) = (centre.at(footprint.from), centre.heading(footprint.from).sin_cos());
    let along = |it: &Point| (it.x - foot.x) * cos + (it.y - foot.y) * sin;
    rectangle.corners().iter().map(along).fold(f64::INFINITY, f64::min)
}

/// The obstacle for the vehicle of `entry` at a footprint. A vehicle that comes towards the traffic stands there, and
/// reaches as far as it comes while drivers stop.
pub(super) fn obstacle(
    network: &Network,
    entry: &Entry,
    moved: &Moved,
    footprint: &Footprint,
    dt: f64,
) -> Entry {
    let Footprint { chain, from, to, .. } = *footprint;
    let rear = moved.rear(network, footprint);
    let along = moved.speed_along(network, footprint, dt);
    let comes = (-along).max(0.0) * network.chain(chain).limit(from) / BRAKES_FOR_ONCOMING;
    let motion = Kinematics {
        x: to,
        speed: along.max(0.0),
        acceleration: if along > 0.0 { entry.motion.acceleration } else { 0.0 },
        length: (to - rear + comes) as f32,
        ..entry.motion
    };
    Entry { motion, ..parked(entry) }
}

/// An entry that stands for the vehicle of `entry`, and does nothing.
pub(super) fn parked(entry: &Entry) -> Entry {
    let Entry { motion, driver, lane_change } = *entry;
    Entry {
        motion,
        driver: DriverState {
            is_shadow: true,
            phase: Phase::Cruises,
            desired: driver.limit_desired,
            in_emergency: false,
            needs_full_update: false,
            ..driver
        },
        lane_change: LaneChangeState {
            stretch: 1.0,
            progress: 0.0,
            counterpart: None,
            previous_lanes: PreviousLanes::NONE,
            last_place: f64::INFINITY,
            lets_in: LaneChangeState::NOBODY,
            minds_offside: false,
            reservation: NO_RESERVATION,
            ..lane_change
        },
    }
}
