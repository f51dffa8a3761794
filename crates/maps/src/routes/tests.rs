use laneweave_network::Id;
use std::path::Path;

use super::*;
use crate::{ReadOptions, load};

/// A map of the repository.
fn map(name: &str) -> Map {
    load(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../maps").join(name), &ReadOptions::default())
        .unwrap()
}

fn node(map: &Map, id: i64) -> NodeIndex {
    NodeIndex(map.network.lanelets.iter().position(|it| it.id == id).unwrap() as u32)
}

#[test]
fn a_road_is_one_way_whatever_lanes_are_changed() {
    let map = map("motorway_2_lanes.osm");
    // Lanelets are numbered row by row, from the slow lane to the fast one.
    let found = routes(&map, node(&map, 1), node(&map, 50), Sense::default());
    assert_eq!(found.len(), 1);
    assert!((found[0].length - 5000.0).abs() < 1e-9);
    assert!((found[0].time - 5000.0 / (120.0 / 3.6)).abs() < 1e-9);
    assert_eq!(found[0].steps.iter().filter(|it| it.by == By::Left).count(), 1);
    assert_eq!(found[0].steps.iter().filter(|it| it.by == By::Right).count(), 0);
    let straight = &routes(&map, node(&map, 2), node(&map, 50), Sense::default())[0];
    let ids: Vec<Id> = straight
        .steps
        .iter()
        .map(|it| map.network.lanelets[map.graph.nodes[it.node.at()].lanelet.at()].id)
        .collect();
    assert!(ids.into_iter().eq((2..=50).step_by(2)));
}

#[test]
fn cars_go_round_a_lanelet_that_is_not_for_them() {
    let mut map = map("motorway_2_lanes.osm");
    let ids = |map: &Map| -> Vec<Id> {
        let found = routes(map, node(map, 1), node(map, 49), Sense::default());
        let nodes = found.iter().flat_map(|it| &it.steps).map(|it| &map.graph.nodes[it.node.at()]);
        nodes.map(|it| map.network.lanelets[it.lanelet.at()].id).collect()
    };
    assert!(ids(&map).into_iter().eq((1..50).step_by(2)));
    map.network.lanelets[10].classes = laneweave_network::Classes::BUS_LANE;
    let round = ids(&map);
    assert!(!round.is_empty() && !round.contains(&map.network.lanelets[10].id), "{round:?}");
}

#[test]
fn there_is_a_way_exactly_where_the_graph_leads() {
    let map = map("ramps.osm");
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
    let map = map("grid.osm");
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
    let map = map("motorway_3_lanes.osm");
    assert!(routes(&map, node(&map, 13), node(&map, 1), Sense::default()).is_empty());
}

#[test]
fn every_step_follows_on_the_one_before() {
    let map = map("on_ramp.osm");
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
