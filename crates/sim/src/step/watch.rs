//! Incidents are counted and told.

use crate::driver::plan::Outbox;
use crate::record::events::Event;
use crate::record::incidents::{Incident, IncidentKind, Touching};
use crate::record::log::Log;
use crate::step::world::World;

impl World {
    /// Counts and tells who came to touch each other; if all were `watched`, who was not seen to no longer does.
    pub(crate) fn note_incidents(&mut self, watched: bool) {
        let Log { touching: Touching(touching), events, counts, .. } = &mut self.log;
        let Outbox { incidents, tally, .. } = &mut self.work.outboxes[0];
        // Of what is seen from both sides the graver counts.
        let gravity = |it: &Incident| it.kind == IncidentKind::Overlap;
        incidents.sort_unstable_by(|a, b| {
            a.vehicles.cmp(&b.vehicles).then(gravity(a).cmp(&gravity(b))).then(b.depth.total_cmp(&a.depth))
        });
        incidents.dedup_by_key(|it| it.vehicles);
        for incident in incidents.iter() {
            let Err(place) = touching.binary_search(&incident.vehicles) else { continue };
            touching.insert(place, incident.vehicles);
            match incident.kind {
                IncidentKind::Collision => tally.collisions += 1,
                IncidentKind::Overlap => tally.overlaps += 1,
            }
            counts.first_incident.get_or_insert(*incident);
            events.push(Event::Incident(*incident));
        }
        if watched {
            touching.retain(|pair| incidents.binary_search_by_key(pair, |it| it.vehicles).is_ok());
        }
        incidents.clear();
    }
}
