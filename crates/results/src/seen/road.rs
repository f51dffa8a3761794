//! The longitudinal structure of a network: lanes side by side share their sections; successive lanes form a road.

use laneweave_network::{ChainIndex, Network, Position, Side};
use serde::{Deserialize, Serialize};

/// Approximate length of a section [m].
const SECTION: f64 = 500.0;
/// Minimum length of lane in a section: in a shorter one the density would be random [m].
const LEAST_LANE: f64 = 200.0;

/// A network divided into sections, each with all its parallel lanes.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Sections {
    /// Length of all lanes of each section together [m].
    pub(super) lane_lengths: Vec<f64>,
    /// Mean speed limit on them [m/s].
    pub(super) limits: Vec<f64>,
    /// For each chain its position along its carriageway.
    places: Vec<Place>,
    /// For each carriageway its cells.
    carriageways: Vec<Carriageway>,
}

/// The position of a chain along its carriageway.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Place {
    carriageway: usize,
    /// Where it begins [m].
    offset: f64,
}

/// Chains that are joined by lane changes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Carriageway {
    from: f64,
    to: f64,
    /// The section of each cell, if it is not left out.
    sections: Vec<Option<usize>>,
}

impl Carriageway {
    fn cell_length(&self) -> f64 {
        (self.to - self.from) / self.sections.len() as f64
    }

    fn cell(&self, station: f64) -> usize {
        let cell = (station - self.from) / self.cell_length();
        (cell.max(0.0) as usize).min(self.sections.len() - 1)
    }
}

impl Sections {
    pub(super) fn of(network: &Network) -> Sections {
        let (places, mut carriageways) = lay_out(network);
        let (mut lane_lengths, mut limits) = (Vec::new(), Vec::new());
        for (index, carriageway) in carriageways.iter_mut().enumerate() {
            // The length of the lanes in each cell, and the sum of the limits over them.
            let mut lengths = vec![[0.0; 2]; carriageway.sections.len()];
            for (place, chain) in places.iter().zip(&network.chains).filter(|(it, _)| it.carriageway == index)
            {
                for (cell, [length, limits]) in lengths.iter_mut().enumerate() {
                    let begin = carriageway.from + cell as f64 * carriageway.cell_length();
                    let end = begin + carriageway.cell_length();
                    let [from, to] = [begin.max(place.offset), end.min(place.offset + chain.length)];
                    if from < to {
                        *length += to - from;
                        *limits += (to - from) * chain.limit(0.5 * (from + to) - place.offset);
                    }
                }
            }
            for (section, [length, limit]) in carriageway.sections.iter_mut().zip(lengths) {
                if length >= LEAST_LANE {
                    *section = Some(lane_lengths.len());
                    lane_lengths.push(length);
                    limits.push(limit / length);
                }
            }
        }
        Sections { lane_lengths, limits, places, carriageways }
    }

    /// The section at `x` [m] of `chain`, if it is not left out.
    pub(super) fn at(&self, chain: ChainIndex, x: f64) -> Option<usize> {
        self.span(chain, x).0
    }

    /// The same, and the station on the chain up to which it is the section [m], which is beyond `x`.
    pub(super) fn span(&self, chain: ChainIndex, x: f64) -> (Option<usize>, f64) {
        let place = self.places[chain.at()];
        let carriageway = &self.carriageways[place.carriageway];
        let cell = carriageway.cell(place.offset + x);
        let end = match cell + 1 {
            next if next < carriageway.sections.len() => {
                carriageway.from + next as f64 * carriageway.cell_length() - place.offset
            }
            _ => f64::INFINITY,
        };
        (carriageway.sections[cell], end.max(x.next_up()))
    }
}

/// The position of each chain, found from its neighbours, and all carriageways with their cells.
fn lay_out(network: &Network) -> (Vec<Place>, Vec<Carriageway>) {
    let mut places: Vec<Option<Place>> = vec![None; network.chains.len()];
    let mut carriageways = Vec::new();
    for first in 0..network.chains.len() {
        if places[first].is_some() {
            continue;
        }
        let carriageway = carriageways.len();
        places[first] = Some(Place { carriageway, offset: 0.0 });
        let mut found = vec![(first, 0.0)];
        let mut next = 0;
        while let Some((here, offset)) = found.get(next).copied() {
            next += 1;
            let chain = &network.chains[here];
            for beside in Side::BOTH.into_iter().flat_map(|side| chain.stretches(side)) {
                let there = &mut places[beside.chain.at()];
                if there.is_none() {
                    let offset = offset + beside.start - beside.other_start;
                    *there = Some(Place { carriageway, offset });
                    found.push((beside.chain.at(), offset));
                }
            }
        }
        let ends = found.iter().map(|(chain, offset)| offset + network.chains[*chain].length);
        let from = found.iter().map(|(_, offset)| *offset).fold(f64::INFINITY, f64::min);
        let to = ends.fold(f64::NEG_INFINITY, f64::max);
        let cells = ((to - from) / SECTION).round().max(1.0) as usize;
        carriageways.push(Carriageway { from, to, sections: vec![None; cells] });
    }
    (places.into_iter().flatten().collect(), carriageways)
}

/// Successive lanes, as a driver uses them who changes lanes only where a lane ends.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Road {
    pieces: Vec<Piece>,
}

/// A chain of a road, from one station to another.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Piece {
    chain: ChainIndex,
    from: f64,
    /// Position along the road of station 0 [m].
    offset: f64,
}

impl Road {
    /// The road from `start` on, at most `longest` [m] of it.
    pub(super) fn from(network: &Network, start: ChainIndex, longest: f64) -> Road {
        let mut pieces = vec![Piece { chain: start, from: 0.0, offset: 0.0 }];
        while let Some(next) = pieces.last().and_then(|last| after(network, last)) {
            if next.offset + next.from > longest || pieces.iter().any(|it| it.chain == next.chain) {
                break;
            }
            pieces.push(next);
        }
        Road { pieces }
    }

    /// Its chains, each with the station from which it belongs to the road, and the position there of station 0 [m].
    pub(super) fn pieces(&self) -> impl Iterator<Item = (ChainIndex, f64, f64)> + '_ {
        self.pieces.iter().map(|it| (it.chain, it.from, it.offset))
    }

    /// Its length [m].
    pub(super) fn length(&self, network: &Network) -> f64 {
        self.pieces.last().map_or(0.0, |it| it.offset + network.chain(it.chain).length)
    }

    /// Whether both roads have a chain in common.
    pub(super) fn meets(&self, other: &Road) -> bool {
        self.pieces.iter().any(|it| other.pieces.iter().any(|other| other.chain == it.chain))
    }

    /// Position of a place along the road [m], if the place belongs to it.
    pub(super) fn position(&self, at: Position) -> Option<f64> {
        let piece = self.pieces.iter().find(|it| it.chain == at.chain && it.from <= at.x)?;
        Some(piece.offset + at.x)
    }
}

/// The continuation of a road: the longest following chain, or the one beside the end.
fn after(network: &Network, last: &Piece) -> Option<Piece> {
    let chain = network.chain(last.chain);
    let length = |it: &ChainIndex| network.chain(*it).length;
    if let Some(next) = chain.following.iter().copied().max_by(|a, b| length(a).total_cmp(&length(b))) {
        return Some(Piece { chain: next, from: 0.0, offset: last.offset + chain.length });
    }
    if !chain.is_lane_drop() {
        return None;
    }
    let beside = Side::BOTH.into_iter().find_map(|side| chain.beside(side, chain.length))?;
    let from = beside.across(chain.length);
    Some(Piece { chain: beside.chain, from, offset: last.offset + chain.length - from })
}

#[cfg(test)]
mod tests {
    use laneweave_generate::{Motorway, motorway};

    use super::*;

    fn network(plan: &Motorway) -> Network {
        motorway(plan).unwrap().build().unwrap().network
    }

    #[test]
    fn parallel_lanes_share_their_sections() {
        let network = network(&Motorway { lanes: 3, length_m: 3000.0, ..Motorway::default() });
        let sections = Sections::of(&network);
        assert_eq!(sections.lane_lengths, [1500.0; 6]);
        let limit = network.chains[0].limit(0.0);
        assert!(sections.limits.iter().all(|it| (it - limit).abs() < 1e-9), "{:?}", sections.limits);
        let of = |x: f64| (0..3).map(|i| sections.at(ChainIndex(i), x)).collect::<Vec<_>>();
        assert_eq!(of(499.0), [Some(0); 3]);
        assert_eq!(of(501.0), [Some(1); 3]);
        assert_eq!(of(3000.0), [Some(5); 3]);
    }

    #[test]
    fn an_acceleration_lane_counts_for_the_sections_it_lies_in() {
        let network = network(&Motorway {
            lanes: 2,
            length_m: 3000.0,
            on_ramp_at: vec![1000.0],
            ..Motorway::default()
        });
        let lengths = Sections::of(&network).lane_lengths;
        // Two lanes of 500 m each; the ramp of 200 m and its lane of 250 m lie in the second and third section.
        let extra: Vec<f64> = lengths.iter().map(|it| (it - 1000.0).round()).collect();
        assert_eq!((extra[0], extra[3], extra[4], extra[5]), (0.0, 0.0, 0.0, 0.0));
        assert!(extra[1] > 190.0 && extra[2] == 250.0, "{extra:?}");
    }

    #[test]
    fn a_road_goes_on_beside_a_lane_that_ends() {
        let network = network(&Motorway {
            lanes: 2,
            length_m: 3000.0,
            lane_drop_at: Some(1000.0),
            ..Motorway::default()
        });
        let drop = network.lane_drops[0];
        let road = Road::from(&network, drop, 1e5);
        assert_eq!(road.position(Position::new(drop, 999.0)), Some(999.0));
        let other = network.chain(drop).beside(Side::Left, 999.0).unwrap().chain;
        assert_eq!(road.position(Position::new(other, 999.0)), None);
        assert_eq!(road.position(Position::new(other, 2000.0)), Some(2000.0));
        assert!((road.length(&network) - 3000.0).abs() < 1e-6);
        assert!(road.meets(&Road::from(&network, other, 1e5)));
    }
}
