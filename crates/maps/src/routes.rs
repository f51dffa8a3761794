//! The sensible ways from one lanelet to another.
//!
//! Lanelets between which lane changes are allowed are one *section* of road, and so are those that lead from the same section
//! to the same section, as lanes do across a junction: ways that differ only in where lanes are changed are one way. A way is
//! sensible if it enters no section twice and takes not much longer than the best one. Of ways over the same *roads*, which are
//! sections side by side whether or not a change between them is allowed, the fastest is named, and the others are counted.

use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap};

use hashbrown::HashMap;
use laneweave_network::Network;

use crate::format::Map;
use crate::graph::{Graph, Node, NodeIndex};

/// A way through a map.
#[derive(Clone, Debug, PartialEq)]
pub struct Route {
    /// Its lanelets, with how each is reached.
    pub steps: Vec<Step>,
    /// From the beginning of the first lanelet to the end of the last one [m].
    pub length: f64,
    /// At the speed limits [s].
    pub time: f64,
    /// How many ways over the same roads were found, which differ in their lanes: this one and slower ones.
    pub variants: usize,
}

/// A lanelet of a way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Step {
    /// Where it is in the graph.
    pub node: NodeIndex,
    /// How it is reached.
    pub by: By,
}

/// How a lanelet is reached from the one before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum By {
    /// It goes on, or is the first.
    Following,
    /// By a change to the left.
    Left,
    /// By a change to the right.
    Right,
}

/// Which ways are sensible.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sense {
    /// Most ways that are named.
    pub most: usize,
    /// They take at most so many times as long as the best one.
    pub longest: f64,
}

impl Default for Sense {
    /// Ten ways, up to twice as long.
    fn default() -> Sense {
        Sense { most: 10, longest: 2.0 }
    }
}

/// The way with the fewest changes is taken among those of one time; a change counts so much [s].
const CHANGE: f64 = 1e-3;
/// Partial ways that are looked at before the search gives up.
const MOST_PARTIAL: usize = 200_000;

/// The sensible ways from `from` to `to`, the fastest first.
pub fn routes(map: &Map, from: NodeIndex, to: NodeIndex, sense: Sense) -> Vec<Route> {
    let search = Search::new(map, to);
    if !search.remaining[from.at()].is_finite() {
        return Vec::new();
    }
    let roads = joined(
        &map.graph,
        &sections(&map.graph, |it| [it.left, it.right, it.adjacent_left, it.adjacent_right]),
    );
    // Each with its roads.
    let mut found: Vec<(Vec<u32>, Route)> = Vec::new();
    let mut open = BinaryHeap::from([Reverse(search.start(from))]);
    let mut latest = f64::INFINITY;
    for _ in 0..MOST_PARTIAL {
        let Some(Reverse(partial)) = open.pop() else { break };
        if partial.estimate > latest {
            break;
        }
        if partial.costs.iter().any(|(node, _)| *node == to) {
            latest = latest.min(partial.estimate * sense.longest);
            let Some(route) = search.route(from, &partial.sections) else { continue };
            let mut over: Vec<u32> = route.steps.iter().map(|it| roads[it.node.at()]).collect();
            over.dedup();
            match found.iter().position(|it| it.0 == over) {
                Some(known) => found[known].1.variants += 1,
                None if found.len() == sense.most => break,
                None => found.push((over, route)),
            }
        } else {
            open.extend(search.onward(&partial).into_iter().map(Reverse));
        }
    }
    if found.is_empty() {
        // Some ways lead back to where they began.
        return vec![search.fastest(from)];
    }
    found.into_iter().map(|(_, route)| route).collect()
}

/// A way as far as it was thought out.
struct Partial {
    /// Least time of the whole way [s].
    estimate: f64,
    sections: Vec<u32>,
    /// The nodes of the last section that can be reached, and the least time to the beginning of each [s].
    costs: Vec<(NodeIndex, f64)>,
}

impl PartialEq for Partial {
    fn eq(&self, other: &Partial) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Partial {}

impl PartialOrd for Partial {
    fn partial_cmp(&self, other: &Partial) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Partial {
    fn cmp(&self, other: &Partial) -> std::cmp::Ordering {
        self.estimate.total_cmp(&other.estimate).then_with(|| self.sections.cmp(&other.sections))
    }
}

struct Search<'a> {
    graph: &'a Graph,
    /// For each node the time that it takes [s], and its length [m].
    times: Vec<f64>,
    lengths: Vec<f64>,
    /// For each node its section.
    sections: Vec<u32>,
    /// For each node the least time from its beginning to the end of the goal [s].
    remaining: Vec<f64>,
    goal: NodeIndex,
}

impl<'a> Search<'a> {
    fn new(map: &'a Map, goal: NodeIndex) -> Search<'a> {
        let Map { graph, network, .. } = map;
        let lanelet = |network: &'a Network, it: &Node| &network.lanelets[it.lanelet.at()];
        let lengths: Vec<f64> = graph.nodes.iter().map(|it| lanelet(network, it).length()).collect();
        let limits = graph.nodes.iter().map(|it| lanelet(network, it).speed_limit);
        let times: Vec<f64> = lengths.iter().zip(limits).map(|(length, limit)| length / limit).collect();
        let remaining = remaining(graph, &times, goal);
        Search {
            graph,
            times,
            lengths,
            sections: joined(graph, &sections(graph, |it| [it.left, it.right])),
            remaining,
            goal,
        }
    }

    fn start(&self, from: NodeIndex) -> Partial {
        let costs = self.spread(vec![(from, 0.0)]);
        self.partial(vec![self.sections[from.at()]], costs)
    }

    fn partial(&self, sections: Vec<u32>, costs: Vec<(NodeIndex, f64)>) -> Partial {
        let estimate = costs.iter().map(|(node, cost)| cost + self.remaining[node.at()]);
        Partial { estimate: estimate.fold(f64::INFINITY, f64::min), sections, costs }
    }

    /// The ways that are a section longer, as far as they lead to the goal.
    fn onward(&self, partial: &Partial) -> Vec<Partial> {
        let mut next: Vec<(u32, NodeIndex, f64)> = Vec::new();
        for (node, cost) in &partial.costs {
            let there = cost + self.times[node.at()];
            let following = &self.graph.nodes[node.at()].following;
            next.extend(following.iter().map(|it| (self.sections[it.at()], *it, there)));
        }
        next.retain(|(section, ..)| !partial.sections.contains(section));
        next.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.cmp(&b.1)).then(a.2.total_cmp(&b.2)));
        let entries = next.chunk_by(|a, b| a.0 == b.0).map(|same| {
            let costs = self.spread(same.iter().map(|(_, node, cost)| (*node, *cost)).collect());
            let sections = partial.sections.iter().copied().chain([same[0].0]).collect();
            self.partial(sections, costs)
        });
        entries.filter(|it| it.estimate.is_finite()).collect()
    }

    /// All nodes that can be reached from these by lane changes, with the least cost of each.
    fn spread(&self, entered: Vec<(NodeIndex, f64)>) -> Vec<(NodeIndex, f64)> {
        let mut costs: Vec<(NodeIndex, f64)> = Vec::new();
        let mut open = entered;
        while let Some((node, cost)) = open.pop() {
            match costs.iter_mut().find(|it| it.0 == node) {
                Some((_, known)) if *known <= cost => continue,
                Some((_, known)) => *known = cost,
                None => costs.push((node, cost)),
            }
            open.extend(self.beside(node).map(|(other, _)| (other, cost + CHANGE)));
        }
        costs.sort_by_key(|it| it.0);
        costs
    }

    fn beside(&self, node: NodeIndex) -> impl Iterator<Item = (NodeIndex, By)> {
        let it = &self.graph.nodes[node.at()];
        it.left.map(|it| (it, By::Left)).into_iter().chain(it.right.map(|it| (it, By::Right)))
    }

    /// The best way from `from` to the goal through these sections.
    fn route(&self, from: NodeIndex, sections: &[u32]) -> Option<Route> {
        // For each section the nodes that can be reached, from the first section on.
        let mut reached = vec![self.spread(vec![(from, 0.0)])];
        for section in &sections[1..] {
            let partial = Partial { estimate: 0.0, sections: Vec::new(), costs: reached.last()?.clone() };
            let next = self.onward(&partial).into_iter().find(|it| it.sections == [*section])?;
            reached.push(next.costs);
        }
        // Back from the goal, always to where the costs came from.
        let mut steps = Vec::new();
        let mut node = self.goal;
        for (level, costs) in reached.iter().enumerate().rev() {
            let cost = |of: NodeIndex| costs.iter().find(|it| it.0 == of).map(|it| it.1);
            let entered = |node: NodeIndex| -> Option<NodeIndex> {
                let before = reached.get(level.checked_sub(1)?)?;
                let previous = self.graph.nodes[node.at()].previous.iter().copied();
                previous.clone().find(|it| {
                    let there = before.iter().find(|entry| entry.0 == *it);
                    there.is_some_and(|(_, cost_there)| Some(cost_there + self.times[it.at()]) == cost(node))
                })
            };
            loop {
                let is_entry = if level == 0 { node == from } else { entered(node).is_some() };
                if is_entry {
                    steps.push(Step { node, by: By::Following });
                    break;
                }
                let own = cost(node)?;
                let (before, by) = costs.iter().find_map(|(other, cost)| {
                    let (_, by) = self.beside(*other).find(|it| it.0 == node)?;
                    (cost + CHANGE == own).then_some((*other, by))
                })?;
                steps.push(Step { node, by });
                node = before;
            }
            node = entered(node).unwrap_or(from);
        }
        steps.reverse();
        Some(self.measured(steps))
    }

    /// The fastest way from `from`, from where one leads to the goal.
    fn fastest(&self, from: NodeIndex) -> Route {
        let mut steps = vec![Step { node: from, by: By::Following }];
        let mut node = from;
        while node != self.goal {
            let left = self.remaining[node.at()];
            let following = self.graph.nodes[node.at()].following.iter();
            let onward = following.map(|it| (*it, By::Following, self.times[node.at()]));
            let beside = self.beside(node).map(|(it, by)| (it, by, CHANGE));
            let next = onward.chain(beside).find(|(it, _, cost)| self.remaining[it.at()] + cost == left);
            let Some((next, by, _)) = next else { break };
            steps.push(Step { node: next, by });
            node = next;
        }
        self.measured(steps)
    }

    fn measured(&self, steps: Vec<Step>) -> Route {
        // Of the lanelets of one section only the last one is driven to its end.
        let driven = steps.iter().zip(steps.iter().skip(1).map(|it| it.by).chain([By::Following]));
        let driven: Vec<NodeIndex> =
            driven.filter(|(_, next)| *next == By::Following).map(|(it, _)| it.node).collect();
        let sum = |of: &[f64]| driven.iter().map(|it| of[it.at()]).sum();
        Route { length: sum(&self.lengths), time: sum(&self.times), steps, variants: 1 }
    }
}

/// For each node a number that it shares with those `beside` it, either way.
fn sections<const N: usize>(graph: &Graph, beside_of: impl Fn(&Node) -> [Option<NodeIndex>; N]) -> Vec<u32> {
    const NONE: u32 = u32::MAX;
    let mut beside: Vec<Vec<NodeIndex>> = vec![Vec::new(); graph.nodes.len()];
    for (here, node) in graph.nodes.iter().enumerate() {
        for there in beside_of(node).into_iter().flatten() {
            beside[here].push(there);
            beside[there.at()].push(NodeIndex(here as u32));
        }
    }
    let mut sections = vec![NONE; graph.nodes.len()];
    for first in 0..graph.nodes.len() {
        let mut open = vec![first];
        while let Some(node) = open.pop() {
            if sections[node] == NONE {
                sections[node] = first as u32;
                open.extend(beside[node].iter().map(|it| it.at()));
            }
        }
    }
    sections
}

/// Sections with one number for those that lead from the same sections to the same sections.
fn joined(graph: &Graph, sections: &[u32]) -> Vec<u32> {
    let mut around: HashMap<u32, [BTreeSet<u32>; 2]> = HashMap::new();
    for (node, section) in graph.nodes.iter().zip(sections) {
        let [before, after] = around.entry(*section).or_default();
        before.extend(node.previous.iter().map(|it| sections[it.at()]));
        after.extend(node.following.iter().map(|it| sections[it.at()]));
    }
    let mut first: HashMap<&[BTreeSet<u32>; 2], u32> = HashMap::new();
    let number = sections.iter().map(|section| match &around[section] {
        // What begins or ends at the edge of the map leads nowhere in common.
        [before, after] if before.is_empty() || after.is_empty() => *section,
        both => *first.entry(both).or_insert(*section),
    });
    number.collect()
}

/// For each node the least time from its beginning to the end of `goal` [s]; infinite where no way leads there (Dijkstra).
fn remaining(graph: &Graph, times: &[f64], goal: NodeIndex) -> Vec<f64> {
    let mut beside: Vec<Vec<NodeIndex>> = vec![Vec::new(); graph.nodes.len()];
    for (here, node) in graph.nodes.iter().enumerate() {
        for there in [node.left, node.right].into_iter().flatten() {
            beside[there.at()].push(NodeIndex(here as u32));
        }
    }
    let mut remaining = vec![f64::INFINITY; graph.nodes.len()];
    // Times are positive, so their bits are in their order.
    let mut open = BinaryHeap::from([Reverse((times[goal.at()].to_bits(), goal))]);
    while let Some(Reverse((bits, node))) = open.pop() {
        let time = f64::from_bits(bits);
        if time >= remaining[node.at()] {
            continue;
        }
        remaining[node.at()] = time;
        let previous = &graph.nodes[node.at()].previous;
        open.extend(previous.iter().map(|it| Reverse(((time + times[it.at()]).to_bits(), *it))));
        open.extend(beside[node.at()].iter().map(|it| Reverse(((time + CHANGE).to_bits(), *it))));
    }
    remaining
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::{Motorway, motorway};

    fn map(road: &Motorway) -> Map {
        motorway(road).unwrap().build().unwrap()
    }

    fn node(map: &Map, id: i64) -> NodeIndex {
        NodeIndex(map.network.lanelets.iter().position(|it| it.id == id).unwrap() as u32)
    }

    #[test]
    fn a_road_is_one_way_whatever_lanes_are_changed() {
        let map = map(&Motorway { lanes: 2, length_m: 500.0, ..Motorway::default() });
        // Lanelets are numbered row by row, from the slow lane to the fast one.
        let found = routes(&map, node(&map, 1), node(&map, 10), Sense::default());
        assert_eq!(found.len(), 1);
        assert!((found[0].length - 500.0).abs() < 1e-9);
        assert!((found[0].time - 500.0 / (120.0 / 3.6)).abs() < 1e-9);
        assert_eq!(found[0].steps.iter().filter(|it| it.by == By::Left).count(), 1);
        assert_eq!(found[0].steps.iter().filter(|it| it.by == By::Right).count(), 0);
        let straight = &routes(&map, node(&map, 2), node(&map, 10), Sense::default())[0];
        let ids: Vec<i64> = straight
            .steps
            .iter()
            .map(|it| map.network.lanelets[map.graph.nodes[it.node.at()].lanelet.at()].id)
            .collect();
        assert_eq!(ids, [2, 4, 6, 8, 10]);
    }

    #[test]
    fn there_is_a_way_exactly_where_the_graph_leads() {
        let road = Motorway {
            on_ramp_at: vec![500.0],
            off_ramp_at: vec![1500.0],
            length_m: 2500.0,
            ..Motorway::default()
        };
        let map = map(&road);
        for to in (0..map.graph.nodes.len() as u32).map(NodeIndex) {
            let search = Search::new(&map, to);
            for from in (0..map.graph.nodes.len() as u32).step_by(7).map(NodeIndex) {
                let leads = search.remaining[from.at()].is_finite();
                assert_eq!(!routes(&map, from, to, Sense::default()).is_empty(), leads);
                if leads {
                    let fastest = search.fastest(from);
                    assert_eq!((fastest.steps[0].node, fastest.steps.last().unwrap().node), (from, to));
                }
            }
        }
    }

    #[test]
    fn ways_over_the_same_roads_are_named_once_and_counted() {
        let grid = crate::generate::own_maps().unwrap().into_iter().find(|it| it.0 == "grid.osm").unwrap();
        let map = grid.1.build().unwrap();
        let roads = joined(
            &map.graph,
            &sections(&map.graph, |it| [it.left, it.right, it.adjacent_left, it.adjacent_right]),
        );
        let first = |chain: &laneweave_network::ChainIndex| map.network.chain(*chain).lanelets[0];
        let last = |chain: &laneweave_network::ChainIndex| map.network.chain(*chain).lanelets.last().copied();
        let from = NodeIndex(first(&map.network.entrances[0].chains[0]).0);
        let mut variants = 0;
        for exit in &map.network.exits {
            let to = NodeIndex(last(&exit.chains[0]).unwrap().0);
            let found = routes(&map, from, to, Sense::default());
            let mut over: Vec<Vec<u32>> = Vec::new();
            for route in &found {
                let mut roads: Vec<u32> = route.steps.iter().map(|it| roads[it.node.at()]).collect();
                roads.dedup();
                assert!(!over.contains(&roads), "{route:?}");
                over.push(roads);
                variants += route.variants - 1;
            }
        }
        assert!(variants > 0);
    }

    #[test]
    fn nobody_drives_backwards() {
        let map = map(&Motorway { length_m: 500.0, ..Motorway::default() });
        assert!(routes(&map, node(&map, 13), node(&map, 1), Sense::default()).is_empty());
    }

    #[test]
    fn every_step_follows_on_the_one_before() {
        let road = Motorway {
            on_ramp_at: vec![500.0],
            off_ramp_at: vec![1500.0],
            length_m: 3000.0,
            ..Motorway::default()
        };
        let map = map(&road);
        let starts = map.network.entrances.iter().flat_map(|it| &it.chains);
        for start in starts.map(|it| map.network.chain(*it).lanelets[0]) {
            for end in map.network.exits.iter().flat_map(|it| &it.chains) {
                let end = *map.network.chain(*end).lanelets.last().unwrap();
                let found = routes(&map, NodeIndex(start.0), NodeIndex(end.0), Sense::default());
                assert_eq!(found.len(), 1);
                assert_eq!(found[0].steps[0], Step { node: NodeIndex(start.0), by: By::Following });
                assert_eq!(found[0].steps.last().unwrap().node, NodeIndex(end.0));
                for pair in found[0].steps.windows(2) {
                    let before = &map.graph.nodes[pair[0].node.at()];
                    match pair[1].by {
                        By::Following => assert!(before.following.contains(&pair[1].node)),
                        By::Left => assert_eq!(before.left, Some(pair[1].node)),
                        By::Right => assert_eq!(before.right, Some(pair[1].node)),
                    }
                }
            }
        }
    }
}
