//! The drawings of the motorway generator.

use laneweave_generate::{Motorway, Weaving, motorway};
use laneweave_network::{LaneletIndex, Network};

fn network(of: &Motorway) -> Network {
    let map = motorway(of).expect("the motorway is possible").build().expect("the drawing is sound");
    assert!(map.problems.is_empty());
    map.network
}

#[test]
fn a_motorway_has_rows_of_lanes_with_changes_between_them() {
    let network = network(&Motorway { length_m: 1000.0, ..Motorway::default() });
    assert_eq!(network.lanelets.len(), 30);
    let index = |it: usize| Some(LaneletIndex(it as u32));
    for (row, lanelets) in network.lanelets.chunks(3).enumerate() {
        let first = 3 * row;
        let around: Vec<_> = lanelets.iter().map(|it| (it.right, it.left)).collect();
        assert_eq!(
            around,
            [(None, index(first + 1)), (index(first), index(first + 2)), (index(first + 1), None)]
        );
        let next = if row == 9 { vec![] } else { vec![LaneletIndex(first as u32 + 3)] };
        assert_eq!(lanelets[0].following, next);
        assert!(lanelets.iter().all(|it| it.length() == 100.0 && it.width(50.0) == 3.5));
        assert!(lanelets.iter().all(|it| it.speed_limit == 120.0 / 3.6));
    }
    let slow = network.lanelets[0].centre.points()[0];
    assert_eq!((slow.x, slow.y), (0.0, 1.75));
}

#[test]
fn an_acceleration_lane_begins_as_a_ramp_and_ends_beside_the_slow_lane() {
    let network = network(&Motorway { on_ramp_at: vec![1000.0], ..Motorway::default() });
    let ramp = network.entrances[1].chains[0];
    let lanelet = &network.lanelets[network.chain(ramp).lanelets[0].at()];
    assert_eq!(lanelet.speed_limit, 80.0 / 3.6);
    assert!((lanelet.left, lanelet.adjacent_left) == (None, None));
    let chain = network.chain(ramp);
    // 200 m of ramp along the road, then 250 m of acceleration lane with the road's limit.
    assert!((450.0..451.5).contains(&chain.length), "{}", chain.length);
    assert_eq!(chain.limit(chain.length - 249.0), 120.0 / 3.6);
    assert_eq!(chain.limit(chain.length - 251.0), 80.0 / 3.6);
    assert_eq!(network.lane_drops, [ramp]);
    let stretch = chain.left.last().unwrap();
    assert_eq!((stretch.start, stretch.end), (chain.length - 250.0, chain.length));
    assert!(chain.right.is_empty());
}

#[test]
fn a_deceleration_lane_begins_beside_the_slow_lane_and_becomes_a_ramp() {
    let network = network(&Motorway { off_ramp_at: vec![1000.0], ..Motorway::default() });
    assert_eq!((network.entrances.len(), network.lane_drops.len()), (1, 0));
    let chain = network.chain(network.exits[1].chains[0]);
    assert_eq!((chain.left[0].start, chain.left[0].end), (0.0, 250.0));
    assert_eq!((chain.limit(249.0), chain.limit(251.0)), (120.0 / 3.6, 80.0 / 3.6));
    assert!((450.0..451.5).contains(&chain.length), "{}", chain.length);
}

#[test]
fn beyond_a_lane_drop_ramps_meet_the_lane_that_is_left() {
    let network =
        network(&Motorway { lane_drop_at: Some(1000.0), on_ramp_at: vec![2000.0], ..Motorway::default() });
    let ramp = network.chain(network.entrances[1].chains[0]);
    assert_eq!(ramp.centre.points().last().map(|it| (it.x, it.y)), Some((2250.0, 1.75)));
    assert!(!ramp.left.is_empty());
    assert_eq!(network.lane_drops.len(), 2);
}

#[test]
fn a_lane_of_a_weaving_section_begins_as_one_ramp_and_becomes_another() {
    let weaving = Some(Weaving { from_m: 1000.0, length_m: 450.0 });
    let network = network(&Motorway { lanes: 2, length_m: 2500.0, weaving, ..Motorway::default() });
    assert_eq!((network.entrances.len(), network.exits.len(), network.lane_drops.len()), (2, 2, 0));
    let (entrance, exit) = (network.entrances[1].chains[0], network.exits[1].chains[0]);
    assert_eq!(entrance, exit);
    let chain = network.chain(entrance);
    assert!((850.0..853.0).contains(&chain.length), "{}", chain.length);
    assert_eq!((chain.left.len(), chain.right.len()), (1, 0));
    let beside = &chain.left[0];
    assert!((beside.end - beside.start - 450.0).abs() < 1e-9);
    assert!((beside.other_start - 1000.0).abs() < 1e-9);
}
