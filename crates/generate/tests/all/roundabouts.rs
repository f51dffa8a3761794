//! Roundabouts of one and two lanes with three to six arms.

use std::collections::HashSet;

use laneweave_generate::{Roundabout, roundabout};
use laneweave_network::{ChainIndex, Network};

/// The chains that can be reached from one without changing lanes.
fn reachable(network: &Network, from: ChainIndex) -> HashSet<ChainIndex> {
    let (mut reached, mut open) = (HashSet::new(), vec![from]);
    while let Some(here) = open.pop() {
        if reached.insert(here) {
            open.extend(&network.chain(here).following);
        }
    }
    reached
}

#[test]
fn a_roundabout_has_its_arms_and_lanes_and_every_lane_leads_to_every_arm() {
    for (arms, lanes) in [(3, 1), (5, 1), (6, 1), (3, 2), (4, 2), (6, 2)] {
        let drawing = roundabout(&Roundabout { arms, lanes, ..Roundabout::default() }).unwrap();
        let map = drawing.build().expect("the drawing is sound");
        assert!(map.problems.is_empty());
        let Network { entrances, exits, .. } = &map.network;
        assert_eq!([entrances.len(), exits.len(), map.rules.len()], [arms; 3]);
        assert!(entrances.iter().chain(exits).all(|it| it.chains.len() == lanes));
        for entrance in entrances.iter().flat_map(|it| &it.chains) {
            let reached = reachable(&map.network, *entrance);
            let is_reached = |exit: &Vec<ChainIndex>| exit.iter().any(|it| reached.contains(it));
            assert!(exits.iter().all(|it| is_reached(&it.chains)), "{arms} arms, {lanes} lanes");
        }
    }
}

#[test]
fn a_roundabout_that_cannot_be_drawn_is_refused() {
    let refused = |arms, lanes, radius_m| {
        roundabout(&Roundabout { arms, lanes, radius_m, ..Roundabout::default() }).unwrap_err().to_string()
    };
    assert_eq!(refused(2, 1, None), "2 arms; choose 3 to 6");
    assert_eq!(refused(4, 3, None), "3 lanes; choose 1 to 2");
    assert!(refused(6, 1, Some(15.0)).starts_with("a radius of 15 m; choose 22."));
    assert!(refused(4, 1, Some(f64::NAN)).starts_with("a radius of NaN m"));
}
