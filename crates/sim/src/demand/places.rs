//! The places of a map at which trips start and end.

use laneweave_network::{ChainIndex, Classes, Gate, LaneletIndex, Network};

use crate::demand::Demand;
use crate::route::navigate::Navigator;
use crate::route::place::{InnerPlace, Place};
use crate::state::vehicle::LONGEST;

/// The places of a map.
#[derive(Clone, Debug, PartialEq)]
pub struct Places {
    /// Where trips start.
    pub origins: Vec<Place>,
    /// Where they end.
    pub destinations: Vec<Place>,
}

impl Places {
    /// Upper limit of the waypoints that are planned on a map without gates. With more destinations, every n-th one is
    /// used. Ours: 260 MB.
    const MOST_WAYPOINTS: usize = 4_000_000;

    /// The entrances and exits of `network`.
    pub fn at_gates(network: &Network) -> Places {
        let places = |gates: &[Gate]| gates.iter().cloned().map(Place::Gate).collect();
        Places { origins: places(&network.entrances), destinations: places(&network.exits) }
    }

    /// The same places without the origins from which no destination can be reached.
    pub fn reachable(mut self, network: &Network) -> Places {
        let mut cut_off: Vec<usize> = (0..self.origins.len()).collect();
        for destination in self.destinations.chunks(1) {
            // Most places are connected: one destination is enough.
            if cut_off.is_empty() {
                break;
            }
            let navigator = Navigator::towards_for(network, destination, Classes::NONE);
            cut_off.retain(|it| !navigator.leads(network, &self.origins[*it], 0, Classes::ALL));
        }
        let mut numbers = 0..self.origins.len();
        self.origins.retain(|_| numbers.next().is_some_and(|it| cut_off.binary_search(&it).is_err()));
        self
    }

    /// Places for a map without entrance or exit: places along those of `lanelets` that are long enough. A destination
    /// can be reached from every origin.
    pub fn along(network: &Network, lanelets: impl IntoIterator<Item = LaneletIndex>) -> Places {
        let mut is_wanted = vec![false; network.lanelets.len()];
        lanelets.into_iter().for_each(|it| is_wanted[it.at()] = true);
        let mut inner_places: Vec<InnerPlace> = Vec::new();
        for (chain, index) in network.chains.iter().zip(0..) {
            for (lanelet, start) in chain.lanelets.iter().zip(&chain.starts) {
                let length = network.lanelets[lanelet.at()].length();
                if !is_wanted[lanelet.at()] || length < InnerPlace::SHORTEST_LANELET {
                    continue;
                }
                let chain = ChainIndex(index);
                let usual = start + InnerPlace::SHARE_BEFORE * length;
                if let Some(station) = clear_station(network, chain, [*start, start + length], usual) {
                    inner_places.push(InnerPlace { id: network.lanelets[lanelet.at()].id, chain, station });
                }
            }
        }
        inner_places.sort_by_key(|inner| inner.id);
        let most = (Places::MOST_WAYPOINTS / network.chains.len()).clamp(1, Demand::MOST_DESTINATIONS);
        let one_in = inner_places.len().div_ceil(most).max(1);
        let destinations: Vec<Place> =
            inner_places.iter().step_by(one_in).map(|inner| Place::Inside(*inner)).collect();
        let origins = inner_places.into_iter().map(Place::Inside).collect();
        Places { origins, destinations }.reachable(network)
    }
}

/// The station nearest to `usual` at which the longest vehicle can start: in front of the station it stands on the
/// lanelet and in no conflict zone [m]. The lanelet lies along `chain` between the stations `from` and `to`.
fn clear_station(network: &Network, chain: ChainIndex, [from, to]: [f64; 2], usual: f64) -> Option<f64> {
    /// A vehicle keeps this distance from a zone [m].
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
