//! Samples of all vehicles at some instants: a copy of the world's data, and then the positions of the vehicles.
//!
//! The world waits only for the copy; the writer thread computes the positions.

use laneweave_network::{ChainIndex, LaneletIndex, Point, Pose};
use laneweave_sim::{Class, Kinematics, Phase, PreviousLanes, World, bumpers_in_lane, pose_between};
use serde::{Deserialize, Serialize};

use super::names::Names;

/// Vehicles in a batch; those of one instant stay together, so there may be a few more. The number is small, so that
/// little is left to write when the run ends.
const BATCH: usize = 1 << 11;

/// Vehicles at some instants.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct Frame {
    /// Each instant by its step, with the number of sampled vehicles up to it.
    instants: Vec<(u32, usize)>,
    seen: Vec<Seen>,
    across: Vec<Across>,
    /// The positions of the sampled vehicles; empty until they are located.
    #[serde(skip)]
    bodies: Vec<Body>,
}

/// A vehicle in the world's data.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Seen {
    pub(super) motion: Kinematics,
    pub(super) chain: ChainIndex,
    pub(super) parameters: u32,
    pub(super) previous_lanes: PreviousLanes,
    pub(super) class: Class,
    pub(super) phase: Phase,
}

const _: () = assert!(size_of::<Seen>() == 64, "what is copied of a vehicle fills one cache line");

/// The position of a vehicle between two lanes: both lanes are needed for it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Across {
    /// Its index in the list of samples.
    place: usize,
    bumpers: [Point; 2],
    offset: f64,
    /// Length and width of the vehicle [m].
    size: [f64; 2],
}

/// The position of a vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Body {
    /// Its front bumper: the lanelet, and the station on it [m].
    pub(super) lanelet: LaneletIndex,
    pub(super) along: f64,
    /// Distance of its centre to the left of the centre of the lane [m].
    pub(super) offset: f64,
    /// The middle of its front bumper.
    pub(super) front: Point,
    /// Its centre.
    pub(super) pose: Pose,
    /// Length and width of the vehicle [m].
    pub(super) size: [f64; 2],
}

impl Frame {
    /// Adds all vehicles of `world`.
    pub(super) fn sample(&mut self, world: &World) {
        if self.seen.capacity() == 0 {
            self.seen.reserve_exact(BATCH + world.on_road());
        }
        let Frame { instants, seen, across, .. } = self;
        world.vehicles().for_each(|vehicle| {
            let (motion, car) = (Kinematics { speed: vehicle.speed(), ..*vehicle.motion }, vehicle.driver);
            if car.phase.is_between_lanes() || vehicle.is_on_its_own_path() {
                let (bumpers, offset) = (vehicle.bumpers(), vehicle.lateral_offset());
                across.push(Across { place: seen.len(), bumpers, offset, size: vehicle.size() });
            }
            // A vehicle with its rear on its own chain needs no previous chains.
            let previous_lanes =
                if motion.rear() < 0.0 { vehicle.lane_change.previous_lanes } else { PreviousLanes::NONE };
            let (chain, parameters) = (vehicle.spot.chain, car.parameters);
            seen.push(Seen { motion, chain, parameters, previous_lanes, class: car.class, phase: car.phase });
        });
        instants.push((world.clock().step, seen.len()));
    }

    /// Computes the positions of all vehicles, if this is not done.
    pub(super) fn locate(&mut self, names: &Names) {
        let Frame { seen, across, bodies, .. } = self;
        if bodies.len() == seen.len() {
            return;
        }
        bodies.reserve_exact(seen.len());
        let mut across = across.iter().peekable();
        bodies.extend(seen.iter().enumerate().map(|(place, it)| {
            let (lanelet, along) = names.network.chain(it.chain).lanelet(it.motion.x);
            let (bumpers, offset, size) = match across.next_if(|it| it.place == place) {
                Some(it) => (it.bumpers, it.offset, it.size),
                None => {
                    let bumpers = bumpers_in_lane(&names.network, it.chain, it.previous_lanes, &it.motion);
                    (bumpers, 0.0, [f64::from(it.motion.length), it.class.body().width])
                }
            };
            Body { lanelet, along, offset, front: bumpers[0], pose: pose_between(bumpers), size }
        }));
    }

    /// The instants by their steps, each with all vehicles, which must be located.
    pub(super) fn instants(&self) -> impl Iterator<Item = (u32, &[Seen], &[Body])> {
        let begins = std::iter::once(0).chain(self.instants.iter().map(|(_, end)| *end));
        let places = self.instants.iter().zip(begins);
        places.map(|((step, end), begin)| (*step, &self.seen[begin..*end], &self.bodies[begin..*end]))
    }

    /// Up to which sample each instant goes.
    pub(super) fn ends(&self) -> impl Iterator<Item = usize> {
        self.instants.iter().map(|(_, end)| *end)
    }

    /// All samples, one instant after the other.
    pub(super) fn seen(&self) -> &[Seen] {
        &self.seen
    }

    /// Their positions, which must be computed.
    pub(super) fn bodies(&self) -> &[Body] {
        &self.bodies
    }

    /// Whether it has no samples.
    pub(super) fn is_empty(&self) -> bool {
        self.instants.is_empty()
    }

    /// Whether it is a full batch.
    pub(super) fn is_full(&self) -> bool {
        self.seen.len() >= BATCH
    }

    /// Empties it.
    pub(super) fn clear(&mut self) {
        let Frame { instants, seen, across, bodies } = self;
        instants.clear();
        seen.clear();
        across.clear();
        bodies.clear();
    }
}
