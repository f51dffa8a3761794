//! Incidents are counted and told.

use crate::driver::plan::Outbox;
use crate::record::log::Log;
use crate::step::work::Work;

/// Counts and tells who came to touch each other; if all were `watched`, who was not seen to no longer does.
pub(crate) fn note_incidents(log: &mut Log, work: &mut Work, watched: bool) {
    let Outbox { incidents, counters, .. } = work.outbox();
    log.note_incidents(incidents, counters, watched);
}
