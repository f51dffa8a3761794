//! The granted reservations, the order in each zone, and the waiting priorities.

use laneweave_network::{LightIndex, Network, ZoneIndex};
use serde::{Deserialize, Serialize};

use crate::junction::need::Survey;
use crate::junction::roundabouts::Roundabouts;
use crate::junction::storage_section::{Numbers, StorageSection};
use crate::junction::waiting_priority::WaitingTurn;
use crate::junction::waiting_priority::{WaitingPriority, ZoneReservation};
use crate::state::clock::Clock;
use crate::state::lane::VehicleId;
use crate::state::standstill::STANDSTILL;

/// A vehicle has no reservation.
pub(crate) const NO_RESERVATION: u32 = u32::MAX;

/// All reservations at one instant.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Reservations {
    given: Vec<Reservation>,
    free: Vec<u32>,
    /// For each zone the vehicles that may pass it, in the order in which they pass.
    queues: Vec<Vec<Holder>>,
    /// For each zone and side the turn of the vehicle that has waited longest for it.
    priorities: Vec<[Option<WaitingTurn>; 2]>,
    noted_on: Vec<ZoneIndex>,
    numbers: Numbers,
    /// For each storage section the impatient vehicle that has waited longest for space on it, and the space it needs
    /// [m].
    requested: Vec<Option<(WaitingPriority, f64)>>,
    requested_on: Vec<usize>,
    /// For each storage section the space reserved for vehicles that are on their way there [cm].
    kept: Vec<u64>,
    pub(crate) roundabouts: Roundabouts,
}

/// The right of a vehicle to pass zones. Distances are those of its front from the place of the first grant [m].
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Reservation {
    pub(crate) vehicle: VehicleId,
    pub(crate) is_given: bool,
    /// Step in which its driver first requested it.
    since: u32,
    pub(crate) length: f64,
    pub(crate) speed: f64,
    pub(crate) desired: f64,
    /// Distance driven since the first grant.
    pub(crate) travelled: f64,
    /// Distance at which it ends.
    pub(crate) extent: f64,
    pub(crate) holds: Vec<ZoneReservation>,
    lights: Vec<(LightIndex, f64)>,
    kept_spaces: Vec<KeptSpace>,
    /// It goes in a wait cycle, without storage space for all of its length: it may have to stand within zones.
    pub(crate) lacks_space: bool,
}

/// Storage space reserved for a vehicle beyond the zones.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct KeptSpace {
    /// Number of the storage section.
    on: usize,
    /// Distance at which the vehicle has arrived there [m].
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

impl Reservations {
    /// No reservations, on `network`.
    pub(crate) fn new(network: &Network) -> Reservations {
        let zones = network.junctions.zones.len();
        let numbers = Numbers::of(network);
        Reservations {
            queues: vec![Vec::new(); zones],
            priorities: vec![[None; 2]; zones],
            requested: vec![None; numbers.count],
            kept: vec![0; numbers.count],
            numbers,
            roundabouts: Roundabouts::of(network),
            ..Reservations::default()
        }
    }

    /// Whether it belongs to the same network as `other`, and names only things that exist.
    pub(crate) fn fits(&self, other: &Reservations, lights: usize, clock: Clock) -> bool {
        let Reservations {
            given,
            free,
            queues,
            priorities,
            noted_on,
            numbers,
            requested,
            requested_on,
            kept,
            roundabouts,
        } = self;
        let is_zone = |it: &ZoneIndex| it.at() < queues.len();
        let is_slot = |it: u32| (it as usize) < given.len();
        let is_held = |zone: usize, it: &Holder| {
            is_slot(it.slot)
                && given[it.slot as usize]
                    .holds
                    .iter()
                    .any(|hold| hold.zone.at() == zone && hold.side == it.side)
        };
        let is_given = |it: &Reservation| {
            it.since <= clock.step
                && it.holds.iter().all(|it| is_zone(&it.zone) && it.side < 2)
                && it.lights.iter().all(|it| it.0.at() < lights)
                && it.kept_spaces.iter().all(|it| it.on < kept.len() && it.length <= kept[it.on])
        };
        queues.len() == other.queues.len()
            && priorities.len() == other.priorities.len()
            && requested.len() == other.requested.len()
            && kept.len() == other.kept.len()
            && numbers == &other.numbers
            && roundabouts.fits(&other.roundabouts)
            && given.iter().all(is_given)
            && free.iter().all(|it| is_slot(*it))
            && noted_on.iter().all(is_zone)
            && requested_on.iter().all(|it| *it < requested.len())
            && queues.iter().enumerate().all(|(zone, it)| it.iter().all(|it| is_held(zone, it)))
    }

    /// The reservation in `slot`, if it is still that of `vehicle`.
    #[inline]
    pub(crate) fn of(&self, slot: u32, vehicle: VehicleId) -> Option<&Reservation> {
        self.given.get(slot as usize).filter(|it| it.is_given && it.vehicle == vehicle)
    }

    /// The vehicles that may pass `zone`, in order.
    #[inline]
    pub(crate) fn order(&self, zone: ZoneIndex) -> impl DoubleEndedIterator<Item = (&Holder, &Reservation)> {
        let holders = self.queues.get(zone.at()).map_or(&[][..], Vec::as_slice);
        holders.iter().map(|it| (it, &self.given[it.slot as usize]))
    }

    /// The turn of the vehicle that has waited longest on `side` of `zone`.
    pub(crate) fn priority(&self, zone: ZoneIndex, side: u8) -> Option<WaitingTurn> {
        self.priorities.get(zone.at()).and_then(|it| it[usize::from(side)])
    }

    /// Space reserved on `section` for vehicles that are on their way there [m].
    pub(crate) fn kept_on(&self, section: StorageSection) -> f64 {
        self.numbers.of_section(section).map_or(0.0, |it| self.kept[it] as f64 / CENTIMETRES)
    }

    /// Clears all waiting priorities.
    pub(crate) fn clear_priorities(&mut self) {
        for zone in self.noted_on.drain(..) {
            self.priorities[zone.at()] = [None; 2];
        }
        self.roundabouts.clear_priorities();
        for number in self.requested_on.drain(..) {
            self.requested[number] = None;
        }
    }

    /// Records the turn of a vehicle that waits for a side of a zone.
    pub(crate) fn note_priority(&mut self, zone: ZoneIndex, side: u8, turn: WaitingTurn) {
        let noted = &mut self.priorities[zone.at()];
        if noted.iter().all(Option::is_none) {
            self.noted_on.push(zone);
        }
        let own = &mut noted[usize::from(side)];
        *own = own.filter(|first| first.priority < turn.priority).or(Some(turn));
    }

    /// Records a request for `needed` [m] of space on a storage section.
    pub(crate) fn note_space_request(
        &mut self,
        section: StorageSection,
        priority: WaitingPriority,
        needed: f64,
    ) {
        let Some(number) = self.numbers.of_section(section) else { return };
        let noted = &mut self.requested[number];
        if noted.is_none() {
            self.requested_on.push(number);
        }
        *noted = noted.filter(|(first, _)| *first < priority).or(Some((priority, needed)));
    }

    /// Space on `section` that is requested by another vehicle with a higher priority than `priority` [m].
    pub(crate) fn requested_before(&self, section: StorageSection, priority: WaitingPriority) -> f64 {
        let requested = self.numbers.of_section(section).and_then(|it| self.requested[it]);
        requested.filter(|(first, _)| *first < priority).map_or(0.0, |(_, needed)| needed)
    }

    /// Grants to `vehicle` what was surveyed, in addition to the reservation that it may have in `slot`. Returns its
    /// slot.
    pub(crate) fn grant(&mut self, slot: u32, vehicle: VehicleId, length: f64, survey: &Survey) -> u32 {
        let slot = if self.of(slot, vehicle).is_some() { slot } else { self.open(vehicle, length) };
        let reservation = &mut self.given[slot as usize];
        let base = reservation.travelled;
        reservation.extent = base + survey.extent;
        reservation.lacks_space = false;
        for hold in &survey.holds {
            let hold = ZoneReservation { enter: base + hold.enter, leave: base + hold.leave, ..*hold };
            reservation.holds.push(hold);
            self.queues[hold.zone.at()].push(Holder { slot, side: hold.side });
        }
        reservation.lights.extend(survey.lights.iter().map(|(light, at)| (*light, base + at)));
        // Where it kept space before, it no longer stops.
        for space in reservation.kept_spaces.drain(..) {
            self.kept[space.on] -= space.length;
        }
        if let Some(on) = self.numbers.of_section(survey.section) {
            let length = (survey.needed * CENTIMETRES).ceil() as u64;
            self.kept[on] += length;
            reservation.kept_spaces.push(KeptSpace { on, until: base + survey.extent, length });
        }
        slot
    }

    fn open(&mut self, vehicle: VehicleId, length: f64) -> u32 {
        let slot = self.free.pop().unwrap_or_else(|| {
            self.given.push(Reservation::default());
            self.given.len() as u32 - 1
        });
        let reservation = &mut self.given[slot as usize];
        reservation.vehicle = vehicle;
        reservation.is_given = true;
        reservation.length = length;
        reservation.travelled = 0.0;
        // Its last one may have ended before its lights.
        reservation.lights.clear();
        slot
    }

    /// The vehicle of the reservation in `slot` drove on by `distance` [m]. Its speed is now `speed`, and its desired
    /// speed `desired` [m/s].
    pub(crate) fn advance(&mut self, slot: u32, distance: f64, speed: f64, desired: f64) {
        let Reservations { given, queues, kept, .. } = self;
        let reservation = &mut given[slot as usize];
        reservation.travelled += distance;
        reservation.speed = speed;
        reservation.desired = desired;
        let travelled = reservation.travelled;
        reservation.holds.retain(|hold| {
            let is_over = hold.leave <= travelled;
            if is_over {
                leave_order(&mut queues[hold.zone.at()], slot, hold.side);
            }
            !is_over
        });
        reservation.kept_spaces.retain(|space| {
            let is_over = space.until <= travelled;
            if is_over {
                kept[space.on] -= space.length;
            }
            !is_over
        });
        reservation.lights.retain(|(_, at)| *at > travelled);
        if reservation.holds.is_empty() && reservation.kept_spaces.is_empty() {
            reservation.is_given = false;
            self.free.push(slot);
        }
    }

    /// Records that the driver of the reservation in `slot` first requested it in step `since`.
    pub(crate) fn note_since(&mut self, slot: u32, since: u32) {
        self.given[slot as usize].since = since;
    }

    /// Step in which the driver of the reservation in `slot` first requested it.
    pub(crate) fn since(&self, slot: u32) -> u32 {
        self.given[slot as usize].since
    }

    /// The vehicle of the reservation in `slot` goes in a wait cycle: whatever the lights show from now on, as other
    /// vehicles were granted reservations that rely on it, and before there is storage space for it.
    pub(crate) fn goes_in_wait_cycle(&mut self, slot: u32) {
        let reservation = &mut self.given[slot as usize];
        reservation.lights.clear();
        reservation.lacks_space = true;
    }

    /// Revokes the part of a reservation that lies beyond `distance` from its beginning [m].
    pub(crate) fn revoke(&mut self, slot: u32, distance: f64) {
        let Reservations { given, queues, kept, .. } = self;
        let reservation = &mut given[slot as usize];
        reservation.extent = reservation.extent.min(distance);
        reservation.holds.retain(|hold| {
            let stays = hold.enter < distance;
            if !stays {
                leave_order(&mut queues[hold.zone.at()], slot, hold.side);
            }
            stays
        });
        reservation.kept_spaces.retain(|space| {
            let stays = space.until < distance;
            if !stays {
                kept[space.on] -= space.length;
            }
            stays
        });
        reservation.lights.retain(|(_, at)| *at < distance);
        if reservation.holds.is_empty() && reservation.kept_spaces.is_empty() {
            reservation.is_given = false;
            self.free.push(slot);
        }
    }

    /// Revokes the reservation of a vehicle that is no longer on the road.
    pub(crate) fn end(&mut self, slot: u32, vehicle: VehicleId) {
        if self.of(slot, vehicle).is_some() {
            self.revoke(slot, f64::NEG_INFINITY);
        }
    }
}

/// Centimetres in a metre. Reserved space is counted in whole centimetres, so that the order of changes does not
/// matter.
const CENTIMETRES: f64 = 100.0;

fn leave_order(queue: &mut Vec<Holder>, slot: u32, side: u8) {
    if let Some(place) = queue.iter().position(|it| it.slot == slot && it.side == side) {
        queue.remove(place);
    }
}

impl Reservation {
    /// Whether its vehicle stands in the zone that `hold` is about.
    pub(crate) fn stands_in(&self, hold: &ZoneReservation) -> bool {
        self.speed < STANDSTILL && self.across(hold).is_some_and(|it| it.enter < self.travelled)
    }

    /// The length of it that remains in front of the vehicle [m].
    pub(crate) fn left(&self) -> f64 {
        self.extent - self.travelled
    }

    /// The length of it that remains in front of the vehicle, whatever lights more than `after` ahead [m] show [m].
    pub(crate) fn left_for_certain(&self, after: f64) -> f64 {
        let ends = self.lights.iter().map(|(_, line)| self.zone_over(*line).unwrap_or(*line).min(*line));
        let ends = ends.map(|it| it - self.travelled).filter(|it| *it > after.max(0.0));
        ends.fold(self.left(), f64::min)
    }

    /// Where the vehicle enters the first of the zones that it has not left at the `line` of a light [m], from the
    /// beginning of the reservation on. A vehicle that stops at the line has to stop for these zones, too.
    pub(crate) fn zone_over(&self, line: f64) -> Option<f64> {
        self.holds.iter().filter(|it| it.leave > line).map(|it| it.enter).reduce(f64::min)
    }

    /// Its reservation of the other side of the zone of `hold`.
    pub(crate) fn across(&self, hold: &ZoneReservation) -> Option<&ZoneReservation> {
        self.holds.iter().find(|it| it.zone == hold.zone && it.side != hold.side)
    }

    /// The lights that it passes, with the distances to the places where drivers stop for them [m].
    pub(crate) fn lights(&self) -> impl Iterator<Item = (LightIndex, f64)> {
        self.lights.iter().map(|(light, at)| (*light, at - self.travelled))
    }
}

#[cfg(test)]
mod tests;
