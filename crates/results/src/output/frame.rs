//! All vehicles at some instants, as they are sampled: a copy of what the world holds, and then where their bodies are.
//!
//! The world is copied while it waits; what it takes to find the bodies is left to the thread that writes.

use laneweave_network::{ChainIndex, LaneletIndex, Point, Pose};
use laneweave_sim::{Class, Kinematics, Phase, PreviousLanes, World, bumpers_in_lane, pose_between};
use serde::{Deserialize, Serialize};

use super::names::Names;

/// Vehicles in a batch, or a few more: those of one instant are not parted. Few, so that little is left to write when
/// the run ends.
const BATCH: usize = 1 << 11;

/// Vehicles at some instants.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct Frame {
    /// Each instant by its step, with the number of seen vehicles up to it.
    instants: Vec<(u32, usize)>,
    seen: Vec<Seen>,
    across: Vec<Across>,
    /// Where the bodies of those seen are; empty until they are located.
    #[serde(skip)]
    bodies: Vec<Body>,
}

/// A vehicle as the world holds it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Seen {
    pub(super) motion: Kinematics,
    pub(super) chain: ChainIndex,
    pub(super) parameters: u32,
    previous_lanes: PreviousLanes,
    pub(super) class: Class,
    pub(super) phase: Phase,
}

const _: () = assert!(size_of::<Seen>() == 64, "what is copied of a vehicle fills one cache line");

/// Where the body of a vehicle between two lanes is: it takes both to tell.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Across {
    /// Its place in the list of those seen.
    place: usize,
    bumpers: [Point; 2],
    offset: f64,
}

/// Where a vehicle is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Body {
    /// Where its front bumper is: on which lanelet, and how far along that [m].
    pub(super) lanelet: LaneletIndex,
    pub(super) along: f64,
    /// How far its centre is to the left of the centre of the lane [m].
    pub(super) offset: f64,
    /// The middle of its front bumper.
    pub(super) front: Point,
    /// Its centre.
    pub(super) pose: Pose,
}

impl Frame {
    /// Adds all vehicles of `world`.
    pub(super) fn sample(&mut self, world: &World) {
        if self.seen.capacity() == 0 {
            self.seen.reserve_exact(BATCH + world.on_road());
        }
        let Frame { instants, seen, across, .. } = self;
        world.vehicles().for_each(|vehicle| {
            let (motion, car) = (*vehicle.motion, vehicle.driver);
            if car.phase.is_between_lanes() {
                let (bumpers, offset) = (vehicle.bumpers(), vehicle.lateral_offset());
                across.push(Across { place: seen.len(), bumpers, offset });
            }
            // Whose rear is on its chain has nothing behind it.
            let previous_lanes =
                if motion.rear() < 0.0 { vehicle.lane_change.previous_lanes } else { PreviousLanes::NONE };
            let (chain, parameters) = (vehicle.spot.chain, car.parameters);
            seen.push(Seen { motion, chain, parameters, previous_lanes, class: car.class, phase: car.phase });
        });
        instants.push((world.clock().step, seen.len()));
    }

    /// Finds the bodies of all, if that is not done.
    pub(super) fn locate(&mut self, names: &Names) {
        let Frame { seen, across, bodies, .. } = self;
        if bodies.len() == seen.len() {
            return;
        }
        bodies.reserve_exact(seen.len());
        let mut across = across.iter().peekable();
        bodies.extend(seen.iter().enumerate().map(|(place, it)| {
            let (lanelet, along) = names.network.chain(it.chain).lanelet(it.motion.x);
            let (bumpers, offset) = match across.next_if(|it| it.place == place) {
                Some(it) => (it.bumpers, it.offset),
                None => (bumpers_in_lane(&names.network, it.chain, it.previous_lanes, &it.motion), 0.0),
            };
            Body { lanelet, along, offset, front: bumpers[0], pose: pose_between(bumpers) }
        }));
    }

    /// The instants by their steps, each with all vehicles, which must be located.
    pub(super) fn instants(&self) -> impl Iterator<Item = (u32, &[Seen], &[Body])> {
        let begins = std::iter::once(0).chain(self.instants.iter().map(|(_, end)| *end));
        let places = self.instants.iter().zip(begins);
        places.map(|((step, end), begin)| (*step, &self.seen[begin..*end], &self.bodies[begin..*end]))
    }

    /// All that were seen, one instant after the other.
    pub(super) fn seen(&self) -> &[Seen] {
        &self.seen
    }

    /// Their bodies, which must be located.
    pub(super) fn bodies(&self) -> &[Body] {
        &self.bodies
    }

    /// It saw nothing yet.
    pub(super) fn is_empty(&self) -> bool {
        self.instants.is_empty()
    }

    /// It is a batch.
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
