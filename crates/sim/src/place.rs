//! Places at which trips start and end: gates at the edge of the map, and kerbs along its lanes.

use laneweave_network::{ChainIndex, Gate, LaneletIndex, Network};

use crate::demand::Demand;
use crate::navigate::Navigator;
use crate::scene::LONGEST;

/// Where trips start or end.
#[derive(Clone, Debug, PartialEq)]
pub enum Place {
    /// Lanes at the edge of the map: vehicles come driving at their starts, and leave at their ends.
    Gate(Gate),
    /// A place along a lane: vehicles start there from rest, and are gone when they reach it.
    Kerb(Kerb),
}

/// A place along a lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kerb {
    /// Its lanelet's id: its name.
    pub id: i64,
    /// Its chain.
    pub chain: ChainIndex,
    /// Where on it the rear bumper of a vehicle that starts is, and where a trip ends: when the front bumper passes [m].
    pub station: f64,
}

impl Kerb {
    /// Trips start and end on lanelets of this length or more [m].
    pub const SHORTEST_LANELET: f64 = 20.0;
    /// Share of its lanelet that lies before a kerb. Of the shortest lanelet 12 m, the longest vehicle, lie behind it:
    /// who starts stands on the lanelet, and who has driven off the lanelet does not reach back to the kerb.
    const SHARE_BEFORE: f64 = 0.4;
}

impl Place {
    /// Its name in input and output: the smallest id of its lanelets.
    pub fn id(&self) -> i64 {
        match self {
            Place::Gate(gate) => gate.id,
            Place::Kerb(kerb) => kerb.id,
        }
    }

    /// Its lanes.
    pub fn chains(&self) -> &[ChainIndex] {
        match self {
            Place::Gate(gate) => &gate.chains,
            Place::Kerb(kerb) => std::slice::from_ref(&kerb.chain),
        }
    }
}

/// The places of a map.
#[derive(Clone, Debug, PartialEq)]
pub struct Places {
    /// Where trips start.
    pub origins: Vec<Place>,
    /// Where they end.
    pub destinations: Vec<Place>,
}

impl Places {
    /// Most waypoints that are planned on a map without gates; of more destinations an even choice remains. Ours: 260 MB.
    const MOST_WAYPOINTS: usize = 4_000_000;

    /// The entrances and exits of `network`.
    pub fn at_gates(network: &Network) -> Places {
        let places = |gates: &[Gate]| gates.iter().cloned().map(Place::Gate).collect();
        Places { origins: places(&network.entrances), destinations: places(&network.exits) }
    }

    /// The same without origins from which no destination can be reached.
    pub fn reachable(mut self, network: &Network) -> Places {
        let navigator = Navigator::towards(network, &self.destinations);
        let count = self.destinations.len() as u16;
        self.origins.retain(|place| (0..count).any(|it| navigator.leads(network, place, it)));
        self
    }

    /// For a map without entrance or exit: kerbs along those of `lanelets` that are long enough. Who starts at one of the
    /// origins can reach a destination.
    pub fn along(network: &Network, lanelets: impl IntoIterator<Item = LaneletIndex>) -> Places {
        let mut is_wanted = vec![false; network.lanelets.len()];
        lanelets.into_iter().for_each(|it| is_wanted[it.at()] = true);
        let mut kerbs: Vec<Kerb> = Vec::new();
        for (chain, index) in network.chains.iter().zip(0..) {
            for (lanelet, start) in chain.lanelets.iter().zip(&chain.starts) {
                let length = network.lanelets[lanelet.at()].length();
                if !is_wanted[lanelet.at()] || length < Kerb::SHORTEST_LANELET {
                    continue;
                }
                let chain = ChainIndex(index);
                let usual = start + Kerb::SHARE_BEFORE * length;
                if let Some(station) = clear_station(network, chain, [*start, start + length], usual) {
                    kerbs.push(Kerb { id: network.lanelets[lanelet.at()].id, chain, station });
                }
            }
        }
        kerbs.sort_by_key(|kerb| kerb.id);
        let most = (Places::MOST_WAYPOINTS / network.chains.len()).clamp(1, Demand::MOST_DESTINATIONS);
        let one_in = kerbs.len().div_ceil(most).max(1);
        let destinations: Vec<Place> = kerbs.iter().step_by(one_in).map(|kerb| Place::Kerb(*kerb)).collect();
        let origins = kerbs.into_iter().map(Place::Kerb).collect();
        Places { origins, destinations }.reachable(network)
    }
}

/// The station nearest to `usual` on a lanelet, which reaches along a `chain` `from` one station `to` another, before which the longest
/// vehicle stands in no conflict zone and on the lanelet [m].
fn clear_station(network: &Network, chain: ChainIndex, [from, to]: [f64; 2], usual: f64) -> Option<f64> {
    /// A vehicle keeps this distance to a zone [m].
    const SPARE: f64 = 1.0;
    let junctions = &network.junctions;
    let taken: Vec<[f64; 2]> = junctions
        .on(chain)
        .crossings
        .iter()
        .map(|it| junctions.reach(*it))
        .map(|it| [it.start - LONGEST - SPARE, it.end + SPARE])
        .collect();
    let is_clear = |station: &f64| {
        let is_taken = taken.iter().any(|[start, end]| (*start..*end).contains(station));
        (from..=to - LONGEST).contains(station) && !is_taken
    };
    let candidates = std::iter::once(usual).chain(taken.iter().flatten().copied());
    candidates.filter(is_clear).min_by(|a, b| (a - usual).abs().total_cmp(&(b - usual).abs()))
}
