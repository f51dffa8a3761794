//! The basis of the demand of a run, and a comparison with the estimated capacity of its map.

use super::{Demand, Prepared};
use crate::capacity::Capacity;

/// Default demand as a share of the estimated capacity, and at most as a share of that from which on queues grow. Ours.
pub(super) const USUAL_SHARE: f64 = 0.63;
pub(super) const FULLEST: f64 = 0.8;

/// The basis of the demand of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Basis {
    /// The scenario gives it.
    Given,
    /// The scenario gives none, and it is a share of the estimated capacity.
    Estimated,
    /// The scenario gives none, and the map has no estimated capacity.
    Usual,
}

impl Basis {
    /// Whether a scenario gives no demand.
    pub(super) fn is_open(demand: &Demand) -> bool {
        demand.vehicles_per_hour.is_none() && demand.entrances.is_empty() && demand.od.is_empty()
    }
}

impl Prepared {
    /// The default demand in a line for the screen, if it is used.
    pub fn demand_note(&self) -> Option<String> {
        let demand = self.conditions.demand_veh_h;
        match self.conditions.basis {
            Basis::Given => None,
            Basis::Estimated => Some(format!("demand: {demand:.0} veh/h, {}", self.share_of_capacity())),
            Basis::Usual => Some(format!("demand: {demand:.0} veh/h; this map has no estimated capacity")),
        }
    }

    /// A warning for the screen if the demand is above the estimated capacity, in a line.
    pub fn demand_warning(&self) -> Option<String> {
        let (demand, Capacity { queues_from_veh_h, bottleneck, .. }) =
            (self.conditions.demand_veh_h, &*self.conditions.capacity);
        bottleneck.filter(|_| demand > *queues_from_veh_h).map(|it| {
            format!("demand: {demand:.0} veh/h is above {queues_from_veh_h:.0} veh/h: as long as this lasts, queues grow at {it}")
        })
    }

    /// The demand as a share of the estimated capacity, in words.
    pub(super) fn share_of_capacity(&self) -> String {
        let share = 100.0 * self.conditions.demand_veh_h / self.conditions.capacity.veh_h;
        format!("{share:.0} % of the {}", *self.conditions.capacity)
    }
}
