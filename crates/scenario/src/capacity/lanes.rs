//! The loads of lanes and lights.

use laneweave_network::{ChainIndex, Id, Light, Position, Side, Sign};
use laneweave_sim::{Change, TAKES_LANE_WITHIN};

use super::{Bottleneck, Load, Roads, curvature, weaving};

/// A light at a place of a lane also belongs to the lanes beside it, if it is no further away [m].
const BESIDE: f64 = 20.0;

/// The loads of lanes: at the start of each part that is used, of each limit and bend, and at each light. Vehicles that
/// may use several lanes side by side fill them together; vehicles that need one lane fill it alone.
pub(super) fn loads(roads: &Roads) -> Vec<Load> {
    let mut loads = Vec::new();
    for chain in roads.chains() {
        let here = roads.network.chain(chain);
        let starts = roads.assignment.on(chain).iter().map(|it| it.from);
        let limits = here.limits.iter().map(|it| it.start);
        let bends = here.bends.iter().map(|it| it.start);
        let stops = roads.network.junctions.on(chain).stops.iter().map(|it| it.station);
        let mut stations: Vec<f64> = starts.chain(limits).chain(bends).chain(stops).collect();
        stations.sort_by(f64::total_cmp);
        stations.dedup();
        loads.extend(stations.into_iter().map(|it| roads.load(chain, it)));
    }
    loads.extend(roads.assignment.changes.iter().filter_map(|it| roads.load_by_changes(it)));
    loads
}

impl Roads<'_> {
    /// The load of the lanes at a station of a chain [m].
    fn load(&self, chain: ChainIndex, station: f64) -> Load {
        let (capacity, light) = self.capacity(chain, station);
        let counted = |at: Position| {
            let equivalents = if light.is_some() { self.equivalents.at(at.chain, at.x) } else { 1.0 };
            self.assignment.flow(at.chain, at.x).map(|it| it * equivalents)
        };
        let [bound, all] = counted(Position::new(chain, station));
        let (mut flows, mut capacities, mut lanes) = (all, capacity, vec![Position::new(chain, station)]);
        for beside in self.beside(chain, station, light.is_some()) {
            let [_, flow] = counted(beside);
            // A lane that ends soon, or leads elsewhere, has no flow.
            if flow > 0.0 {
                flows += flow;
                capacities += self.capacity(beside.chain, beside.x).0;
                lanes.push(beside);
            }
        }
        if light.is_none() {
            capacities *= self.queues.left(lanes.len(), self.network.chain(chain).limit(station));
        }
        let lanelet = self.lanelet(chain, station);
        let of = light.map_or(Bottleneck::Lanes(lanelet), |light| Bottleneck::Light { light, lanelet });
        // Who needs this lane fills it alone.
        let alone = bound / capacity > flows / capacities;
        lanes.truncate(if alone { 1 } else { lanes.len() });
        Load::new((bound / capacity).max(flows / capacities), of, lanes)
    }

    /// The load of the lanes at the last place at which some vehicles have to leave one of them; none before a light,
    /// where there is time for this at red.
    fn load_by_changes(&self, Change { from: (chain, [start, last_place]), .. }: &Change) -> Option<Load> {
        /// Distance from the place to where lanes are still side by side, and to where all vehicles have changed [m].
        const SHORTLY: f64 = 0.5;
        let before = last_place - SHORTLY;
        let (_, light) = self.capacity(*chain, before);
        if light.is_some() {
            return None;
        }
        let beside = self.beside(*chain, before, false);
        let lanes: Vec<Position> = std::iter::once(Position::new(*chain, before)).chain(beside).collect();
        let (mut flows, mut capacities, mut number, mut fullest) = (0.0, 0.0, 0, 0.0_f64);
        for Position { chain: lane, x: at } in &lanes {
            let [bound, flow] = self.assignment.flow(*lane, at + 2.0 * SHORTLY);
            if flow > 0.0 {
                let capacity = self.capacity(*lane, *at).0;
                flows += flow;
                capacities += capacity;
                number += 1;
                if self.parts_soon(*lane, *at) {
                    fullest = fullest.max(bound / capacity);
                }
            }
        }
        capacities *= self.queues.left(number, self.network.chain(*chain).limit(before));
        let left = weaving::left(self.assignment, &lanes, flows, last_place - start);
        let of = Bottleneck::Lanes(self.lanelet(*chain, before));
        (flows > 0.0).then(|| Load::new(fullest.max(flows / capacities) / left, of, lanes))
    }

    /// Whether a lane soon parts from all lanes beside it, beyond a station [m]: vehicles that need it have to be on
    /// it already.
    fn parts_soon(&self, chain: ChainIndex, station: f64) -> bool {
        let here = self.network.chain(chain);
        let ends = Side::BOTH.into_iter().flat_map(|side| here.stretches(side)).map(|it| it.end);
        ends.fold(station, f64::max) < station + TAKES_LANE_WITHIN
    }

    /// The flow at a station of a chain [veh/s], and the light there.
    fn capacity(&self, chain: ChainIndex, station: f64) -> (f64, Option<Id>) {
        let network = self.network;
        let limit = network.chain(chain).limit(station);
        let stops = network.junctions.on(chain).stops.iter();
        let mut near = stops.filter(|it| (it.station - station).abs() < BESIDE);
        let light = near.find_map(|it| if let Sign::Light(light) = it.sign { Some(light) } else { None });
        let Some(light) = light else {
            return (self.queues.stream(limit, curvature(self.network, chain, [station; 2])), None);
        };
        let Light { id, program, .. } = &network.junctions.lights[light.at()];
        (self.queues.through(program, limit), Some(*id))
    }

    /// The lanes to which vehicles may change at a station of a chain [m], or shortly before a light there, each with
    /// the station there.
    fn beside(&self, chain: ChainIndex, station: f64, is_at_light: bool) -> Vec<Position> {
        /// Length without lane changes before a light [m].
        const BEFORE_A_LIGHT: f64 = 100.0;
        let network = self.network;
        let since = |x: f64| if is_at_light { x - BEFORE_A_LIGHT } else { x };
        let mut found = vec![Position::new(chain, station)];
        let mut number = 0;
        while let Some(Position { chain: at, x }) = found.get(number).copied() {
            number += 1;
            for side in Side::BOTH {
                let mut stretches = network.chain(at).stretches(side).iter().rev();
                let Some(stretch) = stretches.find(|it| it.start <= x && it.end > since(x)) else { continue };
                let beside = Position::new(stretch.chain, stretch.across(x));
                if beside.x < network.chain(beside.chain).length
                    && found.iter().all(|it| it.chain != beside.chain)
                {
                    found.push(beside);
                }
            }
        }
        found.split_off(1)
    }
}
