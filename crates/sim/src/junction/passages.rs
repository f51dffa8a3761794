//! The passages that were given, the order in each zone, and who waits for one.

use laneweave_network::{LightIndex, Network, ZoneIndex};
use serde::{Deserialize, Serialize};

use crate::junction::claim::Turn;
use crate::junction::claim::{Claim, Hold};
use crate::junction::need::Survey;
use crate::junction::refuge::{Numbers, Refuge};
use crate::junction::rings::Rings;
use crate::state::clock::Clock;
use crate::state::traffic::VehicleId;

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

    /// The vehicle of the passage in `slot` goes, whatever lights show from now on: others have been let go because it does.
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

    /// Where the vehicle enters the first of the zones that it has not left at the `line` of a light: who stops at the line has to stop
    /// for these, too. From the beginning of the passage on [m].
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
mod tests {
    use laneweave_network::ChainIndex;

    use super::*;

    const LENGTH: f64 = 4.5;
    const ZONE: ZoneIndex = ZoneIndex(0);
    const REFUGE: Refuge = Refuge::first_of(ChainIndex(0));

    /// Passages of a network with one zone, and one chain beyond it.
    fn of_one_zone() -> Passages {
        Passages {
            queues: vec![Vec::new()],
            claims: vec![[None; 2]],
            numbers: Numbers::of_chains(1),
            kept: vec![0],
            ..Passages::default()
        }
    }

    /// Over the zone from 10 m to 15 m ahead, with a light at 8 m, to a place beyond it.
    fn over_the_zone(side: u8) -> Survey {
        Survey {
            lights: vec![(LightIndex(0), 8.0)],
            holds: vec![Hold { zone: ZONE, side, enter: 10.0, leave: 15.0 + LENGTH }],
            extent: 15.0 + LENGTH,
            needed: LENGTH + 2.0,
            ..Survey::default()
        }
    }

    fn order(passages: &Passages) -> Vec<VehicleId> {
        passages.order(ZONE).map(|(_, passage)| passage.vehicle).collect()
    }

    #[test]
    fn who_was_given_a_passage_first_goes_first_until_its_rear_has_left_the_zone() {
        let mut passages = of_one_zone();
        let first = passages.give(NO_PASSAGE, 7, LENGTH, &over_the_zone(0));
        passages.give(NO_PASSAGE, 3, LENGTH, &over_the_zone(1));
        assert_eq!(order(&passages), [7, 3]);
        passages.advance(first, 19.4, 10.0, 14.0);
        assert_eq!(order(&passages), [7, 3]);
        passages.advance(first, 0.1, 10.0, 14.0);
        assert_eq!(order(&passages), [3]);
        assert!(passages.of(first, 7).is_none());
    }

    #[test]
    fn room_is_kept_beyond_the_zone_until_the_vehicle_is_there() {
        let mut passages = of_one_zone();
        let slot = passages.give(NO_PASSAGE, 7, LENGTH, &over_the_zone(0));
        passages.give(NO_PASSAGE, 3, LENGTH, &over_the_zone(0));
        assert_eq!(passages.kept_on(REFUGE), 13.0);
        passages.advance(slot, 19.5, 10.0, 14.0);
        assert_eq!(passages.kept_on(REFUGE), 6.5);
    }

    #[test]
    fn a_passage_can_be_given_back_from_a_place_on() {
        let mut passages = of_one_zone();
        let slot = passages.give(NO_PASSAGE, 7, LENGTH, &over_the_zone(0));
        passages.advance(slot, 2.0, 10.0, 14.0);
        assert_eq!(passages.of(slot, 7).map(Passage::left), Some(17.5));
        // Beyond where it enters the zone it keeps the zone, and gives back the room.
        passages.take_back(slot, 12.0);
        assert_eq!(order(&passages), [7]);
        assert_eq!(passages.of(slot, 7).map(Passage::left), Some(10.0));
        assert_eq!(passages.kept_on(REFUGE), 0.0);
        passages.take_back(slot, 8.0);
        assert!(order(&passages).is_empty() && passages.of(slot, 7).is_none());
    }

    #[test]
    fn what_a_light_can_take_back_is_not_certain() {
        let mut passages = of_one_zone();
        let left = |it: &Passages, slot| it.of(slot, 7).map(Passage::left_for_certain);
        let slot = passages.give(NO_PASSAGE, 7, LENGTH, &over_the_zone(0));
        assert_eq!(left(&passages, slot), Some(8.0));
        passages.advance(slot, 8.0, 10.0, 14.0);
        assert_eq!(left(&passages, slot), Some(11.5));
        passages.end(slot, 7);
        // Before a line within the zone one stops where the zone begins, and within it no more.
        let within = Survey { lights: vec![(LightIndex(0), 12.0)], ..over_the_zone(0) };
        let slot = passages.give(NO_PASSAGE, 7, LENGTH, &within);
        assert_eq!(left(&passages, slot), Some(10.0));
        passages.advance(slot, 10.0, 10.0, 14.0);
        assert_eq!(left(&passages, slot), Some(9.5));
        passages.end(slot, 7);
        let slot = passages.give(NO_PASSAGE, 7, LENGTH, &within);
        passages.make_certain(slot);
        assert_eq!(left(&passages, slot), Some(19.5));
    }

    #[test]
    fn the_passage_of_who_leaves_the_road_ends_and_its_slot_is_used_again() {
        let mut passages = of_one_zone();
        let slot = passages.give(NO_PASSAGE, 7, LENGTH, &over_the_zone(0));
        // Not of somebody else.
        passages.end(slot, 8);
        assert_eq!(order(&passages), [7]);
        passages.end(slot, 7);
        assert!(order(&passages).is_empty());
        assert_eq!(passages.kept_on(REFUGE), 0.0);
        assert_eq!(passages.give(slot, 9, LENGTH, &over_the_zone(1)), slot);
        assert!(passages.of(slot, 7).is_none() && passages.of(slot, 9).is_some());
    }

    #[test]
    fn room_comes_first_to_who_has_waited_for_it_longest() {
        let claim = |since, id| Claim { is_patient: false, since, id, is_long: false };
        let mut passages = Passages { wanted: vec![None], ..of_one_zone() };
        passages.note_want(REFUGE, claim(20, 1), 6.5);
        passages.note_want(REFUGE, claim(10, 2), 14.0);
        passages.note_want(REFUGE, claim(30, 3), 6.5);
        assert_eq!(passages.wanted_before(REFUGE, claim(20, 1)), 14.0);
        assert_eq!(passages.wanted_before(REFUGE, claim(10, 2)), 0.0);
        passages.clear_claims();
        assert_eq!(passages.wanted_before(REFUGE, claim(20, 1)), 0.0);
    }

    #[test]
    fn a_further_passage_goes_on_from_where_the_vehicle_is() {
        let mut passages = of_one_zone();
        let slot = passages.give(NO_PASSAGE, 7, LENGTH, &over_the_zone(0));
        passages.advance(slot, 9.0, 10.0, 14.0);
        assert_eq!(passages.give(slot, 7, LENGTH, &over_the_zone(1)), slot);
        let passage = passages.of(slot, 7).expect("it was given");
        assert_eq!(passage.left(), 19.5);
        assert_eq!(passage.holds.iter().map(|it| it.enter).collect::<Vec<_>>(), [10.0, 19.0]);
        // The light of the first is passed.
        assert_eq!(passage.lights().collect::<Vec<_>>(), [(LightIndex(0), 8.0)]);
    }

    #[test]
    fn of_those_who_wait_on_one_side_the_impatient_then_the_longest_waiting_claims_the_turn() {
        let claim = |is_patient, since, id| Claim { is_patient, since, id, is_long: false };
        let turn = |claim| Turn { claim, begins: 2.0 };
        let mut passages = of_one_zone();
        for it in [claim(true, 20, 1), claim(true, 10, 3), claim(true, 10, 2), claim(true, 30, 0)] {
            passages.note_claim(ZONE, 0, turn(it));
        }
        assert_eq!(passages.claim(ZONE, 0), Some(turn(claim(true, 10, 2))));
        assert_eq!(passages.claim(ZONE, 1), None);
        passages.note_claim(ZONE, 0, turn(claim(false, 40, 9)));
        assert_eq!(passages.claim(ZONE, 0), Some(turn(claim(false, 40, 9))));
        passages.clear_claims();
        assert_eq!(passages.claim(ZONE, 0), None);
    }
}
