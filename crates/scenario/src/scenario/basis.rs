//! What the demand of a run rests on, and what that says against the estimated capacity of its map.

use super::{Demand, Prepared};
use crate::capacity::Capacity;

/// Share of the estimated capacity that comes where nothing is said. Ours.
const USUAL_SHARE: f64 = 0.7;

/// What the demand of a run rests on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Basis {
    /// It is given.
    Given,
    /// Nothing is said, and it is a share of the estimated capacity.
    Estimated,
    /// Nothing is said, and the map has no estimated capacity.
    Usual,
}

impl Basis {
    /// Whether a scenario says nothing of how many come.
    pub(super) fn is_open(demand: &Demand) -> bool {
        demand.vehicles_per_hour.is_none() && demand.entrances.is_empty() && demand.od.is_empty()
    }
}

/// The demand where nothing is said [veh/h]; none without an estimate. Whole, so that it is the same on every machine.
pub(super) fn usual(capacity: &Capacity) -> Option<f64> {
    capacity.bottleneck.map(|_| (USUAL_SHARE * capacity.veh_h).round().max(1.0))
}

impl Prepared {
    /// What the demand is where nothing was said of it, in a line for the screen.
    pub fn demand_note(&self) -> Option<String> {
        let demand = self.demand_veh_h;
        match self.basis {
            Basis::Given => None,
            Basis::Estimated => {
                let share = 100.0 * USUAL_SHARE;
                Some(format!("demand: {demand:.0} veh/h, {share:.0} % of the {}", self.capacity))
            }
            Basis::Usual => Some(format!("demand: {demand:.0} veh/h; this map has no estimated capacity")),
        }
    }

    /// That the demand is above the estimated capacity, if it is, in a line for the screen.
    pub fn demand_warning(&self) -> Option<String> {
        let Prepared { demand_veh_h: demand, capacity, .. } = self;
        (capacity.bottleneck.is_some() && *demand > capacity.veh_h).then(|| {
            format!("demand: {demand:.0} veh/h is above the {capacity}: queues grow as long as this lasts")
        })
    }
}
