//! The queues at the origins of the demand, and what blocks them.

use laneweave_network::{ChainIndex, Position};

use crate::demand::source::{Queue, Start};
use crate::driver::request_reservation::surveyed;
use crate::junction::need::Survey;
use crate::right_of_way::applicant::Applicant;
use crate::right_of_way::may_pass::{Asking, PassHindrance, may_pass};
use crate::step::reserve_on_entering::{Entry, applicant, entry};
use crate::step::world::World;
use crate::view::scene::{Scene, Spot};

/// The queue for one lane of an origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EntryQueue {
    /// Index of the origin in the demand.
    pub origin: usize,
    /// The lane.
    pub chain: ChainIndex,
    /// Station at which vehicles start [m].
    pub station: f64,
    /// Number of waiting vehicles.
    pub waiting: usize,
    /// What blocks the first of them.
    pub held: Option<Held>,
}

/// What blocks the first vehicle of a queue.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Held {
    /// The traffic on the lane moves, but leaves no gap.
    Traffic,
    /// The vehicles ahead stand, for none of the following reasons.
    Queue,
    /// They stand because of a red light.
    RedLight,
    /// They stand because others go first at a junction, or because of a stop sign.
    Priority,
    /// They stand because there is no storage space beyond a junction, or the space at a trip end inside the map is
    /// kept for others.
    Space,
    /// Perimeter control: the town core is full, and no trip through it begins.
    FullMap,
}

impl Held {
    /// All of them.
    pub const ALL: [Held; 6] =
        [Held::Traffic, Held::Queue, Held::RedLight, Held::Priority, Held::Space, Held::FullMap];
}

/// A vehicle slower than this [m/s], and this near to the one ahead [m], is part of a queue; ours.
const QUEUES: f64 = 2.0;
const NEAR: f64 = 15.0;

/// The queues of all lanes of all origins, in the order of the demand.
pub fn entry_queues(world: &World) -> impl Iterator<Item = EntryQueue> + '_ {
    let lanes = world.arrivals().sources().iter().enumerate();
    let lanes = lanes.flat_map(|(origin, source)| source.lanes().iter().map(move |it| (origin, it)));
    lanes.map(|(origin, queue)| EntryQueue {
        origin,
        chain: queue.chain,
        station: queue.start.station(),
        waiting: queue.waiting.len(),
        held: held(world, queue),
    })
}

/// Where vehicles of each of these queues enter, and how many wait there.
pub fn entry_queue_lengths(world: &World) -> impl Iterator<Item = (Position, usize)> + '_ {
    let lanes = world.arrivals().sources().iter().flat_map(|it| it.lanes());
    lanes.map(|it| (Position::new(it.chain, it.start.station()), it.waiting.len()))
}

/// What blocks the first vehicle of a queue.
fn held(world: &World, queue: &Queue) -> Option<Held> {
    let first = queue.waiting.front()?;
    let scene = world.scene();
    let starts_from_rest = matches!(queue.start, Start::FromRest(_));
    if first.is_through_town && world.arrivals().is_full() {
        return Some(Held::FullMap);
    }
    if starts_from_rest && scene.reservations.kept_on(queue.section(scene.network)) > 0.0 {
        return Some(Held::Space);
    }
    match entry(&scene, queue, first, world.clock(), &mut Survey::default()) {
        Entry::Refused(PassHindrance::Light) => return Some(Held::RedLight),
        Entry::Refused(PassHindrance::Sign | PassHindrance::Others) => return Some(Held::Priority),
        Entry::Refused(PassHindrance::Space | PassHindrance::Roundabout | PassHindrance::Blocked) => {
            return Some(Held::Space);
        }
        Entry::Free | Entry::Reserved { .. } => {}
    }
    let from = scene.viewpoint_at(applicant(&scene, queue, first).from, queue.chain, queue.start.station());
    let last = scene.leader_spot(from).filter(|it| scene.motion(*it).speed < QUEUES);
    Some(last.map_or(Held::Traffic, |it| why_head_stands(world, &scene, head(&scene, it))))
}

/// Why the vehicle at the head of a queue stands.
fn why_head_stands(world: &World, scene: &Scene, spot: Spot) -> Held {
    let Some(waiting) = world.waits_at_a_junction(spot) else {
        return Held::Queue;
    };
    let mut survey = Survey::default();
    if !surveyed(scene, &Applicant::at(scene, spot), &mut survey) {
        return Held::Queue;
    }
    let applicant = Applicant::at(scene, spot);
    match may_pass(scene, &applicant, &survey, Asking::of(&applicant, waiting.since, world.clock())) {
        Ok(()) => Held::Queue,
        Err(PassHindrance::Light) => Held::RedLight,
        Err(PassHindrance::Sign | PassHindrance::Others) => Held::Priority,
        Err(PassHindrance::Space | PassHindrance::Roundabout | PassHindrance::Blocked) => Held::Space,
    }
}

/// The first vehicle of the queue in which the vehicle at `spot` stands.
fn head(scene: &Scene, mut spot: Spot) -> Spot {
    /// Largest number of vehicles that are followed within the map.
    const MOST: usize = 1000;
    for _ in 0..MOST {
        let from = scene.viewpoint(spot);
        let is_near = scene.ahead(from).is_some_and(|it| it.gap < NEAR && it.speed < QUEUES);
        let Some(ahead) = scene.leader_spot(from).filter(|_| is_near) else { break };
        spot = ahead;
    }
    spot
}
