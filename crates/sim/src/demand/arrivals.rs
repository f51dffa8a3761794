//! Who comes, and who waits to enter.

use crate::demand::Demand;
use crate::demand::metering::Metering;
use crate::demand::source::Source;
use crate::route::roads::Roads;
use crate::state::traffic::VehicleId;

/// Demand, and the queues of those who have come by it.
pub(crate) struct Arrivals {
    pub(crate) demand: Demand,
    /// By origin of the demand.
    pub(crate) sources: Vec<Source>,
    /// Where roads lead in rings.
    pub(crate) metering: Option<Metering>,
    pub(crate) next_id: VehicleId,
}

impl Arrivals {
    /// Nobody has come yet.
    pub(crate) fn new(roads: &Roads, demand: Demand) -> Arrivals {
        let sources = Source::all(&roads.network, &roads.navigator, &demand, &roads.random);
        Arrivals { demand, sources, metering: Metering::new(&roads.network), next_id: 0 }
    }
}
