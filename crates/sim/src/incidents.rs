//! Incidents: two vehicles come to touch each other. Each is told once, for as long as they do.

use laneweave_network::{ChainIndex, Point};
use serde::{Deserialize, Serialize};

use crate::events::Event;
use crate::plan::Outbox;
use crate::traffic::VehicleId;
use crate::vehicle::Class;
use crate::world::World;

/// Two vehicles whose rectangles come to intersect by more than 5 cm.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Incident {
    /// What it is.
    pub kind: IncidentKind,
    /// When it was seen [s].
    pub time: f64,
    /// Who, the smaller id first.
    pub vehicles: [VehicleId; 2],
    /// Their characters' places in the table.
    pub characters: [u32; 2],
    /// Their classes.
    pub classes: [Class; 2],
    /// Chain and front bumper of each [m].
    pub places: [(ChainIndex, f64); 2],
    /// Halfway between their centres.
    pub at: Point,
    /// Their speeds [m/s].
    pub speeds: [f64; 2],
    /// How deep they intersect [m].
    pub depth: f64,
}

/// Kinds of incidents.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum IncidentKind {
    /// One touches the other on its way, or they meet while they come closer to each other.
    Collision,
    /// Any other.
    Overlap,
}

impl IncidentKind {
    /// Its name in tables.
    pub fn name(self) -> &'static str {
        match self {
            IncidentKind::Collision => "collision",
            IncidentKind::Overlap => "overlap",
        }
    }
}

/// The pairs of vehicles that touched when it was last looked.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Touching(Vec<[VehicleId; 2]>);

impl World {
    /// Counts and tells who came to touch each other; if all were `watched`, who was not seen to no longer does.
    pub(crate) fn note_incidents(&mut self, watched: bool) {
        let World { touching: Touching(touching), outboxes, events, counts, .. } = self;
        let Outbox { incidents, tally, .. } = &mut outboxes[0];
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
