//! Vehicles pass from chain to chain, and leave the map.

use laneweave_network::{ChainIndex, Position};

use crate::driver::plan::Outbox;
use crate::junction::state::JunctionState;
use crate::record::log::Log;
use crate::route::roads::Roads;
use crate::state::lane::{Counterpart, Entry, Phase};
use crate::state::milestone::{Milestone, Reached};
use crate::state::traffic::Traffic;
use crate::step::work::Work;

/// Entries whose trips ended leave. Entries that passed the ends of their chains go on, or leave the map.
pub(crate) fn transfer(
    roads: &Roads,
    traffic: &mut Traffic,
    junctions: &mut JunctionState,
    log: &mut Log,
    work: &mut Work,
) {
    let mut transfer = Transfer { roads, traffic, junctions, log };
    let Outbox { leaving, arrived, .. } = work.outbox();
    transfer.end_trips(arrived, leaving);
    // A vehicle's main entry comes before its shadow.
    leaving.sort_unstable_by_key(|(_, it)| (it.motion.id, it.driver.is_shadow));
    let mut index = 0;
    while index < leaving.len() {
        let (from, mut entry) = leaving[index];
        index += 1;
        let onto = place_beyond(roads, from, &entry);
        let own_shadow = leaving.get(index).filter(|(_, it)| it.motion.id == entry.motion.id);
        if let Some((shadow_from, mut shadow)) = own_shadow.copied() {
            index += 1;
            let shadow_onto = place_beyond(roads, shadow_from, &shadow);
            entry.lane_change.counterpart = relocated(entry.lane_change.counterpart, shadow_onto);
            shadow.lane_change.counterpart = relocated(shadow.lane_change.counterpart, onto);
            if onto.is_some() && shadow_onto.is_some() {
                transfer.go_on_or_leave(shadow_from, shadow_onto, shadow);
            }
        }
        transfer.go_on_or_leave(from, onto, entry);
    }
    leaving.clear();
}

/// Position of an entry that passed the end of its chain.
fn place_beyond(roads: &Roads, from: ChainIndex, entry: &Entry) -> Option<Position> {
    let next = roads.navigator().next(roads.network(), entry.driver.goal.destination(), from)?;
    Some(Position::new(next, entry.motion.x - roads.network().chain(from).length))
}

/// What a vehicle that passes the end of its chain changes.
struct Transfer<'a> {
    roads: &'a Roads,
    traffic: &'a mut Traffic,
    junctions: &'a mut JunctionState,
    log: &'a mut Log,
}

impl Transfer<'_> {
    /// Entries whose trips ended leave, with their shadows. The shadows may just have passed the ends of their own
    /// chains.
    fn end_trips(&mut self, arrived: &mut Vec<(ChainIndex, Entry)>, leaving: &mut Vec<(ChainIndex, Entry)>) {
        arrived.sort_unstable_by_key(|(_, it)| it.motion.id);
        if !arrived.is_empty() {
            let is_gone = |id| arrived.binary_search_by_key(&id, |(_, it)| it.motion.id).is_ok();
            leaving.retain(|(_, it)| !is_gone(it.motion.id));
        }
        arrived.drain(..).for_each(|(chain, entry)| self.leave(chain, entry));
    }

    fn go_on_or_leave(&mut self, from: ChainIndex, onto: Option<Position>, entry: Entry) {
        match onto {
            Some(onto) => self.go_on(from, onto, entry),
            None => self.leave(from, entry),
        }
    }

    fn go_on(&mut self, from: ChainIndex, onto: Position, mut entry: Entry) {
        let network = self.roads.network();
        if !entry.driver.is_shadow {
            self.log.go_on(network, self.traffic.clock(), from, &entry);
        }
        entry.motion.x = onto.x;
        entry.lane_change.last_place -= network.chain(from).length;
        entry.lane_change.previous_lanes = entry.lane_change.previous_lanes.left(from);
        let Entry { motion, driver, .. } = &mut entry;
        let outlook = self.roads.outlook(driver);
        let ahead = outlook.until_turn(onto, motion.speed, driver.due, self.traffic.clock());
        driver.limit_desired = ahead.min(outlook.leaving_speed(Some(from), onto.x));
        self.tell_counterpart(&entry, Some(onto));
        self.traffic.insert(onto.chain, entry);
    }

    /// A main entry leaves the map. A shadow in a lane that ends is no longer needed.
    fn leave(&mut self, from: ChainIndex, entry: Entry) {
        let Entry { motion, driver, lane_change } = entry;
        if driver.is_shadow {
            self.tell_counterpart(&entry, None);
            return;
        }
        if let Some(counterpart) = lane_change.counterpart {
            let lane = self.traffic.lane_mut(counterpart.chain);
            if let Some(index) = lane.find(motion.id, counterpart.x) {
                lane.remove(index);
            }
        }
        let (network, clock) = (self.roads.network(), self.traffic.clock());
        if driver.phase != Phase::Cruises {
            let is_across = driver.phase == Phase::Changes && lane_change.progress >= 0.5;
            let milestone = Milestone {
                id: motion.id,
                record: lane_change.record,
                what: if is_across { Reached::End } else { Reached::Nothing },
                at: Position::new(from, motion.x),
                shadow: None,
                speed: motion.speed,
            };
            self.log.note_milestone(network, &milestone, clock.time());
        }
        self.junctions.reservations_mut().end(lane_change.reservation, motion.id);
        self.traffic.leave();
        self.log.end_trip(network, clock, from, &entry);
    }

    /// Tells the other entry of a vehicle the position of this one.
    fn tell_counterpart(&mut self, entry: &Entry, now: Option<Position>) {
        let Some(counterpart) = entry.lane_change.counterpart else { return };
        let lane = self.traffic.lane_mut(counterpart.chain);
        if let Some(index) = lane.find(entry.motion.id, counterpart.x) {
            let other = lane.entry_mut(index).2;
            other.counterpart = relocated(other.counterpart, now);
        }
    }
}

/// The counterpart at its new position, if it still has one.
fn relocated(counterpart: Option<Counterpart>, place: Option<Position>) -> Option<Counterpart> {
    let Position { chain, x } = place?;
    counterpart.map(|old| Counterpart { chain, x, ..old })
}
