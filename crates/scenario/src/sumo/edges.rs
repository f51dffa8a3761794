//! The edges of a net of SUMO among the lanelets of a network.

use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap, HashSet};

use laneweave_network::{ChainIndex, Class, Id, LaneletIndex, Network, Position};
use laneweave_sim::{CrossSection, InnerPlace, LineStop};

use crate::scenario::{Stop, inner_place};

/// Trip ends lie so far before the end of their edge [m], ours: beyond it others come from aside.
const BEFORE_THE_END: f64 = 1.0;

/// Vehicles stand at least so far before the end of a lane at their stops [m].
const STOPS_BEFORE_THE_END: f64 = LineStop::MARGIN + 0.1;

/// Edges by name: the lanelets of their lanes, from the right on.
pub(super) struct Edges<'a> {
    network: &'a Network,
    lanes: HashMap<&'a str, Vec<LaneletIndex>>,
    /// For each lanelet that is a lane of an edge the name of that.
    names: Vec<Option<&'a str>>,
}

impl<'a> Edges<'a> {
    /// The edges of a `network`, whose lanelets have the `ids`.
    pub(super) fn of(network: &'a Network, ids: &'a [String]) -> Edges<'a> {
        let mut lanes: HashMap<&str, Vec<(u32, LaneletIndex)>> = HashMap::new();
        let mut names = vec![None; network.lanelets.len()];
        for (id, place) in ids.iter().zip(0..) {
            if let Some((edge, index)) =
                id.rsplit_once('_').filter(|_| !id.starts_with(':') && !id.contains(' '))
                && let Ok(index) = index.parse()
            {
                lanes.entry(edge).or_default().push((index, LaneletIndex(place)));
                names[place as usize] = Some(edge);
            }
        }
        let sorted = |mut lanes: Vec<(u32, LaneletIndex)>| {
            lanes.sort_unstable();
            lanes.into_iter().map(|it| it.1).collect()
        };
        let lanes = lanes.into_iter().map(|(edge, lanes)| (edge, sorted(lanes))).collect();
        Edges { network, lanes, names }
    }

    /// The lanes of an edge that a class may use; none if there is no such edge.
    pub(super) fn lanes(&self, edge: &str, class: Class) -> Vec<LaneletIndex> {
        let all = self.lanes.get(edge).map_or(&[][..], |it| it);
        all.iter().copied().filter(|it| self.network.lanelets[it.at()].classes.has(class)).collect()
    }

    /// Whether there is such an edge.
    pub(super) fn has(&self, edge: &str) -> bool {
        self.lanes.contains_key(edge)
    }

    /// Where a vehicle of a class stands at a stop on the lane with this name, with its front bumper at `end` [m], from
    /// the end of the lane if negative; `None` if it cannot rest there.
    pub(super) fn stop(&self, lane: &str, end: Option<f64>, class: Class) -> Option<InnerPlace> {
        let lanelet = Id::from(lane);
        let index = self.network.lanelet_with(lanelet)?;
        let length = self.network.lanelets[index.at()].length();
        let end = end.unwrap_or(length);
        let position_m =
            (if end < 0.0 { length + end } else { end }).clamp(0.0, length - STOPS_BEFORE_THE_END);
        inner_place(&Stop { lanelet, position_m, rest_s: 0.0 }, class, self.network).ok()
    }

    /// Where vehicles start on an edge: with their rear bumpers at its beginning, beyond what crosses or
    /// merges there.
    pub(super) fn start(&self, edge: &str) -> Option<CrossSection> {
        let junctions = &self.network.junctions;
        let place = |lanelet: LaneletIndex| {
            let Position { chain, x: from } = self.network.start_of(lanelet);
            let until = from + self.network.lanelets[lanelet.at()].length();
            let zones = junctions.on(chain).crossings.iter().map(|it| junctions.reach(*it));
            let covered = zones.filter(|it| it.start <= from && it.end < until).map(|it| it.end);
            Position::new(chain, covered.fold(from, f64::max))
        };
        let lanes: Vec<Position> = self.lanes.get(edge)?.iter().copied().map(place).collect();
        Some(CrossSection::new(edge.into(), &lanes))
    }

    /// Where trips end on an edge: at its end, or so far from its beginning [m]; from its end if negative. In a lane
    /// that ends beside others it is before the place where drivers wait to leave it.
    pub(super) fn end(&self, edge: &str, at: Option<f64>) -> Option<CrossSection> {
        let place = |lanelet: &LaneletIndex| {
            let Position { chain, x: from } = self.network.start_of(*lanelet);
            let length = self.network.lanelets[lanelet.at()].length();
            let lane = self.network.chain(chain);
            let waits = lane.driven_until(true) - from - LineStop::BEFORE_A_LANE_END;
            let waits = if lane.is_lane_drop() { waits } else { f64::INFINITY };
            let last = (length - BEFORE_THE_END).min(waits).max(0.5 * length);
            let along = at.map_or(last, |it| if it < 0.0 { length + it } else { it });
            Position::new(chain, from + along.clamp(0.5 * length.min(2.0 * BEFORE_THE_END), last))
        };
        let lanes: Vec<Position> = self.lanes.get(edge)?.iter().map(place).collect();
        Some(CrossSection::new(edge.into(), &lanes))
    }

    /// The edges of the fastest way of a class over these edges, on a free road; `None` if there is none.
    pub(super) fn fastest_over(&self, edges: &[String], class: Class) -> Option<Vec<String>> {
        let mut way = vec![edges[0].clone()];
        for pair in edges.windows(2) {
            way.extend(self.fastest([&pair[0], &pair[1]], class)?.into_iter().map(str::to_owned));
        }
        Some(way)
    }

    /// The edges of the fastest way from one edge to another one, without the first.
    fn fastest(&self, [from, to]: [&'a str; 2], class: Class) -> Option<Vec<&'a str>> {
        /// Times are compared in thousandths of a second.
        const PER_SECOND: f64 = 1000.0;
        let mut before: HashMap<&str, &str> = HashMap::new();
        let mut settled: HashSet<&str> = HashSet::new();
        let mut open = BinaryHeap::from([Reverse((0_u64, from, from))]);
        while let Some(Reverse((time, edge, last))) = open.pop() {
            if !settled.insert(edge) {
                continue;
            }
            before.insert(edge, last);
            if edge == to {
                break;
            }
            for (next, seconds) in self.beyond(edge, class) {
                open.push(Reverse((time + (seconds * PER_SECOND) as u64, next, edge)));
            }
        }
        let mut way = Vec::new();
        let mut at = to;
        while at != from {
            way.push(at);
            at = before.get(at)?;
        }
        way.reverse();
        Some(way)
    }

    /// The edges to which a class may go on from an edge, with the time that they take on a free road [s].
    fn beyond(&self, edge: &str, class: Class) -> impl Iterator<Item = (&'a str, f64)> {
        let network = self.network;
        let follow = move |it: LaneletIndex| network.lanelets[it.at()].following.iter().copied();
        let next = self.lanes(edge, class).into_iter().flat_map(follow);
        let lanes = next.flat_map(move |it| match self.names[it.at()] {
            Some(_) => vec![it],
            None if network.lanelets[it.at()].classes.has(class) => follow(it).collect(),
            None => Vec::new(),
        });
        let usable = lanes.filter(move |it| network.lanelets[it.at()].classes.has(class));
        usable.filter_map(move |it| {
            let lanelet = &network.lanelets[it.at()];
            Some((self.names[it.at()]?, lanelet.length() / lanelet.speed_limit))
        })
    }

    /// The chains over which a class drives along these edges; `None` if no way leads from one to the next.
    pub(super) fn chains_along(&self, edges: &[String], class: Class) -> Option<Vec<ChainIndex>> {
        let mut lanelets = self.lanes(&edges[0], class);
        for pair in edges.windows(2) {
            let [from, to] = [0, 1].map(|it| self.lanes(&pair[it], class));
            let follow =
                |lanelet: LaneletIndex| self.network.lanelets[lanelet.at()].following.iter().copied();
            let onward: Vec<LaneletIndex> = from.iter().flat_map(|it| follow(*it)).collect();
            let leads = |it: &&LaneletIndex| to.contains(it) || follow(**it).any(|next| to.contains(&next));
            let before = lanelets.len();
            lanelets.extend(onward.iter().filter(leads));
            if lanelets.len() == before {
                return None;
            }
            lanelets.extend(to);
        }
        Some(lanelets.into_iter().map(|it| self.network.start_of(it).chain).collect())
    }
}
