//! The loads of a town core, and of places inside the map.

use laneweave_network::{ChainIndex, Light, Position, Sign};
use laneweave_sim::{InnerPlace, PerimeterControl};

use super::conflict::{Approach, approaches};
use super::delay;
use super::movement::Movement;
use super::{Bottleneck, Load, Roads};

/// The load of the town core, all roads that form loops, if they are full before all flows are `most` times as large.
/// Each vehicle on them takes up length as long as it is there (Little's law), at its desired speed and with the
/// delays at lights and junctions, which grow with the flows.
pub(super) fn load(roads: &Roads, movements: &[Movement], most: f64) -> Option<Load> {
    const HALVINGS: u32 = 40;
    let perimeter = PerimeterControl::new(roads.network)?;
    let town = Town::new(roads, &perimeter, movements);
    let is_full = |growth: f64| town.taken(growth) > perimeter.most_taken();
    let (mut low, mut high) = (0.0, most);
    if !is_full(high) {
        return None;
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if is_full(middle) { high = middle } else { low = middle }
    }
    Some(Load::new(1.0 / high, Bottleneck::Town, Vec::new()))
}

/// The vehicles in a town, and their delays.
struct Town<'a> {
    movements: &'a [Movement],
    /// Length that driving vehicles take up, without delays [m].
    driving: f64,
    /// Mean length that a vehicle takes up [m].
    room: f64,
    lit: Vec<Lit<'a>>,
    approaches: Vec<Approach>,
}

/// The traffic at a light.
struct Lit<'a> {
    light: &'a Light,
    /// Demand and capacity [veh/s].
    flow: f64,
    capacity: f64,
}

impl<'a> Town<'a> {
    fn new(roads: &Roads<'a>, perimeter: &PerimeterControl, movements: &'a [Movement]) -> Town<'a> {
        let (mut driving, mut lit) = (0.0, Vec::new());
        for chain in roads.chains().filter(|it| perimeter.is_core(*it)) {
            driving += driving_on(roads, chain);
            for stop in &roads.network.junctions.on(chain).stops {
                let Sign::Light(light) = stop.sign else { continue };
                let [_, flow] = roads.assignment.flow(chain, stop.station);
                let limit = roads.network.chain(chain).limit(stop.station);
                let it = &roads.network.junctions.lights[light.at()];
                let capacity = roads.queues.through(&it.program, limit);
                lit.push(Lit { light: it, flow, capacity });
            }
        }
        let mut approaches = approaches(roads.network, movements);
        approaches.retain(|it| perimeter.is_core(it.chain));
        let room = roads.queues.mixture(1.0, 0.0).mean_of(|length, _| PerimeterControl::taken_by(length));
        Town { movements, driving, room, lit, approaches }
    }

    /// Mean length that all vehicles in it take up when all flows are `growth` times as large [m].
    fn taken(&self, growth: f64) -> f64 {
        let before_lights = self.lit.iter().map(|Lit { light, flow, capacity }| {
            let program = &light.program;
            let flow = growth * flow;
            flow * delay::at_a_light(program.mean_wait(), program.green_share(), flow, *capacity)
        });
        let giving_way = self.approaches.iter().map(|it| {
            let [flow, waiting] = it.flows(self.movements).map(|it| growth * it);
            if waiting == 0.0 {
                return 0.0;
            }
            waiting * delay::giving_way(flow, flow / it.fullness(self.movements, growth))
        });
        growth * self.driving + self.room * (before_lights.sum::<f64>() + giving_way.sum::<f64>())
    }
}

/// Mean length that driving vehicles on a chain take up, at their desired speeds [m].
fn driving_on(roads: &Roads, chain: ChainIndex) -> f64 {
    let here = roads.network.chain(chain);
    let parts = roads.assignment.on(chain).iter();
    let metres: f64 = parts.map(|it| it.flow * (it.to.min(here.length) - it.from)).sum();
    metres * roads.queues.taken_on_a_metre(here.limit(0.0))
}

/// The loads of places inside the map: a vehicle that starts from one makes space for the next.
pub(super) fn inner_place_loads(roads: &Roads, inner_places: &[InnerPlace]) -> Vec<Load> {
    let load = |inner: &InnerPlace| {
        let limit = roads.network.chain(inner.chain).limit(inner.station);
        let flow = roads.queues.mixture(limit, 0.0).starts();
        let starts = roads.assignment.on(inner.chain).iter().filter(|it| it.from == inner.station);
        let share = starts.map(|it| it.flow).sum::<f64>() / flow;
        let at = vec![Position::new(inner.chain, inner.station)];
        Load::new(share, Bottleneck::TripEnd(inner.id), at)
    };
    inner_places.iter().map(load).collect()
}
