//! The routing graph of a map as JSON.

use std::collections::BTreeMap;

use laneweave_maps::{Graph, Map, Node, NodeIndex};
use laneweave_network::{Id, LaneletIndex};
use serde::{Serialize, Serializer};

/// The routing graph of a map, which becomes one JSON object keyed by the id of each lanelet.
pub struct GraphJson<'a>(pub &'a Map);

/// The links of a lanelet; ids, or null.
#[derive(Serialize)]
struct Entry {
    following: Vec<Id>,
    previous: Vec<Id>,
    conflicting: Vec<Id>,
    left: Option<Id>,
    right: Option<Id>,
    adjacent_left: Option<Id>,
    adjacent_right: Option<Id>,
    length_m: f64,
    speed_limit_mps: f64,
    /// The links of the lanelet driven backwards; only for two-way lanelets.
    #[serde(skip_serializing_if = "Option::is_none")]
    backward: Option<Links>,
}

/// The links of a lanelet driven backwards.
#[derive(Serialize)]
struct Links {
    following: Vec<Id>,
    previous: Vec<Id>,
    left: Option<Id>,
    right: Option<Id>,
    adjacent_left: Option<Id>,
    adjacent_right: Option<Id>,
}

impl GraphJson<'_> {
    fn id(&self, lanelet: LaneletIndex) -> Id {
        self.0.network.lanelets[lanelet.at()].id
    }

    fn node_id(&self, node: NodeIndex) -> Id {
        self.id(self.0.graph.nodes[node.at()].lanelet)
    }

    fn links(&self, node: &Node) -> Links {
        let id = |it: Option<NodeIndex>| it.map(|it| self.node_id(it));
        let ids = |nodes: &[NodeIndex]| sorted(nodes.iter().map(|it| self.node_id(*it)));
        Links {
            following: ids(&node.following),
            previous: ids(&node.previous),
            left: id(node.left),
            right: id(node.right),
            adjacent_left: id(node.adjacent_left),
            adjacent_right: id(node.adjacent_right),
        }
    }

    fn entry(&self, lanelet: LaneletIndex) -> Entry {
        let Graph { nodes, conflicting } = &self.0.graph;
        let Links { following, previous, left, right, adjacent_left, adjacent_right } =
            self.links(&nodes[lanelet.at()]);
        let it = &self.0.network.lanelets[lanelet.at()];
        Entry {
            following,
            previous,
            conflicting: sorted(conflicting[lanelet.at()].iter().map(|it| self.id(*it))),
            left,
            right,
            adjacent_left,
            adjacent_right,
            length_m: it.length(),
            speed_limit_mps: it.speed_limit,
            backward: self.0.graph.backward(lanelet).map(|it| self.links(&nodes[it.at()])),
        }
    }
}

/// Ids in order, each once.
fn sorted(ids: impl Iterator<Item = Id>) -> Vec<Id> {
    let mut ids: Vec<Id> = ids.collect();
    ids.sort_unstable();
    ids.dedup();
    ids
}

impl Serialize for GraphJson<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let lanelets = 0..self.0.network.lanelets.len() as u32;
        let by_id: BTreeMap<Id, LaneletIndex> =
            lanelets.map(LaneletIndex).map(|it| (self.id(it), it)).collect();
        serializer.collect_map(by_id.into_iter().map(|(id, lanelet)| (id, self.entry(lanelet))))
    }
}
