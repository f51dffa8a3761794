//! Incidents are counted and reported.

use crate::driver::plan::Outbox;
use crate::record::log::Log;
use crate::step::work::Work;

/// Counts and reports vehicles that begin to touch. If all were `watched`, the pairs that were not seen no longer
/// touch.
pub(crate) fn note_incidents(log: &mut Log, work: &mut Work, watched: bool) {
    let Outbox { incidents, counters, .. } = work.outbox();
    log.note_incidents(incidents, counters, watched);
}
