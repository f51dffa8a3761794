//! The passages that were given, the order in each zone, and who waits for one.

use laneweave_network::{ChainIndex, LightIndex, Network, ZoneIndex};

use super::survey::Survey;
use crate::traffic::VehicleId;

/// A vehicle has no passage.
pub(crate) const NO_PASSAGE: u32 = u32::MAX;

/// All passages of an instant.
#[derive(Clone, Debug, Default)]
pub struct Passages {
    given: Vec<Passage>,
    free: Vec<u32>,
    /// For each zone those who may pass it, in the order in which they do.
    queues: Vec<Vec<Holder>>,
    /// For each zone and side who has waited longest for it.
    claims: Vec<[Option<Claim>; 2]>,
    claimed: Vec<ZoneIndex>,
    /// For each chain the room kept on it for those who are on their way there [cm].
    kept: Vec<u64>,
}

/// The right of a vehicle to pass zones. Distances are those of its front from where the first of them was given [m].
#[derive(Clone, Debug, Default)]
pub(crate) struct Passage {
    pub(crate) vehicle: VehicleId,
    pub(crate) is_given: bool,
    pub(crate) length: f64,
    pub(crate) speed: f64,
    pub(crate) desired: f64,
    /// Driven so far.
    pub(crate) travelled: f64,
    /// How far it goes.
    pub(crate) extent: f64,
    pub(crate) holds: Vec<Hold>,
    lights: Vec<(LightIndex, f64)>,
    rooms: Vec<Room>,
}

/// A side of a zone that a vehicle may pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Hold {
    pub(crate) zone: ZoneIndex,
    pub(crate) side: u8,
    /// Where the front comes in the way [m].
    pub(crate) enter: f64,
    /// Where it is no longer: the rear is out, or the lanes have become one [m].
    pub(crate) leave: f64,
}

/// Room kept for a vehicle beyond the zones.
#[derive(Clone, Copy, Debug)]
struct Room {
    chain: ChainIndex,
    /// Distance at which the vehicle has got there [m].
    until: f64,
    /// Length [cm].
    length: u64,
}

/// A place in the order of a zone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Holder {
    pub(crate) slot: u32,
    pub(crate) side: u8,
}

/// A driver who waits because of others. Those out of patience come before all others, then who has waited longer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Claim {
    pub(crate) is_patient: bool,
    pub(crate) since: u32,
    pub(crate) id: VehicleId,
    pub(crate) is_long: bool,
}

impl Passages {
    /// None given, on `network`.
    pub(crate) fn new(network: &Network) -> Passages {
        let zones = network.junctions.zones.len();
        Passages {
            queues: vec![Vec::new(); zones],
            claims: vec![[None; 2]; zones],
            kept: vec![0; if zones == 0 { 0 } else { network.chains.len() }],
            ..Passages::default()
        }
    }

    /// The passage in `slot`, if it is still that of `vehicle`.
    #[inline]
    pub(crate) fn of(&self, slot: u32, vehicle: VehicleId) -> Option<&Passage> {
        self.given.get(slot as usize).filter(|it| it.is_given && it.vehicle == vehicle)
    }

    /// Those who may pass `zone`, in order.
    #[inline]
    pub(crate) fn order(&self, zone: ZoneIndex) -> impl DoubleEndedIterator<Item = (&Holder, &Passage)> {
        let holders = self.queues.get(zone.at()).map_or(&[][..], Vec::as_slice);
        holders.iter().map(|it| (it, &self.given[it.slot as usize]))
    }

    /// Who has waited longest on `side` of `zone`.
    pub(crate) fn claim(&self, zone: ZoneIndex, side: u8) -> Option<Claim> {
        self.claims.get(zone.at()).and_then(|it| it[usize::from(side)])
    }

    /// Room kept on `chain` for those who are on their way there [m].
    pub(crate) fn kept_on(&self, chain: ChainIndex) -> f64 {
        self.kept.get(chain.at()).map_or(0.0, |it| *it as f64 / CENTIMETRES)
    }

    /// Forgets who waits.
    pub(crate) fn clear_claims(&mut self) {
        for zone in self.claimed.drain(..) {
            self.claims[zone.at()] = [None; 2];
        }
    }

    /// Notes who waits for a side of a zone.
    pub(crate) fn note_claim(&mut self, zone: ZoneIndex, side: u8, claim: Claim) {
        let noted = &mut self.claims[zone.at()];
        if noted.iter().all(Option::is_none) {
            self.claimed.push(zone);
        }
        let own = &mut noted[usize::from(side)];
        *own = Some(own.map_or(claim, |it| it.min(claim)));
    }

    /// Gives `vehicle`, who has the passage in `slot` if any, what was surveyed. Returns its slot.
    pub(crate) fn give(&mut self, slot: u32, vehicle: VehicleId, length: f64, survey: &Survey) -> u32 {
        let slot = if self.of(slot, vehicle).is_some() { slot } else { self.open(vehicle, length) };
        let passage = &mut self.given[slot as usize];
        let base = passage.travelled;
        passage.extent = base + survey.extent;
        for hold in &survey.holds {
            let hold = Hold { enter: base + hold.enter, leave: base + hold.leave, ..*hold };
            passage.holds.push(hold);
            self.queues[hold.zone.at()].push(Holder { slot, side: hold.side });
        }
        passage.lights.extend(survey.lights.iter().map(|(light, at)| (*light, base + at)));
        let room = Room {
            chain: survey.refuge,
            until: base + survey.extent,
            length: (survey.needed * CENTIMETRES).ceil() as u64,
        };
        self.kept[room.chain.at()] += room.length;
        passage.rooms.push(room);
        slot
    }

    fn open(&mut self, vehicle: VehicleId, length: f64) -> u32 {
        let slot = self.free.pop().unwrap_or_else(|| {
            self.given.push(Passage::default());
            self.given.len() as u32 - 1
        });
        let passage = &mut self.given[slot as usize];
        passage.vehicle = vehicle;
        passage.is_given = true;
        passage.length = length;
        passage.travelled = 0.0;
        slot
    }

    /// The vehicle of the passage in `slot` drove on by `distance` [m], and now has `speed` and desires `desired` [m/s].
    pub(crate) fn advance(&mut self, slot: u32, distance: f64, speed: f64, desired: f64) {
        let Passages { given, queues, kept, .. } = self;
        let passage = &mut given[slot as usize];
        passage.travelled += distance;
        passage.speed = speed;
        passage.desired = desired;
        let travelled = passage.travelled;
        passage.holds.retain(|hold| {
            let is_over = hold.leave <= travelled;
            if is_over {
                leave_order(&mut queues[hold.zone.at()], slot, hold.side);
            }
            !is_over
        });
        passage.rooms.retain(|room| {
            let is_over = room.until <= travelled;
            if is_over {
                kept[room.chain.at()] -= room.length;
            }
            !is_over
        });
        passage.lights.retain(|(_, at)| *at > travelled);
        if passage.holds.is_empty() && passage.rooms.is_empty() {
            passage.is_given = false;
            self.free.push(slot);
        }
    }

    /// Takes back all of a passage that lies beyond `distance` from its beginning [m].
    pub(crate) fn take_back(&mut self, slot: u32, distance: f64) {
        let Passages { given, queues, kept, .. } = self;
        let passage = &mut given[slot as usize];
        passage.extent = passage.extent.min(distance);
        passage.holds.retain(|hold| {
            let stays = hold.enter < distance;
            if !stays {
                leave_order(&mut queues[hold.zone.at()], slot, hold.side);
            }
            stays
        });
        passage.rooms.retain(|room| {
            let stays = room.until < distance;
            if !stays {
                kept[room.chain.at()] -= room.length;
            }
            stays
        });
        passage.lights.retain(|(_, at)| *at < distance);
        if passage.holds.is_empty() && passage.rooms.is_empty() {
            passage.is_given = false;
            self.free.push(slot);
        }
    }

    /// The vehicle is no longer on the road.
    pub(crate) fn end(&mut self, slot: u32, vehicle: VehicleId) {
        if self.of(slot, vehicle).is_some() {
            self.take_back(slot, f64::NEG_INFINITY);
        }
    }
}

/// Centimetres in a metre: kept room is counted in whole ones, so that the order of changes does not matter.
const CENTIMETRES: f64 = 100.0;

fn leave_order(queue: &mut Vec<Holder>, slot: u32, side: u8) {
    if let Some(place) = queue.iter().position(|it| it.slot == slot && it.side == side) {
        queue.remove(place);
    }
}

impl Passage {
    /// What is left of it from the vehicle's front on [m].
    pub(crate) fn left(&self) -> f64 {
        self.extent - self.travelled
    }

    /// The lights that it passes, with the distances to where their drivers stop [m].
    pub(crate) fn lights(&self) -> impl Iterator<Item = (LightIndex, f64)> {
        self.lights.iter().map(|(light, at)| (*light, at - self.travelled))
    }
}
