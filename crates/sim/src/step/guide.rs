//! Guidance of drivers.

use crate::demand::arrivals::Arrivals;
use crate::route::roads::Roads;
use crate::state::traffic::Traffic;

/// Measures travel times and plans routes, if drivers are guided.
pub(crate) fn guide(roads: &mut Roads, traffic: &Traffic, arrivals: &Arrivals) {
    roads.go_on_guiding(traffic.lanes(), &arrivals.demand().destinations, traffic.clock());
}
