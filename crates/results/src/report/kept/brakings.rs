//! Where vehicles brake hard, and what for.

use laneweave_network::Id;
use std::collections::BTreeMap;

use laneweave_sim::{BrakingCause, DrivingEventKind, Event, World};
use serde::{Deserialize, Serialize};

/// Hard brakings by place and cause.
#[derive(Debug, Default, Serialize, Deserialize)]
pub(crate) struct HardBrakings {
    /// By lanelet, the counts in the order of [`BrakingCause::ALL`].
    places: BTreeMap<Id, [u64; BrakingCause::ALL.len()]>,
}

impl HardBrakings {
    /// Observes the world after a step.
    pub(super) fn observe(&mut self, world: &World) {
        for event in world.events() {
            let Event::Driving(event) = event else { continue };
            let DrivingEventKind::HardBraking(cause) = event.kind else { continue };
            let lanelet = world.network().lanelet_at(event.at).0.id;
            let place = BrakingCause::ALL.iter().position(|it| *it == cause);
            if let Some(count) = place.and_then(|it| self.places.entry(lanelet).or_default().get_mut(it)) {
                *count += 1;
            }
        }
    }

    /// The lanelets with most of them, at most `most`, each with its counts by cause; of equal ones the lower id first.
    pub(crate) fn worst(&self, most: usize) -> Vec<(Id, [u64; BrakingCause::ALL.len()])> {
        let mut places: Vec<_> = self.places.iter().map(|(lanelet, counts)| (*lanelet, *counts)).collect();
        places.sort_by_key(|(lanelet, counts)| (std::cmp::Reverse(counts.iter().sum::<u64>()), *lanelet));
        places.truncate(most);
        places
    }
}
