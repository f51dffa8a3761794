//! The sensible routes from one lanelet to another.
//!
//! Lanelets with lane changes between them are one *section* of road. So are lanelets that lead from the same section
//! to the same section, like lanes across a junction: routes that differ only in the places of lane changes are one
//! route. A route is sensible if it enters no section twice and takes not much longer than the best one. *Roads* are
//! sections side by side, whether or not a change between them is allowed. Of the routes over the same roads, the
//! fastest is returned, and the others are counted.

use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap};

use hashbrown::HashMap;
use laneweave_network::{Class, Lanelet, Network};

use crate::graph::{Graph, Node, NodeIndex};
use crate::map::Map;

/// A route through a map.
#[derive(Clone, Debug, PartialEq)]
pub struct Route {
    /// Its lanelets, each with the way it is reached.
    pub steps: Vec<Step>,
    /// From the beginning of the first lanelet to the end of the last one [m].
    pub length: f64,
    /// At the speed limits [s].
    pub time: f64,
    /// Number of routes over the same roads that differ in their lanes: this one and slower ones.
    pub variants: usize,
}

/// A lanelet of a route.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Step {
    /// Its node in the graph.
    pub node: NodeIndex,
    /// How it is reached.
    pub by: By,
}

/// How a lanelet is reached from the one before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum By {
    /// It follows, or is the first.
    Following,
    /// By a change to the left.
    Left,
    /// By a change to the right.
    Right,
}

/// The limits for sensible routes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sense {
    /// Maximum of routes that are returned.
    pub most: usize,
    /// Maximum ratio of their time to that of the best one.
    pub longest: f64,
}

impl Default for Sense {
    /// Ten routes, up to twice as long.
    fn default() -> Sense {
        Sense { most: 10, longest: 2.0 }
    }
}

/// Of routes with the same time, the one with the fewest changes is taken; a change counts so much [s].
const CHANGE: f64 = 1e-3;
/// Partial routes after which the search gives up.
const MOST_PARTIAL: usize = 200_000;

/// The sensible routes of cars from `from` to `to`, the fastest first.
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
        // Some routes lead back to where they began.
        return vec![search.fastest(from)];
    }
    found.into_iter().map(|(_, route)| route).collect()
}

/// A partial route.
struct Partial {
    /// Minimum time of the whole route [s].
    estimate: f64,
    sections: Vec<u32>,
    /// The nodes of the last section that can be reached, and the minimum time to the beginning of each [s].
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
    /// For each node its travel time by car [s], and its length [m].
    times: Vec<f64>,
    lengths: Vec<f64>,
    /// For each node its section.
    sections: Vec<u32>,
    /// For each node the minimum time from its beginning to the end of the goal [s].
    remaining: Vec<f64>,
    goal: NodeIndex,
}

impl<'a> Search<'a> {
    fn new(map: &'a Map, goal: NodeIndex) -> Search<'a> {
        let Map { graph, network, .. } = map;
        let lanelet = |network: &'a Network, it: &Node| &network.lanelets[it.lanelet.at()];
        let lengths: Vec<f64> = graph.nodes.iter().map(|it| lanelet(network, it).length()).collect();
        // No car ever gets over a lanelet that is not for cars.
        let time = |it: &Lanelet| {
            if it.classes.has(Class::Car) { it.length() / it.speed_limit } else { f64::INFINITY }
        };
        let times: Vec<f64> = graph.nodes.iter().map(|it| time(lanelet(network, it))).collect();
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

    /// The routes that are a section longer, if they can reach the goal.
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

    /// All nodes that can be reached from these by lane changes, with the minimum cost of each.
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

    /// The best route from `from` to the goal through these sections.
    fn route(&self, from: NodeIndex, sections: &[u32]) -> Option<Route> {
        // For each section the nodes that can be reached, beginning with the first section.
        let mut reached = vec![self.spread(vec![(from, 0.0)])];
        for section in &sections[1..] {
            let partial = Partial { estimate: 0.0, sections: Vec::new(), costs: reached.last()?.clone() };
            let next = self.onward(&partial).into_iter().find(|it| it.sections == [*section])?;
            reached.push(next.costs);
        }
        // Back from the goal, each time to the node from which the cost came.
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

    /// The fastest route from `from`, if one leads to the goal.
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

/// For each node a number that it shares with those `beside` it, in either direction.
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

/// Sections, with one number for those that lead from the same sections to the same sections.
fn joined(graph: &Graph, sections: &[u32]) -> Vec<u32> {
    let mut around: HashMap<u32, [BTreeSet<u32>; 2]> = HashMap::new();
    for (node, section) in graph.nodes.iter().zip(sections) {
        let [before, after] = around.entry(*section).or_default();
        before.extend(node.previous.iter().map(|it| sections[it.at()]));
        after.extend(node.following.iter().map(|it| sections[it.at()]));
    }
    let mut first: HashMap<&[BTreeSet<u32>; 2], u32> = HashMap::new();
    let number = sections.iter().map(|section| match &around[section] {
        // Lanelets that begin or end at the edge of the map have no common destination.
        [before, after] if before.is_empty() || after.is_empty() => *section,
        both => *first.entry(both).or_insert(*section),
    });
    number.collect()
}

/// For each node the minimum time from its beginning to the end of `goal` [s]; infinite where no route leads there
/// (Dijkstra).
fn remaining(graph: &Graph, times: &[f64], goal: NodeIndex) -> Vec<f64> {
    let mut beside: Vec<Vec<NodeIndex>> = vec![Vec::new(); graph.nodes.len()];
    for (here, node) in graph.nodes.iter().enumerate() {
        for there in [node.left, node.right].into_iter().flatten() {
            beside[there.at()].push(NodeIndex(here as u32));
        }
    }
    let mut remaining = vec![f64::INFINITY; graph.nodes.len()];
    // Times are positive, so their bits have the same order.
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
mod tests;
