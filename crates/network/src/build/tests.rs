use super::*;
use crate::gate::Gate;
use crate::geometry::{Point, Polyline};

fn lanelet(id: i64, from: f64, to: f64, lane: f64) -> Lanelet {
    let line = |y: f64| Polyline::new([Point::new(from, y, 0.0), Point::new(to, y, 0.0)]).unwrap();
    let (left_border, right_border) = (line(4.0 * lane + 4.0), line(4.0 * lane));
    let centre = Polyline::between(&left_border, &right_border).unwrap();
    Lanelet::alone(id, [left_border, right_border, centre], 30.0)
}

/// Two lanes of three lanelets each; the left lane's last one is missing, so it is a lane drop.
fn lane_drop() -> Network {
    let mut all: Vec<Lanelet> =
        (0..3).map(|i| lanelet(10 + i, 100.0 * i as f64, 100.0 * (i + 1) as f64, 0.0)).collect();
    all.extend((0..2).map(|i| lanelet(20 + i, 100.0 * i as f64, 100.0 * (i + 1) as f64, 1.0)));
    all[0].following = vec![LaneletIndex(1)];
    all[1].following = vec![LaneletIndex(2)];
    all[3].following = vec![LaneletIndex(4)];
    for i in 0..2 {
        all[i].left = Some(LaneletIndex(3 + i as u32));
        all[3 + i].right = Some(LaneletIndex(i as u32));
    }
    Network::new(all, DrivingSide::Right).unwrap()
}

#[test]
fn lanelets_join_to_chains_with_what_lies_beside() {
    let network = lane_drop();
    assert_eq!(network.chains.iter().map(|c| c.length).collect::<Vec<_>>(), [300.0, 200.0]);
    let beside = network.chains[0].beside(Side::Left, 150.0).unwrap();
    assert_eq!((beside.chain, beside.start, beside.end), (ChainIndex(1), 0.0, 200.0));
    assert_eq!(beside.across(150.0), 150.0);
    assert!(network.chains[0].beside(Side::Left, 250.0).is_none());
    assert!(network.chains[0].beside(Side::Right, 50.0).is_none());
    assert_eq!(network.chains[0].lanelet(250.0), (LaneletIndex(2), 50.0));
}

#[test]
fn a_lane_that_ends_beside_another_is_a_drop_and_no_exit() {
    let network = lane_drop();
    let names = |gates: &[Gate]| gates.iter().map(|g| (g.id, g.chains.len())).collect::<Vec<_>>();
    assert_eq!(names(&network.entrances), [(10.into(), 2)]);
    assert_eq!(names(&network.exits), [(12.into(), 1)]);
    assert_eq!(network.lane_drops, [ChainIndex(1)]);
}

#[test]
fn a_ring_is_one_chain_that_continues_itself() {
    let mut all = vec![lanelet(1, 0.0, 100.0, 0.0), lanelet(2, 100.0, 200.0, 0.0)];
    all[0].following = vec![LaneletIndex(1)];
    all[1].following = vec![LaneletIndex(0)];
    let network = Network::new(all, DrivingSide::Right).unwrap();
    assert_eq!(network.chains.len(), 1);
    assert_eq!(network.chains[0].following, [ChainIndex(0)]);
    assert!(network.entrances.is_empty() && network.exits.is_empty());
}

#[test]
fn reversing_the_storage_keeps_the_roads() {
    let network = lane_drop().with_chains_reversed();
    assert_eq!(network.chains[0].length, 200.0);
    assert_eq!(network.chains[1].left[0].chain, ChainIndex(0));
    assert_eq!(network.lane_drops, [ChainIndex(0)]);
}

#[test]
fn lanelets_that_make_no_network_are_refused() {
    assert_eq!(Network::new(vec![], DrivingSide::Right).err(), Some(NetworkError::Empty));
    let mut one = lanelet(7, 0.0, 10.0, 0.0);
    one.following = vec![LaneletIndex(3)];
    assert_eq!(Network::new(vec![one], DrivingSide::Right).err(), Some(NetworkError::Dangling(7.into())));
}
