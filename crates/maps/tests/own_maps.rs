//! The maps in the folder `maps`, and what the generator draws.

use std::fs;
use std::path::{Path, PathBuf};

use laneweave_maps::generate::{Motorway, motorway, own_maps};
use laneweave_maps::{Map, ReadOptions, lanelet2, load};
use laneweave_network::{DrivingSide, LaneletIndex, Network};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../maps")
}

fn network(of: &Motorway) -> Network {
    let drawing = motorway(of).expect("the motorway is possible");
    let Map { network, problems, .. } = drawing.build().expect("the drawing is sound");
    assert!(problems.is_empty());
    network
}

fn by_text(of: &Motorway) -> Map {
    let text = lanelet2::write(&motorway(of).expect("the motorway is possible"));
    lanelet2::read(text.as_bytes(), &ReadOptions::default()).expect("the text is a map")
}

fn everything() -> Motorway {
    Motorway {
        length_m: 4000.0,
        lane_width_m: 3.75,
        on_ramp_at: vec![700.0, 3100.0],
        off_ramp_at: vec![1500.0],
        lane_drop_at: Some(2345.678),
        ..Motorway::default()
    }
}

#[test]
fn the_files_are_what_the_generator_draws() {
    for (name, of) in own_maps() {
        let file = fs::read_to_string(folder().join(name)).unwrap();
        let drawn = lanelet2::write(&motorway(&of).unwrap());
        assert!(file == drawn, "{name} differs; run `cargo run -p laneweave-maps --example own_maps`");
    }
}

#[test]
fn the_files_have_the_entrances_exits_and_drops_they_are_named_after() {
    let mut found = Vec::new();
    for (name, _) in own_maps() {
        let Map { network, problems, origin, .. } =
            load(&folder().join(name), &ReadOptions::default()).unwrap();
        assert!(problems.is_empty() && origin.is_none());
        let lanes =
            |gates: &[laneweave_network::Gate]| gates.iter().map(|it| it.chains.len()).collect::<Vec<_>>();
        found.push((name, lanes(&network.entrances), lanes(&network.exits), network.lane_drops.len()));
    }
    let expected: [(&str, &[usize], &[usize], usize); 7] = [
        ("motorway_2_lanes.osm", &[2], &[2], 0),
        ("motorway_3_lanes.osm", &[3], &[3], 0),
        ("motorway_4_lanes.osm", &[4], &[4], 0),
        ("on_ramp.osm", &[3, 1], &[3], 1),
        ("off_ramp.osm", &[3], &[3, 1], 0),
        ("lane_drop.osm", &[3], &[2], 1),
        ("ramps.osm", &[3, 1], &[3, 1, 1], 1),
    ];
    for (found, expected) in found.iter().zip(expected) {
        assert_eq!((found.0, &found.1[..], &found.2[..], found.3), expected);
    }
}

#[test]
fn a_drawing_and_its_text_make_the_same_network_bit_for_bit() {
    for of in [everything(), Motorway { driving_side: DrivingSide::Left, ..everything() }] {
        let map = by_text(&of);
        assert!(map.problems.is_empty());
        assert_eq!(map.network.driving_side, of.driving_side);
        assert_eq!(format!("{:?}", map.network), format!("{:?}", network(&of)));
    }
}

#[test]
fn driving_on_the_left_is_the_mirror_image() {
    let right = network(&everything());
    let left = network(&Motorway { driving_side: DrivingSide::Left, ..everything() });
    assert_eq!(right.lanelets.len(), left.lanelets.len());
    for (a, b) in right.lanelets.iter().zip(&left.lanelets) {
        assert_eq!((a.id, a.speed_limit, &a.following), (b.id, b.speed_limit, &b.following));
        assert_eq!((a.left, a.right), (b.right, b.left));
        assert_eq!((a.adjacent_left, a.adjacent_right), (b.adjacent_right, b.adjacent_left));
        for (here, there) in [(&a.left_border, &b.right_border), (&a.right_border, &b.left_border)] {
            assert_eq!(here.points().len(), there.points().len());
            for (p, q) in here.points().iter().zip(there.points()) {
                assert_eq!((p.x.to_bits(), (-p.y).to_bits()), (q.x.to_bits(), q.y.to_bits()));
            }
        }
        assert!((a.length() - b.length()).abs() < 1e-9);
    }
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
