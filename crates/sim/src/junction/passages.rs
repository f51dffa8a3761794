//! The passages that were given, the order in each zone, and who waits for one.

use laneweave_network::{LightIndex, Network, ZoneIndex};
use serde::{Deserialize, Serialize};

use crate::junction::claim::Turn;
use crate::junction::claim::{Claim, Hold};
use crate::junction::need::Survey;
use crate::junction::refuge::{Numbers, Refuge};
use crate::junction::rings::Rings;
use crate::state::clock::Clock;
use crate::state::lane::VehicleId;

/// A vehicle has no passage.
pub(crate) const NO_PASSAGE: u32 = u32::MAX;

/// All passages of an instant.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Passages {
    given: Vec<Passage>,
    free: Vec<u32>,
    /// For each zone those who may pass it, in the order in which they do.
    queues: Vec<Vec<Holder>>,
    /// For each zone and side the turn of who has waited longest for it.
    claims: Vec<[Option<Turn>; 2]>,
    claimed: Vec<ZoneIndex>,
    numbers: Numbers,
    /// For each refuge who out of patience has waited longest for room on it, and how much it needs [m].
    wanted: Vec<Option<(Claim, f64)>>,
    wanted_on: Vec<usize>,
    /// For each refuge the room kept on it for those who are on their way there [cm].
    kept: Vec<u64>,
    pub(crate) rings: Rings,
}

/// The right of a vehicle to pass zones. Distances are those of its front from where the first of them was given [m].
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Passage {
    pub(crate) vehicle: VehicleId,
    pub(crate) is_given: bool,
    /// Step in which its driver first asked for it.
    since: u32,
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

/// Room kept for a vehicle beyond the zones.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Room {
    /// Number of the refuge.
    on: usize,
    /// Distance at which the vehicle has got there [m].
    until: f64,
    /// Length [cm].
    length: u64,
}

/// A place in the order of a zone.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Holder {
    pub(crate) slot: u32,
    pub(crate) side: u8,
}

impl Passages {
    /// None given, on `network`.
    pub(crate) fn new(network: &Network) -> Passages {
        let zones = network.junctions.zones.len();
        let numbers = Numbers::of(network);
        Passages {
            queues: vec![Vec::new(); zones],
            claims: vec![[None; 2]; zones],
            wanted: vec![None; numbers.count],
            kept: vec![0; numbers.count],
            numbers,
            rings: Rings::of(network),
            ..Passages::default()
        }
    }

    /// Whether it is of the same network as `other`, and names nothing that is not there.
    pub(crate) fn fits(&self, other: &Passages, lights: usize, clock: Clock) -> bool {
        let Passages { given, free, queues, claims, claimed, numbers, wanted, wanted_on, kept, rings } = self;
        let is_zone = |it: &ZoneIndex| it.at() < queues.len();
        let is_slot = |it: u32| (it as usize) < given.len();
        let is_held = |zone: usize, it: &Holder| {
            is_slot(it.slot)
                && given[it.slot as usize]
                    .holds
                    .iter()
                    .any(|hold| hold.zone.at() == zone && hold.side == it.side)
        };
        let is_given = |it: &Passage| {
            it.since <= clock.step
                && it.holds.iter().all(|it| is_zone(&it.zone) && it.side < 2)
                && it.lights.iter().all(|it| it.0.at() < lights)
                && it.rooms.iter().all(|it| it.on < kept.len() && it.length <= kept[it.on])
        };
        queues.len() == other.queues.len()
            && claims.len() == other.claims.len()
            && wanted.len() == other.wanted.len()
            && kept.len() == other.kept.len()
            && numbers == &other.numbers
            && rings.fits(&other.rings)
            && given.iter().all(is_given)
            && free.iter().all(|it| is_slot(*it))
            && claimed.iter().all(is_zone)
            && wanted_on.iter().all(|it| *it < wanted.len())
            && queues.iter().enumerate().all(|(zone, it)| it.iter().all(|it| is_held(zone, it)))
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

    /// The turn of who has waited longest on `side` of `zone`.
    pub(crate) fn claim(&self, zone: ZoneIndex, side: u8) -> Option<Turn> {
        self.claims.get(zone.at()).and_then(|it| it[usize::from(side)])
    }

    /// Room kept on `refuge` for those who are on their way there [m].
    pub(crate) fn kept_on(&self, refuge: Refuge) -> f64 {
        self.numbers.of_refuge(refuge).map_or(0.0, |it| self.kept[it] as f64 / CENTIMETRES)
    }

    /// Forgets who waits.
    pub(crate) fn clear_claims(&mut self) {
        for zone in self.claimed.drain(..) {
            self.claims[zone.at()] = [None; 2];
        }
        self.rings.clear_claims();
        for number in self.wanted_on.drain(..) {
            self.wanted[number] = None;
        }
    }

    /// Notes the turn of who waits for a side of a zone.
    pub(crate) fn note_claim(&mut self, zone: ZoneIndex, side: u8, turn: Turn) {
        let noted = &mut self.claims[zone.at()];
        if noted.iter().all(Option::is_none) {
            self.claimed.push(zone);
        }
        let own = &mut noted[usize::from(side)];
        *own = own.filter(|first| first.claim < turn.claim).or(Some(turn));
    }

    /// Notes who waits for `needed` [m] of room on a refuge.
    pub(crate) fn note_want(&mut self, refuge: Refuge, claim: Claim, needed: f64) {
        let Some(number) = self.numbers.of_refuge(refuge) else { return };
        let noted = &mut self.wanted[number];
        if noted.is_none() {
            self.wanted_on.push(number);
        }
        *noted = noted.filter(|(first, _)| *first < claim).or(Some((claim, needed)));
    }

    /// Room on `refuge` that comes first to somebody else than the one who claims [m].
    pub(crate) fn wanted_before(&self, refuge: Refuge, claim: Claim) -> f64 {
        let wanted = self.numbers.of_refuge(refuge).and_then(|it| self.wanted[it]);
        wanted.filter(|(first, _)| *first < claim).map_or(0.0, |(_, needed)| needed)
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
        if let Some(on) = self.numbers.of_refuge(survey.refuge) {
            let length = (survey.needed * CENTIMETRES).ceil() as u64;
            self.kept[on] += length;
            passage.rooms.push(Room { on, until: base + survey.extent, length });
        }
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

    /// The vehicle of the passage in `slot` drove on by `distance` [m], and now has `speed` and desires `desired`
    /// [m/s].
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
                kept[room.on] -= room.length;
            }
            !is_over
        });
        passage.lights.retain(|(_, at)| *at > travelled);
        if passage.holds.is_empty() && passage.rooms.is_empty() {
            passage.is_given = false;
            self.free.push(slot);
        }
    }

    /// Notes that the driver of the passage in `slot` first asked for it in step `since`.
    pub(crate) fn note_since(&mut self, slot: u32, since: u32) {
        self.given[slot as usize].since = since;
    }

    /// Step in which the driver of the passage in `slot` first asked for it.
    pub(crate) fn since(&self, slot: u32) -> u32 {
        self.given[slot as usize].since
    }

    /// The vehicle of the passage in `slot` goes, whatever lights show from now on: others have been let go because it
    /// does.
    pub(crate) fn make_certain(&mut self, slot: u32) {
        self.given[slot as usize].lights.clear();
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
                kept[room.on] -= room.length;
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

    /// What of it is left from the vehicle's front on, whatever lights show [m].
    pub(crate) fn left_for_certain(&self) -> f64 {
        let ends = self.lights.iter().map(|(_, line)| self.zone_over(*line).unwrap_or(*line).min(*line));
        ends.filter(|it| *it > self.travelled).fold(self.extent, f64::min) - self.travelled
    }

    /// Where the vehicle enters the first of the zones that it has not left at the `line` of a light: who stops at the
    /// line has to stop for these, too. From the beginning of the passage on [m].
    pub(crate) fn zone_over(&self, line: f64) -> Option<f64> {
        self.holds.iter().filter(|it| it.leave > line).map(|it| it.enter).reduce(f64::min)
    }

    /// What it holds of the zone on the other side of `hold`.
    pub(crate) fn across(&self, hold: &Hold) -> Option<&Hold> {
        self.holds.iter().find(|it| it.zone == hold.zone && it.side != hold.side)
    }

    /// The lights that it passes, with the distances to where their drivers stop [m].
    pub(crate) fn lights(&self) -> impl Iterator<Item = (LightIndex, f64)> {
        self.lights.iter().map(|(light, at)| (*light, at - self.travelled))
    }
}

#[cfg(test)]
mod tests;
