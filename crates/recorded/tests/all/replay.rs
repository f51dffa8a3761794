//! Frames of small recordings as scenes: the positions of vehicles, and the knowledge of drivers.

use laneweave_generate::{Motorway, motorway};
use laneweave_models::lateral::moved_share;
use laneweave_network::{ChainIndex, DrivingSide, Lanelet, LaneletIndex, Network, Point, Polyline, Side};
use laneweave_recorded::{Assumed, Replay, ReplayError};
use laneweave_recordings::{Extent, Matched, Recording, RoadUser, State, Track, extents, lane_changes};
use laneweave_sim::{Navigator, Phase};

use crate::drivers::usual;

/// Time between frames [s].
const STEP: f64 = 0.04;
/// Width of a lane [m].
const WIDTH: f64 = 3.5;
/// Middle of the slow and of the fast lane, from the road's edge [m].
const SLOW: f64 = 1.75;

fn road(length_m: f64, off_ramp_at: Vec<f64>) -> Network {
    let road = Motorway { lanes: 2, length_m, off_ramp_at, ..Motorway::default() };
    motorway(&road).expect("it fits").build().expect("it has lanes").network
}

/// A car 4.5 m long that drives to the east for some seconds, `aside(time)` from the road's edge.
fn car(id: i64, x: f64, speed: f64, seconds: f64, aside: impl Fn(f64) -> f64) -> Track {
    let states = (0..=(seconds / STEP).round() as i64).map(|frame| {
        let time = frame as f64 * STEP;
        State { frame, x: x + speed * time, y: aside(time), speed, heading: 0.0 }
    });
    Track { id, class: RoadUser::Car, length: 4.5, width: 1.8, states: states.collect() }
}

fn assumed(_: usize) -> Assumed {
    Assumed { parameters: 0, speed_factor: 0.9 }
}

/// Shows a recording as its drivers see it.
fn replay(network: &Network, tracks: Vec<Track>, look: impl FnOnce(&Replay)) {
    let recording = Recording { step: STEP, tracks, ..Recording::default() };
    let matched = Matched::new(network, &recording);
    let (navigator, driver_parameters) = (Navigator::new(network), [usual()]);
    let changes = lane_changes(&matched);
    look(
        &Replay::new(&matched, &changes, &navigator, &driver_parameters, assumed).expect("they are drivers"),
    );
}

#[track_caller]
fn assert_near(value: f64, expected: f64) {
    assert!((value - expected).abs() < 1e-6, "{value} is not {expected}");
}

#[test]
fn gaps_are_between_bumpers_and_speeds_are_as_recorded() {
    let network = road(2000.0, Vec::new());
    let tracks = vec![
        car(70, 500.0, 25.0, 4.0, |_| SLOW),
        car(30, 530.0, 20.0, 4.0, |_| SLOW),
        car(50, 480.0, 30.0, 4.0, |_| SLOW + WIDTH),
    ];
    replay(&network, tracks, |replay| {
        let frame = replay.frame(50);
        assert_eq!(frame.vehicles().collect::<Vec<_>>(), [30, 50, 70]);
        let situation = frame.perceive(70, Side::Left).expect("there is a lane on the left");
        let leader = situation.here.ahead.expect("30 drives ahead");
        assert_near(leader.gap, 530.0 + 40.0 - (500.0 + 50.0) - 4.5);
        assert_near(leader.speed, 20.0);
        let follower = situation.there.behind.expect("50 drives behind on the left");
        assert_near(follower.gap, 500.0 + 50.0 - (480.0 + 60.0) - 4.5);
        assert_near(follower.driver.pace.speed, 30.0);
        let desired = 0.9 * 120.0 / 3.6;
        assert!((situation.me.pace.desired - desired).abs() < 1e-5);
        assert!(situation.here.behind.is_none() && situation.there.ahead.is_none());
        assert!(frame.perceive(70, Side::Right).is_none() && frame.perceive(31, Side::Left).is_none());
    });
}

#[test]
fn a_change_goes_on_from_the_beginning_to_the_end_of_the_way_across() {
    let network = road(2000.0, Vec::new());
    let aside = |time: f64| SLOW + WIDTH * moved_share((time - 8.0) / 5.0);
    let track = car(1, 100.0, 30.0, 20.0, aside);
    let recording = Recording { step: STEP, tracks: vec![track.clone()], ..Recording::default() };
    let matched = Matched::new(&network, &recording);
    let [Extent { began, ended }] = extents(&matched, &lane_changes(&matched))[..] else {
        panic!("one change")
    };
    assert!((began - 8.0).abs() < 0.02 && (ended - 13.0).abs() < 0.02, "{began} {ended}");
    replay(&network, vec![track], |replay| {
        let stands = |time: f64| {
            let frame = replay.frame((time / STEP).round() as i64);
            let scene = frame.scene();
            let spot = frame.spot(1).expect("it is there");
            let shadows: usize =
                scene.lanes.iter().flat_map(|it| it.drivers()).filter(|it| it.is_shadow).count();
            (spot.chain, scene.driver(spot).phase, shadows)
        };
        let [slow, fast] = [7.8, 13.2].map(|time| stands(time).0);
        assert_ne!(slow, fast);
        assert_eq!(stands(7.8), (slow, Phase::Cruises, 0));
        assert_eq!(stands(8.2), (slow, Phase::Changes, 1));
        assert_eq!(stands(10.4), (slow, Phase::Changes, 1));
        assert_eq!(stands(10.6), (fast, Phase::Changes, 1));
        assert_eq!(stands(12.8), (fast, Phase::Changes, 1));
        assert_eq!(stands(13.2), (fast, Phase::Cruises, 0));
    });
}

#[test]
fn a_follower_in_either_lane_has_who_changes_before_it() {
    let network = road(2000.0, Vec::new());
    let aside = |time: f64| SLOW + WIDTH * moved_share((time - 4.0) / 4.0);
    let tracks = vec![
        car(1, 200.0, 25.0, 12.0, aside),
        car(2, 150.0, 25.0, 12.0, |_| SLOW),
        car(3, 140.0, 25.0, 12.0, |_| SLOW + WIDTH),
    ];
    replay(&network, tracks, |replay| {
        let gaps = |time: f64| {
            let frame = replay.frame((time / STEP).round() as i64);
            [(2, Side::Left), (3, Side::Right)].map(|(vehicle, side)| {
                let situation = frame.perceive(vehicle, side).expect("there is a lane");
                situation.here.ahead.map(|it| it.gap.round())
            })
        };
        assert_eq!(gaps(3.0), [Some(46.0), None]);
        assert_eq!(gaps(6.0), [Some(46.0), Some(56.0)]);
        assert_eq!(gaps(9.0), [None, Some(56.0)]);
    });
}

#[test]
fn a_driver_goes_where_it_went_or_stays_in_its_lane() {
    let network = road(3000.0, vec![1500.0]);
    // Into the exit lane, which runs from 1250 m to 1500 m beyond the edge.
    let leaving = |time: f64| SLOW - WIDTH * moved_share((time - 8.0) / 4.0);
    let tracks = vec![
        car(1, 1200.0, 25.0, 6.0, |_| SLOW),
        car(2, 1100.0, 25.0, 15.0, leaving),
        car(3, 1000.0, 25.0, 15.0, |_| SLOW + WIDTH),
    ];
    replay(&network, tracks, |replay| {
        let frame = replay.frame(0);
        let changes = |vehicle: i64| {
            let side = if vehicle == 3 { Side::Right } else { Side::Left };
            let situation = frame.perceive(vehicle, side).expect("there is a lane");
            [situation.here.route.changes, situation.there.route.changes]
        };
        assert_eq!((changes(1), changes(2), changes(3)), ([0, 0], [1, 2], [0, 0]));
        let remaining = frame.perceive(2, Side::Left).expect("a lane").here.route.remaining;
        assert_near(remaining, 1500.0 - 1100.0 - 2.25);
    });
}

#[test]
fn who_has_passed_the_exit_with_its_front_bumper_is_gone() {
    let network = road(1000.0, Vec::new());
    replay(&network, vec![car(1, 940.0, 20.0, 3.0, |_| SLOW)], |replay| {
        let is_there = |time: f64| replay.frame((time / STEP).round() as i64).spot(1).is_some();
        // The front bumper passes the exit after (60 − 2.25)/20 s.
        assert!(is_there(2.84) && !is_there(2.92));
    });
}

/// A road of 100 m that forks: one branch of 100 m straight on, and one that bends away.
fn fork() -> Network {
    let lanelet = |id: i64, from: (f64, f64), to: (f64, f64), following: &[u32]| {
        let border = |aside: f64| {
            let ends = [from, to].map(|(x, y)| Point::new(x, y + aside, 0.0));
            Polyline::new(ends).expect("it is a line")
        };
        let following = following.iter().map(|it| LaneletIndex(*it)).collect();
        let alone = Lanelet::alone(id, [border(1.75), border(-1.75), border(0.0)], 20.0);
        Lanelet { following, ..alone }
    };
    let lanelets = vec![
        lanelet(1, (0.0, 0.0), (100.0, 0.0), &[1, 2]),
        lanelet(2, (100.0, 0.0), (200.0, 0.0), &[]),
        lanelet(3, (100.0, 0.0), (200.0, -20.0), &[]),
    ];
    Network::new(lanelets, DrivingSide::Right).expect("it is a road")
}

#[test]
fn a_front_bumper_beyond_a_fork_is_on_the_branch_that_is_driven_later() {
    let network = fork();
    for (branch, slope) in [(1, 0.0), (2, -0.2)] {
        let mut track = car(1, 80.0, 20.0, 4.0, |_| 0.0);
        for state in track.states.iter_mut().filter(|it| it.x > 100.0) {
            state.y = slope * (state.x - 100.0);
        }
        replay(&network, vec![track], |replay| {
            // The centre is at 98.4 m, the front bumper 2.25 m ahead.
            let frame = replay.frame(23);
            let spot = frame.spot(1).expect("it is there");
            let chain = network.chain(spot.chain);
            assert_eq!(chain.lanelets, [LaneletIndex(branch)]);
            assert_near(frame.scene().motion(spot).x, 0.65);
            // Its direction is known before the fork.
            let frame = replay.frame(0);
            let spot = frame.spot(1).expect("it is there");
            let destination = frame.scene().driver(spot).goal.destination();
            let next = frame.scene().next(destination, spot.chain);
            assert_eq!(
                next.map(|it: ChainIndex| &network.chain(it).lanelets[..]),
                Some(&[LaneletIndex(branch)][..])
            );
        });
    }
}

#[test]
fn a_desired_speed_is_that_which_a_driver_stays_below_most_of_the_time() {
    let network = road(3000.0, Vec::new());
    let limit = 120.0 / 3.6;
    let mut held_up = car(1, 100.0, 0.3 * limit, 40.0, |_| SLOW);
    let states = held_up.states.len();
    held_up.states[states * 8 / 10..].iter_mut().for_each(|it| it.speed = 0.8 * limit);
    let fast = car(2, 100.0, 1.2 * limit, 40.0, |_| SLOW + WIDTH);
    let truck = Track { class: RoadUser::Truck, length: 12.0, ..car(3, 100.0, 20.0, 40.0, |_| SLOW) };
    let recording = Recording { step: STEP, tracks: vec![held_up, fast, truck], ..Recording::default() };
    let matched = Matched::new(&network, &recording);
    let factor = |track| Assumed::by_its_speeds(&matched, track, 0).speed_factor;
    assert_near(factor(0), 0.8);
    assert_near(factor(1), 1.0);
    assert_near(factor(2), 20.0 / (80.0 / 3.6));
}

#[test]
fn impossible_drivers_are_refused() {
    let network = road(1000.0, Vec::new());
    let recording =
        Recording { step: STEP, tracks: vec![car(7, 100.0, 20.0, 3.0, |_| SLOW)], ..Recording::default() };
    let matched = Matched::new(&network, &recording);
    let (navigator, driver_parameters) = (Navigator::new(&network), [usual()]);
    let refusal = |parameters, speed_factor| {
        let assume = |_| Assumed { parameters, speed_factor };
        Replay::new(&matched, &[], &navigator, &driver_parameters, assume).err()
    };
    let (vehicle, count) = (7, driver_parameters.len());
    let unknown = ReplayError::Character { vehicle, parameters: count as u32, count };
    assert_eq!(refusal(count as u32, 1.0), Some(unknown));
    assert_eq!(refusal(0, 0.0), Some(ReplayError::SpeedFactor { vehicle, factor: 0.0 }));
    assert_eq!(refusal(0, 1.0), None);
}
