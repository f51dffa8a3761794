//! Counts of a run.

use crate::record::desire_situations::DesireSituation;
use serde::{Deserialize, Serialize};

/// Counters. Each thread has its own ones, and each lane counts its own distances. So the sums do not depend on the
/// distribution of the work.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Counters {
    /// Times that a driver considered lanes.
    pub considerations: u64,
    /// Considerations by drivers on a free road.
    pub free_considerations: u64,
    /// Desires that came in these considerations.
    pub free_desires: u64,
    /// Considerations by drivers held up beside a free lane.
    pub held_up_considerations: u64,
    /// Desires that came in these considerations.
    pub held_up_desires: u64,
    /// Vehicles moved, summed over steps.
    pub updates: u64,
    /// Distance driven [m].
    pub distance: f64,
    /// Braking events that kinematics, not the model, decided.
    pub emergency_brakings: u64,
    /// Times that a vehicle began to brake with more than 4 m/s².
    pub hard_brakings: u64,
    /// Times that a vehicle began to touch the one ahead of it, or that two vehicles began to overlap while they
    /// approached each other.
    pub collisions: u64,
    /// Other times that two vehicles began to overlap.
    pub overlaps: u64,
    /// Vehicles that stood for 300 s.
    pub stuck: u64,
    /// Drivers who passed the last place for a change and did not reach a lane of their route.
    pub missed_turns: u64,
    /// Drivers who had no route left to any destination.
    pub lost: u64,
    /// Times that a driver left its route for a better one.
    pub route_changes: u64,
}

impl Counters {
    /// Counts a consideration of a driver in `situation`, and whether the desire came.
    #[inline]
    pub(crate) fn count_desire(&mut self, situation: Option<DesireSituation>, has_come: bool) {
        let (considerations, desires) = match situation {
            None => return,
            Some(DesireSituation::Free) => (&mut self.free_considerations, &mut self.free_desires),
            Some(DesireSituation::HeldUp) => (&mut self.held_up_considerations, &mut self.held_up_desires),
        };
        *considerations += 1;
        *desires += u64::from(has_come);
    }

    /// Adds `other`.
    pub fn add(&mut self, other: &Counters) {
        let Counters {
            considerations,
            free_considerations,
            free_desires,
            held_up_considerations,
            held_up_desires,
            updates,
            distance,
            emergency_brakings,
            hard_brakings,
            collisions,
            overlaps,
            stuck,
            missed_turns,
            lost,
            route_changes,
        } = other;
        self.considerations += considerations;
        self.free_considerations += free_considerations;
        self.free_desires += free_desires;
        self.held_up_considerations += held_up_considerations;
        self.held_up_desires += held_up_desires;
        self.updates += updates;
        self.distance += distance;
        self.emergency_brakings += emergency_brakings;
        self.hard_brakings += hard_brakings;
        self.collisions += collisions;
        self.overlaps += overlaps;
        self.stuck += stuck;
        self.missed_turns += missed_turns;
        self.lost += lost;
        self.route_changes += route_changes;
    }
}
