//! A fork whose lanes overlap at first and lie side by side later, drawn without common borders and with one joint that
//! the graph does not know.

use laneweave_network::{DrivingSide, Id, Lanelet, LaneletIndex, Network, Point, Polyline, Side};
use laneweave_recordings::{LaneChange, Matched, Recording, RoadUser, State, Track, lane_changes};

const STEP: f64 = 0.2;
const WIDTH: f64 = 3.5;

/// A lanelet with its right border from `from` to `to`, and its left border `WIDTH` further up.
fn lanelet(id: i64, from: (f64, f64), to: (f64, f64), following: &[u32]) -> Lanelet {
    let line = |up: f64| {
        Polyline::new([Point::new(from.0, from.1 + up, 0.0), Point::new(to.0, to.1 + up, 0.0)])
            .expect("it is a line")
    };
    let (left_border, right_border) = (line(WIDTH), line(0.0));
    let centre = Polyline::between(&left_border, &right_border).expect("it is a lane");
    let following = following.iter().map(|it| LaneletIndex(*it)).collect();
    Lanelet { following, ..Lanelet::alone(id, [left_border, right_border, centre], 20.0) }
}

/// Lanelet 1 forks at 100 m into 2, which moves up by its width until 200 m, and 3, which goes straight on; 4 and 5
/// continue them side by side.
fn fork() -> Network {
    let lanelets = vec![
        lanelet(1, (0.0, 0.0), (100.0, 0.0), &[1, 2]),
        lanelet(2, (100.0, 0.0), (200.0, WIDTH), &[3]),
        lanelet(3, (100.0, 0.0), (200.0, 0.0), &[]),
        lanelet(4, (200.0, WIDTH), (400.0, WIDTH), &[]),
        lanelet(5, (200.0, 0.1), (400.0, 0.1), &[]),
    ];
    Network::new(lanelets, DrivingSide::Right).expect("it is a network")
}

/// A car at 15 m/s from 10 m on; `way` gives its y over the distance.
fn drive(way: impl Fn(f64) -> f64) -> Recording {
    let state = |frame: i64| {
        let x = 10.0 + 3.0 * frame as f64;
        State { frame, x, y: way(x), speed: 15.0, heading: ((way(x + 1.0) - way(x - 1.0)) / 2.0).atan() }
    };
    let states = (0..120).map(state).collect();
    Recording {
        step: STEP,
        tracks: vec![Track { id: 1, class: RoadUser::Car, length: 4.5, width: 1.8, states }],
        ..Recording::default()
    }
}

/// From 0 at `from` to 1 at `to`.
fn rise(x: f64, from: f64, to: f64) -> f64 {
    ((x - from) / (to - from)).clamp(0.0, 1.0)
}

fn seen(recording: &Recording) -> (Vec<i64>, Vec<LaneChange>) {
    let network = fork();
    let matched = Matched::new(&network, recording);
    let ids = matched.places[0].iter().flatten().map(|it| network.lanelets[it.lanelet.at()].id);
    let mut lanelets: Vec<i64> = ids.filter_map(Id::number).collect();
    lanelets.dedup();
    (lanelets, lane_changes(&matched))
}

#[test]
fn who_takes_either_branch_changes_no_lane() {
    let (upper, changes) = seen(&drive(|x| 1.75 + WIDTH * rise(x, 100.0, 200.0)));
    assert_eq!((upper, changes), (vec![1, 2, 4], vec![]));
    // The graph does not know that 5 continues 3.
    let (lower, changes) = seen(&drive(|_| 1.75));
    assert_eq!((lower, changes), (vec![1, 3, 5], vec![]));
}

#[test]
fn drifting_where_the_branches_overlap_is_no_lane_change() {
    // First along the middle of 2, then, while it is inside of both, back to 3.
    let way = |x: f64| 1.75 + 1.2 * rise(x, 100.0, 134.0) - 1.2 * rise(x, 140.0, 160.0);
    let (lanelets, changes) = seen(&drive(way));
    assert_eq!(changes, []);
    assert_eq!((lanelets[0], &lanelets[lanelets.len() - 2..]), (1, &[3, 5][..]));
}

#[test]
fn going_over_to_the_other_branch_where_they_overlap_is_no_lane_change() {
    // Slowly along the middle of 2, then to 3, shortly before a line divides them.
    let way = |x: f64| 1.75 + 1.65 * rise(x, 100.0, 130.0) - 0.8 * rise(x, 178.0, 188.0);
    let (lanelets, changes) = seen(&Recording { step: 1.0, ..drive(way) });
    assert_eq!((lanelets, changes), (vec![1, 2, 3, 5], vec![]));
}

#[test]
fn crossing_the_line_beyond_is_one_that_the_graph_does_not_know() {
    let way = |x: f64| 1.75 + WIDTH * rise(x, 100.0, 200.0) - WIDTH * rise(x, 270.0, 330.0);
    let (lanelets, changes) = seen(&drive(way));
    assert_eq!(lanelets, [1, 2, 4, 5]);
    let [change] = &changes[..] else { panic!("{changes:?}") };
    assert_eq!((change.side, change.along_graph, change.from.0, change.to.0), (Side::Right, false, 3, 4));
    // Halfway between the two borders, 3.5 m and 3.6 m up.
    assert!((change.x - 299.1).abs() < 0.3 && (change.y - 3.55).abs() < 0.02, "{change:?}");
}

#[test]
fn changes_that_the_graph_forbids_are_found_too() {
    let mut lanelets =
        vec![lanelet(1, (0.0, WIDTH), (400.0, WIDTH), &[]), lanelet(2, (0.0, 0.0), (400.0, 0.0), &[])];
    lanelets[0].adjacent_right = Some(LaneletIndex(1));
    lanelets[1].adjacent_left = Some(LaneletIndex(0));
    let network = Network::new(lanelets, DrivingSide::Right).unwrap();
    let recording = drive(|x| 1.75 + WIDTH * (rise(x, 80.0, 140.0) - rise(x, 220.0, 280.0)));
    let changes = lane_changes(&Matched::new(&network, &recording));
    let kinds: Vec<_> = changes.iter().map(|it| (it.side, it.along_graph, it.x.round())).collect();
    assert_eq!(kinds, [(Side::Left, false, 110.0), (Side::Right, false, 250.0)]);
}

#[test]
fn who_waits_where_lanes_cross_is_in_the_one_that_it_points_along() {
    let crossing = |turn: f64| {
        let (sin, cos) = turn.sin_cos();
        let turned = |line: &Polyline| {
            let points = line.points().iter().map(|it| {
                let (x, y) = (it.x - 100.0, it.y - 1.75);
                Point::new(cos * x - sin * y, sin * x + cos * y, 0.0)
            });
            Polyline::new(points).unwrap()
        };
        let straight = lanelet(1, (0.0, 0.0), (200.0, 0.0), &[]);
        let (left_border, right_border) = (turned(&straight.left_border), turned(&straight.right_border));
        Lanelet { centre: turned(&straight.centre), left_border, right_border, ..straight }
    };
    let network = Network::new(vec![crossing(0.0), crossing(0.8)], DrivingSide::Right).unwrap();
    for (heading, expected) in [(0.1, 0), (0.7, 1)] {
        // A metre beside the middle of the lane to which it is parallel, and in the middle of the other one.
        let way: f64 = if heading < 0.4 { 0.8 } else { 0.0 };
        let (sin, cos) = way.sin_cos();
        let along = 1.0 / 0.8_f64.sin();
        let state = |frame| State { frame, x: along * cos, y: along * sin, speed: 0.0, heading };
        let mut recording = drive(|_| 0.0);
        recording.tracks[0].states = (0..50).map(state).collect();
        let matched = Matched::new(&network, &recording);
        assert!(matched.places[0].iter().flatten().all(|it| it.lanelet.0 == expected), "{heading}");
        assert_eq!(matched.places[0].iter().flatten().count(), 50);
    }
}

#[test]
fn far_from_all_lanes_there_is_no_place() {
    let recording = drive(|x| if x < 250.0 { 1.75 } else { 1.75 - 0.3 * (x - 250.0) });
    let network = fork();
    let matched = Matched::new(&network, &recording);
    let is_placed = |frame: i64| !matched.frame(frame).is_empty();
    assert!(is_placed(79) && !is_placed(100) && !is_placed(119) && !is_placed(500));
}

#[test]
fn a_frame_lists_vehicles_in_driving_order_with_their_acceleration() {
    let network = fork();
    let mut recording = drive(|_| 2.0);
    let mut leader = Track { id: 2, ..recording.tracks[0].clone() };
    for state in &mut leader.states {
        state.x += 30.0;
        state.speed = 15.0 - 0.5 * state.frame as f64 * STEP;
    }
    let walker = Track { id: 3, class: RoadUser::Pedestrian, ..leader.clone() };
    recording.tracks = vec![leader, walker, recording.tracks.remove(0)];
    let matched = Matched::new(&network, &recording);
    let seen = matched.frame(10);
    assert_eq!(seen.iter().map(|it| it.track.id).collect::<Vec<_>>(), [1, 2]);
    assert_eq!(seen.iter().map(|it| it.place.station.round()).collect::<Vec<_>>(), [40.0, 70.0]);
    assert!(seen.iter().all(|it| (it.place.offset - 0.25).abs() < 1e-9));
    assert!(seen[0].acceleration == 0.0 && (seen[1].acceleration + 0.5).abs() < 1e-9);
}
