//! A lane change ends where it is: its vehicle is in one lane again.

use laneweave_network::{Network, Position};

use crate::record::log::Log;
use crate::state::lane::Phase;
use crate::state::milestone::{Milestone, Reached};
use crate::state::traffic::Traffic;
use crate::view::scene::Spot;

/// Ends the desired or current lane change of the vehicle with the main entry `spot`. It is not recorded.
pub(super) fn end_change(network: &Network, traffic: &mut Traffic, log: &mut Log, spot: Spot) {
    let (motion, driver, lane_change) = traffic.lane_mut(spot.chain).entry_mut(spot.index);
    if driver.phase == Phase::Cruises {
        return;
    }
    let milestone = Milestone {
        id: motion.id,
        record: lane_change.record,
        what: Reached::Nothing,
        at: Position::new(spot.chain, motion.x),
        shadow: None,
        speed: motion.speed,
    };
    driver.phase = Phase::Cruises;
    lane_change.progress = 0.0;
    if let Some(counterpart) = lane_change.counterpart.take() {
        let lane = traffic.lane_mut(counterpart.chain);
        if let Some(index) = lane.find(milestone.id, counterpart.x) {
            lane.remove(index);
        }
    }
    log.note_milestone(network, &milestone, traffic.clock().time());
}
