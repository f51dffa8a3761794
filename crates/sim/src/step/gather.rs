//! Gathers from all threads what concerns more than one lane.

use crate::record::log::Log;
use crate::state::traffic::Traffic;
use crate::step::work::Work;

/// Gathers the outboxes of all threads, reports driving events, and forgets empty lanes.
pub(crate) fn gather(traffic: &mut Traffic, log: &mut Log, work: &mut Work) {
    let [first, others @ ..] = &mut work.outboxes[..] else { return };
    others.iter_mut().for_each(|it| first.gather(it));
    // Both entries of a vehicle between two lanes may report the same event.
    first.driving.sort_unstable_by_key(|it| (it.vehicle, it.kind.rank(), it.at.x.to_bits(), it.at.chain));
    first.driving.drain(..).for_each(|it| log.note_driving(it));
    first.empty.drain(..).for_each(|it| traffic.forget(it));
}
