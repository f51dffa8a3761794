use laneweave_network::{DrivingSide, Position};

use super::*;
use crate::route::ways::tests::lanelet;

#[test]
fn of_two_equal_ways_drivers_go_that_of_the_smaller_lanelet_id_however_chains_are_stored() {
    let network = |[one, other]: [i64; 2]| {
        let (first, last) = (lanelet(1, [0.0, 100.0], &[1, 2]), lanelet(9, [200.0, 300.0], &[]));
        let between = [one, other].map(|id| lanelet(id, [100.0, 200.0], &[3]));
        let [one, other] = between;
        Network::new(vec![first, one, other, last], DrivingSide::Right).unwrap()
    };
    for ids in [[4, 5], [5, 4]] {
        for network in [network(ids), network(ids).with_chains_reversed()] {
            let start = network.entrances[0].chains[0];
            let waypoint = *Navigator::new(&network).waypoint(Some(0), start);
            assert_eq!(network.lanelet_at(Position::new(waypoint.next.unwrap(), 0.0)).0.id, 4);
            assert_eq!((waypoint.time, waypoint.distance, waypoint.changes), (30.0, 300.0, 0));
        }
    }
}
