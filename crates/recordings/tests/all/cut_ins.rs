//! Cut-ins with known gaps and speeds: who counts as the follower, and what is no cut-in.

use laneweave_generate::{Motorway, motorway};
use laneweave_network::Network;
use laneweave_recordings::{CutIn, Matched, Recording, RoadUser, State, Track, cut_ins, lane_changes};

/// Time between frames [s].
const STEP: f64 = 0.1;
/// Width of a lane [m].
const WIDTH: f64 = 3.5;

/// Two lanes, cut into rows of lanelets of 100 m.
fn two_lanes() -> Network {
    let road = Motorway { lanes: 2, length_m: 2000.0, lanelet_length_m: 100.0, ..Motorway::default() };
    motorway(&road).expect("it fits").build().expect("it has lanes").network
}

/// A vehicle at a constant speed whose centre is at `x` [m] after 10 s, `aside(time)` from the road's edge.
fn vehicle(id: i64, (x, speed): (f64, f64), length: f64, aside: impl Fn(f64) -> f64) -> Track {
    let states = (0..200).map(|frame| {
        let time = frame as f64 * STEP;
        State { frame, x: x + speed * (time - 10.0), y: aside(time), speed, heading: 0.0 }
    });
    Track { id, class: RoadUser::Car, length, width: 1.8, states: states.collect() }
}

/// A car at 20 m/s that crosses the line to the left after 10 s, at 1,010 m, just beyond a border of lanelets.
fn cutting_in() -> Track {
    vehicle(1, (1010.0, 20.0), 4.0, |time| 0.5 * WIDTH + WIDTH * ((time - 8.0) / 4.0).clamp(0.0, 1.0))
}

fn on_the_left(id: i64, x: f64, speed: f64) -> Track {
    vehicle(id, (x, speed), 6.0, |_| 1.5 * WIDTH)
}

fn found(others: Vec<Track>) -> Vec<CutIn> {
    let network = two_lanes();
    let tracks = [vec![cutting_in()], others].concat();
    let recording = Recording { step: STEP, tracks, ..Recording::default() };
    let matched = Matched::new(&network, &recording);
    let changes = lane_changes(&matched);
    assert_eq!(changes.len(), 1);
    cut_ins(&matched, &changes)
}

#[track_caller]
fn assert_near(value: f64, expected: f64, error: f64) {
    assert!((value - expected).abs() <= error, "{value}, not {expected}");
}

#[test]
fn the_follower_is_the_nearest_vehicle_behind_also_on_the_lanelet_before() {
    // One lanelet further back, on the lanelet before, in the old lane, and ahead.
    let right = vehicle(5, (1000.0, 20.0), 6.0, |_| 0.5 * WIDTH);
    let others =
        vec![on_the_left(2, 960.0, 25.0), on_the_left(3, 985.0, 25.0), right, on_the_left(4, 1020.0, 20.0)];
    let [it] = found(others)[..] else { panic!("one cut-in") };
    assert_eq!((it.vehicle, it.follower), (1, 3));
    assert_near(it.time, 10.0, 0.02);
    // 25 m between the centres after 10 s; the frame after the crossing is at most 0.1 s later.
    assert_near(it.gap, 25.0 - 0.5 * (4.0 + 6.0), 0.5 + 1e-6);
    assert_near(it.follower_speed, 25.0, 1e-9);
    assert_near(it.speed, 20.0, 1e-9);
    assert_near(it.headway(), it.gap / 25.0, 1e-12);
    assert_near(it.inverse_time_to_collision(), 5.0 / it.gap, 1e-12);
}

#[test]
fn a_gap_that_opens_has_no_time_to_collision() {
    let [it] = found(vec![on_the_left(2, 990.0, 18.0)])[..] else { panic!("one cut-in") };
    assert_eq!(it.inverse_time_to_collision(), 0.0);
}

#[test]
fn without_a_follower_within_four_seconds_a_change_is_no_cut_in() {
    assert_eq!(found(vec![]), []);
    // A gap of 85 m at 20 m/s are 4.25 s, and one of 75 m 3.75 s.
    assert_eq!(found(vec![on_the_left(2, 920.0, 20.0)]), []);
    assert_eq!(found(vec![on_the_left(2, 930.0, 20.0)]).len(), 1);
    // A queue does not follow, and who overlaps has no gap.
    assert_eq!(found(vec![on_the_left(2, 1000.0, 0.5)]), []);
    assert_eq!(found(vec![on_the_left(2, 1006.0, 20.0)]), []);
}

#[test]
fn the_braking_of_a_follower_is_the_hardest_over_a_second_within_four() {
    // From one second after the cut-in on the follower brakes with 3 m/s² for 2 s, from 5 s on it would brake harder.
    let mut follower = on_the_left(2, 970.0, 25.0);
    for state in &mut follower.states {
        let time = state.frame as f64 * STEP;
        state.speed -= 3.0 * (time - 11.0).clamp(0.0, 2.0) + 6.0 * (time - 15.0).clamp(0.0, 2.0);
    }
    let network = two_lanes();
    let whole = Recording { step: STEP, tracks: vec![cutting_in(), follower], ..Recording::default() };
    let braking = |recording: &Recording| {
        let matched = Matched::new(&network, recording);
        let [it] = cut_ins(&matched, &lane_changes(&matched))[..] else { panic!("one cut-in") };
        it.braking(&matched)
    };
    assert_near(braking(&whole).expect("it is seen"), 3.0, 1e-6);
    let mut short = whole.clone();
    short.tracks[1].states.truncate(130);
    assert_eq!(braking(&short), None);
    let mut steady = whole;
    steady.tracks[1] = on_the_left(2, 970.0, 25.0);
    assert_eq!(braking(&steady), Some(0.0));
}
