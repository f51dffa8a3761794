//! How full a town is, and its kerbs.

use laneweave_network::{ChainIndex, Sign};
use laneweave_sim::{Demand, Kerb, Metering, Place};

use super::{Bottleneck, Load, Roads, once};

/// The load of all roads that lead in rings: who drives on them takes up room as long as it is there (Little's law), at its desired
/// speed and before red lights.
pub(super) fn load(roads: &Roads) -> Option<Load> {
    let metering = Metering::new(roads.network)?;
    let taken: f64 = roads.chains().filter(|it| metering.is_town(*it)).map(|it| taken(roads, it)).sum();
    Some(Load { share: taken / metering.bearable(), of: Bottleneck::Town })
}

/// What all on a chain take up on average [m].
fn taken(roads: &Roads, chain: ChainIndex) -> f64 {
    let here = roads.network.chain(chain);
    let junctions = &roads.network.junctions;
    let parts = roads.assignment.on(chain).iter();
    let metres: f64 = parts.map(|it| it.flow * (it.to.min(here.length) - it.from)).sum();
    let waits = junctions.on(chain).stops.iter().map(|it| match it.sign {
        Sign::Light(light) => {
            let [_, flow] = roads.assignment.flow(chain, it.station);
            flow * junctions.lights[light.at()].program.mean_wait()
        }
        Sign::Stop | Sign::Line => 0.0,
    });
    let waiting: f64 = waits.sum();
    let mixture = roads.mixture(here.limit(0.0));
    mixture.mean_of(|length, desired| Metering::taken_by(length) * (metres / desired + waiting))
}

/// The loads of kerbs: who starts from one makes room for the next.
pub(super) fn kerb_loads(roads: &Roads, demand: &Demand) -> Vec<Load> {
    let mut known: Vec<(f64, f64)> = Vec::new();
    let kerbs = demand.origins.iter().filter_map(|it| match &it.place {
        Place::Kerb(kerb) => Some(kerb),
        Place::Gate(_) => None,
    });
    let load = |kerb: &Kerb| {
        let limit = roads.network.chain(kerb.chain).limit(kerb.station);
        let flow = once(&mut known, limit, || roads.mixture(limit).starts());
        let starts = roads.assignment.on(kerb.chain).iter().filter(|it| it.from == kerb.station);
        Load { share: starts.map(|it| it.flow).sum::<f64>() / flow, of: Bottleneck::Kerb(kerb.id) }
    };
    kerbs.map(load).collect()
}
