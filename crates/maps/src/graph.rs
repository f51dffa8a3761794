//! The routing graph: which lanelets follow each other, which lie side by side, and which conflict.

use laneweave_network::{Lanelet, LaneletIndex, Polygon};

use crate::conflict::conflicts;
use crate::drawing::{Drawing, Edge, Lane};
use crate::problem::Problem;

/// A lanelet's place in [`Graph::nodes`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct NodeIndex(pub u32);

impl NodeIndex {
    /// The place as an index.
    pub fn at(self) -> usize {
        self.0 as usize
    }
}

/// Where vehicles may go from each lanelet, in each direction in which it may be used.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Graph {
    /// First all lanelets in their own direction, in the order of the network, then the two-way ones backwards.
    pub nodes: Vec<Node>,
    /// For each lanelet of the network those with which it has common area, in order: seen from above, without those
    /// beside it along a common border and those that follow it. A two-way lanelet is in its own list.
    pub conflicting: Vec<Vec<LaneletIndex>>,
}

/// A lanelet in one direction of travel.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// The lanelet.
    pub lanelet: LaneletIndex,
    /// Whether it is driven against its own direction.
    pub is_backward: bool,
    /// What begins where it ends.
    pub following: Vec<NodeIndex>,
    /// What ends where it begins.
    pub previous: Vec<NodeIndex>,
    /// The node beside it on the left, if a change there is allowed.
    pub left: Option<NodeIndex>,
    /// The node beside it on the right, if a change there is allowed.
    pub right: Option<NodeIndex>,
    /// The node beside it on the left to which no change is allowed.
    pub adjacent_left: Option<NodeIndex>,
    /// The node beside it on the right to which no change is allowed.
    pub adjacent_right: Option<NodeIndex>,
}

impl Graph {
    /// The graph of lanelets that already have links, all of them driven in their own direction, and its problems.
    pub(crate) fn of(lanelets: &[Lanelet]) -> (Graph, Vec<Problem>) {
        let index = |it: LaneletIndex| NodeIndex(it.0);
        let mut nodes: Vec<Node> = (0..lanelets.len()).map(|it| node(it, false)).collect();
        for (here, lanelet) in lanelets.iter().enumerate() {
            for next in &lanelet.following {
                nodes[next.at()].previous.push(NodeIndex(here as u32));
            }
            let node = &mut nodes[here];
            node.following = lanelet.following.iter().copied().map(index).collect();
            [node.left, node.right] = [lanelet.left, lanelet.right].map(|it| it.map(index));
            [node.adjacent_left, node.adjacent_right] =
                [lanelet.adjacent_left, lanelet.adjacent_right].map(|it| it.map(index));
        }
        let outlines: Vec<Option<Polygon>> = lanelets.iter().map(outline).collect();
        let knows = |a: usize, b: usize| {
            let Lanelet { following, left, right, adjacent_left, adjacent_right, .. } = &lanelets[a];
            let beside = [left, right, adjacent_left, adjacent_right];
            following.iter().chain(beside.into_iter().flatten()).any(|it| it.at() == b)
        };
        let conflicts = conflicts(&outlines, |a, b| knows(a, b) || knows(b, a));
        let problems = conflicts.problems(|it| (lanelets[it.at()].id, None));
        (Graph { nodes, conflicting: conflicts.with }, problems)
    }

    /// The node of a lanelet driven backwards, if it may be.
    pub fn backward(&self, lanelet: LaneletIndex) -> Option<NodeIndex> {
        let forward = self.conflicting.len();
        let found = self.nodes[forward..].binary_search_by_key(&lanelet, |it| it.lanelet).ok();
        found.map(|it| NodeIndex((forward + it) as u32))
    }
}

/// The area of a lanelet.
fn outline(lanelet: &Lanelet) -> Option<Polygon> {
    let [left, right] = [&lanelet.left_border, &lanelet.right_border].map(|it| it.points());
    Polygon::new(left.iter().chain(right.iter().rev()).copied())
}

/// The links between `lanes`.
///
/// A lane follows another if it begins at the two points at which the other one ends. Lanes are neighbours if they
/// share a border and run along it in the same direction; of several neighbours on one side the first is taken.
pub(crate) fn nodes(drawing: &Drawing, lanes: &[Lane]) -> Vec<Node> {
    let (ways, mut nodes): (Vec<Way>, Vec<Node>) = ways(lanes).unzip();
    let starts = sorted(&ways, |way| drawing.starts(way.left, way.right));
    let left_edges = sorted(&ways, |way| way.left);
    let right_edges = sorted(&ways, |way| way.right);
    for (index, way) in ways.iter().enumerate() {
        let here = NodeIndex(index as u32);
        let beside = |edges: &[(Edge, NodeIndex)], edge| with(edges, edge).find(|it| *it != here);
        let (left, right) = (beside(&right_edges, way.left), beside(&left_edges, way.right));
        let to_left = drawing.crossing(way.left).to_left;
        let to_right = drawing.crossing(way.right).to_right;
        let following: Vec<NodeIndex> = with(&starts, drawing.finishes(way.left, way.right)).collect();
        for next in &following {
            nodes[next.at()].previous.push(here);
        }
        let node = &mut nodes[index];
        node.following = following;
        (node.left, node.adjacent_left) = if to_left { (left, None) } else { (None, left) };
        (node.right, node.adjacent_right) = if to_right { (right, None) } else { (None, right) };
    }
    nodes
}

/// The borders of a lane in a direction of travel.
struct Way {
    left: Edge,
    right: Edge,
}

/// All lanes forwards, then those that may be used backwards.
fn ways(lanes: &[Lane]) -> impl Iterator<Item = (Way, Node)> {
    let all = || lanes.iter().enumerate();
    let forward = all().map(|(index, lane)| (Way { left: lane.left, right: lane.right }, node(index, false)));
    let backward = all().filter(|(_, lane)| lane.is_two_way).map(|(index, lane)| {
        (Way { left: lane.right.reversed(), right: lane.left.reversed() }, node(index, true))
    });
    forward.chain(backward)
}

fn node(lanelet: usize, is_backward: bool) -> Node {
    Node {
        lanelet: LaneletIndex(lanelet as u32),
        is_backward,
        following: Vec::new(),
        previous: Vec::new(),
        left: None,
        right: None,
        adjacent_left: None,
        adjacent_right: None,
    }
}

/// Values by `key`, and in their own order where that is equal.
fn sorted<K: Ord>(ways: &[Way], key: impl Fn(&Way) -> K) -> Vec<(K, NodeIndex)> {
    let mut all: Vec<_> =
        ways.iter().enumerate().map(|(index, way)| (key(way), NodeIndex(index as u32))).collect();
    all.sort_unstable();
    all
}

/// The values with `key`.
fn with<K: Ord>(ways: &[(K, NodeIndex)], key: K) -> impl Iterator<Item = NodeIndex> {
    let from = ways.partition_point(|(it, _)| *it < key);
    ways[from..].iter().take_while(move |(it, _)| *it == key).map(|(_, index)| *index)
}

/// A two-way lanelet conflicts with itself.
pub(crate) fn add_two_way(conflicting: &mut [Vec<LaneletIndex>], nodes: &[Node]) {
    for lanelet in nodes.iter().filter(|it| it.is_backward).map(|it| it.lanelet) {
        let own = &mut conflicting[lanelet.at()];
        own.insert(own.partition_point(|it| *it < lanelet), lanelet);
    }
}

/// Links `lanelets`, which belong to the forward `nodes`; simulated traffic uses lanelets in their own direction
/// only.
pub(crate) fn link(lanelets: &mut [Lanelet], nodes: &[Node]) {
    let forward = |it: NodeIndex| Some(&nodes[it.at()]).filter(|it| !it.is_backward).map(|it| it.lanelet);
    for (lanelet, node) in lanelets.iter_mut().zip(nodes) {
        lanelet.following = node.following.iter().copied().filter_map(forward).collect();
        lanelet.left = node.left.and_then(forward);
        lanelet.right = node.right.and_then(forward);
        lanelet.adjacent_left = node.adjacent_left.and_then(forward);
        lanelet.adjacent_right = node.adjacent_right.and_then(forward);
    }
}
