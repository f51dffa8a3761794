//! Which lane of a roundabout a driver takes. Whoever leaves an inner lane crosses the outer one, so the outer lane is
//! for those who leave soon: drivers who turn right take it, those who turn left the inner one, and others either, as
//! signs before such roundabouts say (NCHRP Report 672, from memory).

use laneweave_network::{ChainIndex, Network, ZoneKind};

/// Time that a driver expects to lose on the outer lane at each arm that it passes, and where it leaves the inner lane
/// across the outer one [s] (ours).
const PASSES: f64 = 20.0;
const LEAVES: f64 = 20.0;

/// Time that a driver expects to lose on `chain` because the lanes of a roundabout cross there [s].
pub(crate) fn crossing_time(network: &Network, chain: ChainIndex) -> f64 {
    let junctions = &network.junctions;
    let comes_from_ring = |it: ChainIndex| {
        !junctions.is_in_roundabout(it)
            && network.chain(it).previous.iter().any(|it| junctions.is_in_roundabout(*it))
    };
    let crosses = |is_met: &dyn Fn(ChainIndex) -> bool| {
        junctions.on(chain).crossings.iter().any(|it| {
            let zone = &junctions.zones[it.zone.at()];
            zone.kind == ZoneKind::Crossing && is_met(zone.sides[usize::from(1 - it.side)].chain)
        })
    };
    if junctions.is_in_roundabout(chain) && crosses(&comes_from_ring) {
        PASSES
    } else if comes_from_ring(chain) && crosses(&|it| junctions.is_in_roundabout(it)) {
        LEAVES
    } else {
        0.0
    }
}
