//! The sensible routes from one lanelet of a map to another, as plain data.

use laneweave_maps::{By, Map, NodeIndex, Route, Sense, routes};
use laneweave_network::{Id, LaneletIndex};
use laneweave_scenario::{Fault, FaultKind, did_you_mean};
use serde::Serialize;

/// A way: its lanelets in order. Of lanelets between which lanes are changed only the last counts as driven.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Way {
    /// Its length [m].
    pub length_m: f64,
    /// Travel time at the speed limits [s].
    pub free_travel_time_s: f64,
    /// Lane changes on it.
    pub lane_changes: usize,
    /// Ways over the same roads that were found, which differ in their lanes: this one and slower ones.
    pub variants: usize,
    /// Its lanelets.
    pub lanelets: Vec<Leg>,
}

/// A lanelet of a way.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Leg {
    /// Its id.
    pub id: Id,
    /// `following`, or the side of the lane change by which it is reached.
    pub by: &'static str,
    /// It is driven against its direction.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub backward: bool,
}

/// The sensible ways from the lanelet with the id `from` to that with the id `to`, the fastest first.
///
/// # Errors
/// If there is no such lanelet.
pub fn ways(map: &Map, from: Id, to: Id, sense: Sense) -> Result<Vec<Way>, Fault> {
    let [from, to] = [find(map, "FROM", from)?, find(map, "TO", to)?];
    // Two-way lanelets may be driven either way.
    let pairs = from.iter().flat_map(|from| to.iter().map(move |to| (*from, *to)));
    let mut found: Vec<Route> = pairs.flat_map(|(from, to)| routes(map, from, to, sense)).collect();
    found.sort_by(|a, b| a.time.total_cmp(&b.time));
    found.truncate(sense.most);
    Ok(found.iter().map(|it| Way::of(it, map)).collect())
}

/// The nodes of the lanelet with this id.
fn find(map: &Map, name: &str, id: Id) -> Result<Vec<NodeIndex>, Fault> {
    let lanelets = &map.network.lanelets;
    let place = lanelets.iter().position(|it| it.id == id).map(|it| it as u32);
    let nodes = place.map(|it| {
        let backward = map.graph.backward(LaneletIndex(it));
        [NodeIndex(it)].into_iter().chain(backward).collect()
    });
    nodes.ok_or_else(|| {
        let known: Vec<String> = lanelets.iter().map(|it| it.id.to_string()).collect();
        let remedy = did_you_mean(&id.to_string(), known.iter().map(String::as_str));
        let fault = Fault::new(name, format!("this map has no lanelet {id} for vehicles"), remedy);
        fault.of_kind(FaultKind::NotFound)
    })
}

impl Way {
    fn of(route: &Route, map: &Map) -> Way {
        let legs = route.steps.iter().map(|step| {
            let node = &map.graph.nodes[step.node.at()];
            Leg {
                id: map.network.lanelets[node.lanelet.at()].id,
                by: match step.by {
                    By::Following => "following",
                    By::Left => "left",
                    By::Right => "right",
                },
                backward: node.is_backward,
            }
        });
        Way {
            length_m: route.length,
            free_travel_time_s: route.time,
            variants: route.variants,
            lane_changes: route.steps.iter().filter(|it| it.by != By::Following).count(),
            lanelets: legs.collect(),
        }
    }
}
