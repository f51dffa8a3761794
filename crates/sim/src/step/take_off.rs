//! A vehicle is taken off the road before its trip ends.

use laneweave_network::ChainIndex;

use crate::junction::state::JunctionState;
use crate::record::log::Log;
use crate::route::roads::Roads;
use crate::state::lane::Entry;
use crate::state::traffic::Traffic;
use crate::step::end_change::end_change;
use crate::view::scene::Spot;

/// Takes the vehicle with the main entry `spot` off the road.
pub(super) fn take_off(
    roads: &Roads,
    traffic: &mut Traffic,
    junctions: &mut JunctionState,
    log: &mut Log,
    spot: Spot,
) {
    end_change(roads.network(), traffic, log, spot);
    let entry = traffic.lane_mut(spot.chain).remove(spot.index);
    traffic.leave();
    end_trip(roads, traffic, junctions, log, spot.chain, &entry);
}

/// Ends the trip of the vehicle of `entry`, which is in no lane any more. The last one was `chain`.
pub(super) fn end_trip(
    roads: &Roads,
    traffic: &Traffic,
    junctions: &mut JunctionState,
    log: &mut Log,
    chain: ChainIndex,
    entry: &Entry,
) {
    junctions.reservations_mut().end(entry.lane_change.reservation, entry.motion.id);
    log.remove_trip(roads.network(), traffic.clock(), chain, entry);
}
