//! A vehicle is taken off the road before its trip ends.

use laneweave_network::Position;

use crate::junction::state::JunctionState;
use crate::record::log::Log;
use crate::route::roads::Roads;
use crate::state::lane::{Entry, Phase};
use crate::state::milestone::{Milestone, Reached};
use crate::state::traffic::Traffic;
use crate::view::scene::Spot;

/// Takes the vehicle with the main entry `spot` off the road.
pub(super) fn take_off(
    roads: &Roads,
    traffic: &mut Traffic,
    junctions: &mut JunctionState,
    log: &mut Log,
    spot: Spot,
) {
    let entry = traffic.lane_mut(spot.chain).remove(spot.index);
    let Entry { motion, driver, lane_change } = entry;
    if let Some(counterpart) = lane_change.counterpart {
        let lane = traffic.lane_mut(counterpart.chain);
        if let Some(index) = lane.find(motion.id, counterpart.x) {
            lane.remove(index);
        }
    }
    let (network, clock) = (roads.network(), traffic.clock());
    if driver.phase != Phase::Cruises {
        let milestone = Milestone {
            id: motion.id,
            record: lane_change.record,
            what: Reached::Nothing,
            at: Position::new(spot.chain, motion.x),
            shadow: None,
            speed: motion.speed,
        };
        log.note_milestone(network, &milestone, clock.time());
    }
    junctions.reservations_mut().end(lane_change.reservation, motion.id);
    traffic.leave();
    log.remove_trip(network, clock, spot.chain, &entry);
}
