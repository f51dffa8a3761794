//! Lane changes at known times on a generated road, with noise: which are found, when, and which are not counted.

use laneweave_generate::{Motorway, motorway};
use laneweave_network::{Network, Side};
use laneweave_recordings::{
    LaneChange, Matched, RecordedChangeKind, Recording, RoadUser, State, Track, lane_changes,
};

/// Time between frames [s].
const STEP: f64 = 0.04;
/// Width of a lane [m], and how far from the road's edge the line between the lanes lies.
const WIDTH: f64 = 3.5;
const LINE: f64 = WIDTH;

fn road(road: &Motorway) -> Network {
    motorway(road).expect("it fits").build().expect("it has lanes").network
}

fn two_lanes() -> Network {
    road(&Motorway { lanes: 2, length_m: 3000.0, ..Motorway::default() })
}

/// A number in (−1, 1) that depends on its counter only (splitmix64).
fn uniform(counter: [u64; 3]) -> f64 {
    let mut bits = counter.iter().fold(0, |bits: u64, it| {
        (bits ^ it).wrapping_add(0x9E37_79B9_7F4A_7C15).wrapping_mul(0xBF58_476D_1CE4_E5B9)
    });
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    (bits >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

/// Nearly normal, with the standard deviation 1: the sum of twelve uniform numbers.
fn normal(track: u64, frame: u64, axis: u64) -> f64 {
    0.5 * (0..12).map(|it| uniform([track, frame, 100 * axis + it])).sum::<f64>()
}

/// A car that drives straight on at `speed`, `aside(time)` from the road's edge, observed with `noise` [m].
fn car(id: i64, speed: f64, noise: f64, seconds: f64, aside: impl Fn(f64) -> f64) -> Track {
    let states = (0..(seconds / STEP) as i64).map(|frame| {
        let time = frame as f64 * STEP;
        let off = |axis| noise * normal(id as u64, frame as u64, axis);
        State { frame, x: 10.0 + speed * time + off(0), y: aside(time) + off(1), speed, heading: 0.0 }
    });
    Track { id, class: RoadUser::Car, length: 4.5, width: 1.8, states: states.collect() }
}

/// From 0 to 1 in `duration` around 0.
fn swing(time: f64, duration: f64) -> f64 {
    let phase = (time / duration + 0.5).clamp(0.0, 1.0);
    0.5 - 0.5 * (std::f64::consts::PI * phase).cos()
}

fn found(network: &Network, tracks: Vec<Track>) -> Vec<LaneChange> {
    lane_changes(&Matched::new(network, &Recording { step: STEP, tracks, ..Recording::default() }))
}

/// A car that changes lanes every 15 s and drives at varying offsets in its lane, and the times when it crosses the
/// line.
fn weaving(id: i64, noise: f64) -> (Track, Vec<f64>) {
    let draw = |it: u64| uniform([id as u64, 7, it]);
    let middle = |number: u64| {
        let lane = (id as u64 + number) % 2;
        1.75 + WIDTH * lane as f64 + 0.5 * draw(number)
    };
    let when = |number: u64| 15.0 * number as f64 - 7.5 + 2.0 * draw(10 + number);
    let duration = 5.0 + 2.0 * draw(20);
    let aside = |time: f64| {
        (1..=4).fold(middle(0), |y, it| y + (middle(it) - middle(it - 1)) * swing(time - when(it), duration))
    };
    let moments = (0..60_000).map(|it| 0.001 * f64::from(it));
    let crossed = moments.filter(|it| (aside(*it) > LINE) != (aside(it + 0.001) > LINE)).collect();
    (car(id, 25.0 + 10.0 * draw(30), noise, 60.0, aside), crossed)
}

#[test]
fn changes_at_known_times_are_found_under_noise() {
    let network = two_lanes();
    let (tracks, truth): (Vec<Track>, Vec<Vec<f64>>) = (0..100).map(|id| weaving(id, 0.1)).unzip();
    let changes = found(&network, tracks);
    let made: usize = truth.iter().map(Vec::len).sum();
    assert_eq!(made, 400);
    let off = |change: &LaneChange| {
        let distance = |time: &f64| (time - change.time).abs();
        truth[change.track].iter().map(distance).fold(f64::INFINITY, f64::min)
    };
    let right = changes.iter().filter(|it| off(it) <= 0.5).count();
    assert!(right >= 396 && changes.len() - right <= 4, "{right} of {made} among {}", changes.len());
    let mean = changes.iter().map(off).sum::<f64>() / changes.len() as f64;
    assert!(mean < 0.03, "{mean}");
    for change in &changes {
        assert!(change.along_graph && (change.y - LINE).abs() < 0.2);
        let leaves = network.lanelets[change.from.at()].beside(change.side).is_some();
        assert!(leaves, "{change:?}");
    }
}

#[test]
fn noise_beside_the_line_makes_no_changes() {
    let network = two_lanes();
    let tracks = (0..100).map(|id| {
        let side = if id % 2 == 0 { 1.0 } else { -1.0 };
        car(id, 30.0, 0.1, 60.0, move |_| LINE + 0.15 * side)
    });
    let changes = found(&network, tracks.collect());
    assert_eq!(changes, []);
}

#[test]
fn without_noise_the_crossing_is_exact() {
    let network = two_lanes();
    let changes =
        found(&network, vec![car(1, 25.0, 0.0, 30.0, |time| 1.75 + WIDTH * swing(time - 13.01, 4.0))]);
    let [change] = &changes[..] else { panic!("{changes:?}") };
    assert!((change.time - 13.01).abs() < 0.005 && (change.y - LINE).abs() < 1e-3);
    assert!((change.x - 10.0 - 25.0 * 13.01).abs() < 0.2);
    assert_eq!((change.vehicle, change.side, change.speed), (1, Side::Left, 25.0));
    assert_eq!((change.kind, change.returned_after), (RecordedChangeKind::Discretionary, None));
    assert!((change.seen_after - (29.96 - 13.01)).abs() < 0.01);
    let names = |it: laneweave_network::LaneletIndex| network.lanelets[it.at()].id;
    // The road's fourth row of lanelets, the slow one first.
    assert_eq!((names(change.from), names(change.to)), (7.into(), 8.into()));
}

#[test]
fn a_change_counts_if_the_vehicle_stays() {
    let network = two_lanes();
    // The centre is beyond the line for a third of the time there and back.
    let excursion = |beyond: f64| {
        let way = 3.0 * beyond;
        let aside = move |time: f64| {
            let there = 1.0 - ((time - 15.0).abs() / (0.5 * way)).min(1.0);
            LINE - 1.0 + 1.5 * there
        };
        found(&network, vec![car(1, 20.0, 0.0, 30.0, aside)])
    };
    assert_eq!(excursion(0.6), []);
    let changes = excursion(1.2);
    assert_eq!(changes.iter().map(|it| it.side).collect::<Vec<_>>(), [Side::Left, Side::Right]);
    assert!((changes[0].returned_after.unwrap() - 1.2).abs() < 0.1, "{changes:?}");
}

#[test]
fn who_comes_back_after_half_a_minute_did_not_return() {
    let network = two_lanes();
    let pair = |apart: f64| {
        let aside =
            move |time: f64| 1.75 + WIDTH * (swing(time - 10.0, 4.0) - swing(time - 10.0 - apart, 4.0));
        found(&network, vec![car(1, 20.0, 0.0, 60.0, aside)])
    };
    let returned =
        |apart: f64| pair(apart).iter().map(|it| it.returned_after.map(f64::round)).collect::<Vec<_>>();
    assert_eq!(returned(20.0), [Some(20.0), None]);
    assert_eq!(returned(31.0), [None, None]);
}

#[test]
fn changes_towards_an_exit_are_for_the_route_and_others_are_not() {
    let network =
        road(&Motorway { lanes: 2, length_m: 3000.0, off_ramp_at: vec![1500.0], ..Motorway::default() });
    let ramp: Vec<_> = network.lanelets.iter().filter(|it| it.centre.at(it.length()).y < -WIDTH).collect();
    let mut exit = ramp[0].centre.clone();
    ramp[1..].iter().for_each(|it| exit.append(&it.centre));
    // From the fast lane to the exit lane, which runs from 1250 m to 1500 m beyond the edge of the slow one.
    let leaving = |seconds: f64| {
        let aside = |time: f64| 5.25 - WIDTH * swing(time - 10.0, 4.0) - WIDTH * swing(time - 45.0, 4.0);
        let mut track = car(1, 30.0, 0.0, seconds, aside);
        for state in track.states.iter_mut().filter(|it| it.x > 1500.0) {
            let station = state.x - 1500.0;
            let at = exit.at(station);
            (state.x, state.y, state.heading) = (at.x, at.y, exit.heading(station));
        }
        found(&network, vec![track]).iter().map(|it| (it.side, it.kind)).collect::<Vec<_>>()
    };
    assert_eq!(
        leaving(48.0),
        [(Side::Right, RecordedChangeKind::Unknown), (Side::Right, RecordedChangeKind::Unknown)]
    );
    assert_eq!(
        leaving(55.0),
        [(Side::Right, RecordedChangeKind::Route), (Side::Right, RecordedChangeKind::Route)]
    );
    // A vehicle that continues straight on has not needed to change.
    let overtaking = car(2, 30.0, 0.0, 60.0, |time| 1.75 + WIDTH * swing(time - 10.0, 4.0));
    let kinds: Vec<_> = found(&network, vec![overtaking]).iter().map(|it| it.kind).collect();
    assert_eq!(kinds, [RecordedChangeKind::Discretionary]);
}

#[test]
fn merging_from_an_on_ramp_is_for_the_route() {
    let network =
        road(&Motorway { lanes: 2, length_m: 3000.0, on_ramp_at: vec![1000.0], ..Motorway::default() });
    // The ramp's lane runs from 1000 m to 1250 m at −1.75 m.
    let aside = |time: f64| -1.75 + WIDTH * swing(time - 4.0, 4.0);
    let mut merging = car(1, 30.0, 0.0, 40.0, aside);
    merging.states.iter_mut().for_each(|it| it.x += 1000.0);
    let kinds: Vec<_> = found(&network, vec![merging]).iter().map(|it| (it.side, it.kind)).collect();
    assert_eq!(kinds, [(Side::Left, RecordedChangeKind::Route)]);
}
