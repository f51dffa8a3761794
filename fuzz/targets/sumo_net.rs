//! Road networks of SUMO: no bytes make the reader panic or take long, and every link of the graph has two ends.

#![no_main]

use laneweave_maps::{NodeIndex, ReadOptions, sumo};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let Ok(map) = sumo::read(bytes, &ReadOptions::default()) else { return };
    assert_eq!(map.graph.nodes.len(), map.network.lanelets.len());
    for (index, node) in map.graph.nodes.iter().enumerate() {
        let here = NodeIndex(index as u32);
        assert!(node.following.iter().all(|it| map.graph.nodes[it.at()].previous.contains(&here)));
    }
});
