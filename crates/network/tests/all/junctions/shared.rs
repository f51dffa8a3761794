//! Lanes over the same area from edge to edge of a map.

use laneweave_network::{Network, ZoneKind};

use crate::junctions::widths::{eastward, entrances, lanelet, network};

/// The kind of the only zone, and its stretches [m].
fn only_zone(network: &Network) -> (ZoneKind, [[f64; 2]; 2]) {
    let [zone] = &network.junctions.zones[..] else { panic!("{:?}", network.junctions.zones) };
    (zone.kind, zone.sides.map(|it| [it.start, it.end]))
}

#[test]
fn two_directions_over_the_same_ground_from_edge_to_edge_take_turns_and_both_are_entered() {
    // On the same area, and on an area that they share by half.
    for shift in [0.0, 1.4] {
        let (left, right) = (1.65 - 0.5 * shift, -1.65 - 0.5 * shift);
        let there = lanelet(1, &[(0.0, left), (400.0, left)], &[(0.0, right), (400.0, right)]);
        let back = lanelet(2, &[(400.0, -left), (0.0, -left)], &[(400.0, -right), (0.0, -right)]);
        let network = network(vec![there, back]);
        let (kind, sides) = only_zone(&network);
        assert_eq!(kind, ZoneKind::Crossing);
        assert!(sides.iter().all(|it| it[0] < 1.0 && it[1] > 399.0), "{sides:?}");
        assert_eq!(entrances(&network), [1, 2]);
    }
}

#[test]
fn two_ways_that_begin_at_one_place_at_the_edge_merge_there_and_both_are_entered() {
    let up = lanelet(
        1,
        &[(0.0, 3.3), (20.0, 3.5), (40.0, 6.0), (80.0, 30.0)],
        &[(0.0, 0.0), (20.0, 0.2), (42.0, 2.8), (82.0, 27.0)],
    );
    let down = lanelet(
        2,
        &[(0.0, 3.3), (20.0, 3.1), (42.0, 0.5), (82.0, -24.0)],
        &[(0.0, 0.0), (20.0, -0.2), (40.0, -2.8), (80.0, -27.0)],
    );
    let network = network(vec![up, down]);
    let (kind, sides) = only_zone(&network);
    assert!(sides.iter().all(|it| it[0] == 0.0 && (20.0..60.0).contains(&it[1])), "{sides:?}");
    // They are one until the longest vehicle has left the area that they share.
    assert_eq!(kind, ZoneKind::Merging(sides.map(|it| it[1] + 12.0)));
    assert_eq!(entrances(&network), [1, 2]);
}

#[test]
fn vehicles_of_one_direction_whose_lanes_overlap_by_half_follow_each_other() {
    let network = network(vec![eastward(1, [0.0, 200.0], 0.0, 3.0), eastward(2, [0.0, 200.0], 1.5, 3.0)]);
    let (kind, sides) = only_zone(&network);
    assert!(matches!(kind, ZoneKind::Merging(_)), "{kind:?}");
    assert!(sides.iter().all(|it| it[0] == 0.0 && it[1] > 199.0), "{sides:?}");
}
