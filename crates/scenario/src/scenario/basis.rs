//! The basis of the demand of a run, and a comparison with the estimated capacity of its map.

use super::{Demand, Prepared};

/// Default demand as a share of the estimated capacity. Ours.
pub(super) const USUAL_SHARE: f64 = 0.7;

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
        let demand = self.demand_veh_h;
        match self.basis {
            Basis::Given => None,
            Basis::Estimated => {
                let share = 100.0 * USUAL_SHARE;
                Some(format!("demand: {demand:.0} veh/h, {share:.0} % of the {}", *self.capacity))
            }
            Basis::Usual => Some(format!("demand: {demand:.0} veh/h; this map has no estimated capacity")),
        }
    }

    /// A warning for the screen if the demand is above the estimated capacity, in a line.
    pub fn demand_warning(&self) -> Option<String> {
        let (demand, capacity) = (&self.demand_veh_h, &*self.capacity);
        (capacity.bottleneck.is_some() && *demand > capacity.veh_h).then(|| {
            format!("demand: {demand:.0} veh/h is above the {capacity}: queues grow as long as this lasts")
        })
    }
}
