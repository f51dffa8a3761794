//! Traffic at lights, and as how many vehicles those count that turn across oncoming traffic at green.

use std::collections::BTreeMap;

use laneweave_network::{ChainIndex, LaneFlows, LightTraffic, Network, Position, Sign};
use laneweave_sim::Assignment;

use super::queues::Queues;

/// As how many vehicles that go straight on a vehicle counts, by chain and light line on it [m].
#[derive(Default)]
pub(super) struct Equivalents(BTreeMap<ChainIndex, Vec<(f64, f64)>>);

impl Equivalents {
    /// At the line nearest to a station of a chain [m]; 1 without any.
    pub(super) fn at(&self, chain: ChainIndex, station: f64) -> f64 {
        let lines = self.0.get(&chain).into_iter().flatten();
        let nearest = lines.min_by(|a, b| (a.0 - station).abs().total_cmp(&(b.0 - station).abs()));
        nearest.map_or(1.0, |it| it.1)
    }
}

/// What `of` finds for the flows of `assignment`, `growth` times as large.
pub(crate) fn with_traffic<T>(
    network: &Network,
    assignment: &Assignment,
    queues: &Queues,
    growth: f64,
    of: impl FnOnce(&LightTraffic) -> T,
) -> T {
    let flow = |at: Position| growth * assignment.flow(at.chain, at.x)[1];
    let saturation = |at: Position| queues.stream(network.chain(at.chain).limit(at.x), 0.0);
    of(&LightTraffic { flow: &flow, saturation: &saturation })
}

/// The equivalents for the flows of `assignment`, so many times as large that the first light is full.
pub(super) fn equivalents(network: &Network, assignment: &Assignment, queues: &Queues) -> Equivalents {
    const HALVINGS: u32 = 30;
    let lanes = with_traffic(network, assignment, queues, 1.0, |it| network.lights().lane_flows(it));
    // The share of the time that each light gives.
    let share = |it: &LaneFlows| {
        let Position { chain, x } = it.line;
        let light = network.junctions.on(chain).stops.iter().find_map(|it| match it.sign {
            Sign::Light(light) if it.station == x => Some(light),
            _ => None,
        })?;
        let program = &network.junctions.lights[light.at()].program;
        Some(queues.through(program, network.chain(chain).limit(x)) / it.saturation)
    };
    let used = lanes.iter().filter(|it| it.flow > 0.0);
    let lit: Vec<(&LaneFlows, f64)> = used.filter_map(|it| Some((it, share(it)?))).collect();
    let is_full = |growth: f64| lit.iter().any(|(it, share)| it.ratio(growth) > *share);
    let straight_on = lit.iter().map(|(it, share)| share * it.saturation / it.flow);
    let (mut low, mut high) = (0.0, straight_on.fold(f64::INFINITY, f64::min));
    if high < f64::INFINITY {
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if is_full(middle) { high = middle } else { low = middle }
        }
    }
    let mut by_chain: BTreeMap<ChainIndex, Vec<(f64, f64)>> = BTreeMap::new();
    for (it, _) in &lit {
        let equivalents = it.ratio(low) * it.saturation / (low * it.flow);
        by_chain.entry(it.line.chain).or_default().push((it.line.x, equivalents));
    }
    Equivalents(by_chain)
}
