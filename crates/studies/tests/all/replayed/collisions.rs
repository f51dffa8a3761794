//! Collisions are told apart by who is at fault.

use laneweave::scenario::Origin;
use laneweave_recordings::{Recording, RoadUser, State, Track};
use laneweave_studies::replay::{Asked, Collisions, replay};
use laneweave_test_data::map;

use crate::replayed::set_up::{replayed, written};

/// A car that drives along a lane of the motorway with three lanes, from frame 0 to 150, a tenth of a second each.
fn car(id: i64, from_x: f64, lane_y: impl Fn(f64) -> f64, speed: impl Fn(f64) -> f64) -> Track {
    let mut x = from_x;
    let states = (0..=150).map(|frame| {
        let time = f64::from(frame) * 0.1;
        let state = State { frame: i64::from(frame), x, y: lane_y(time), speed: speed(time), heading: 0.0 };
        x += 0.1 * speed(time);
        state
    });
    let states = states.collect();
    Track { id, class: RoadUser::Car, length: 4.5, width: 1.8, states }
}

/// The collisions of the recording of these cars, of which number 1 becomes a driver.
fn collisions(tracks: Vec<Track>) -> Collisions {
    let file = written(&Recording { step: 0.1, tracks });
    let mut scenario = replayed(file.clone(), map("motorway_3_lanes.osm"), 0.0);
    scenario.replay.reactive_ids = vec![1];
    scenario.styles = [("conservative".to_owned(), 1.0)].into();
    scenario.output.dir = file.with_extension("out");
    let asked = Asked { rollouts: 1, models: Vec::new(), threads: 1 };
    let done = replay(&scenario, &Origin::default(), &asked, "a test", |_| (), || false).expect("it runs");
    let it = done.report.expect("it was not interrupted").models[0].collisions;
    let count = |it: f64| it as usize;
    Collisions {
        by_reactive: count(it.by_reactive),
        by_recorded: count(it.by_recorded),
        between_reactive: count(it.between_reactive),
        between_recorded: count(it.between_recorded),
    }
}

#[test]
fn a_recorded_vehicle_that_does_not_stop_behind_a_driver_is_at_fault() {
    // The leader stops; the follower drove on in another way than it could behind the driver.
    let stops = car(2, 150.0, |_| 1.75, |time| (20.0 - 4.0 * time).max(0.0));
    let wall =
        [5.25, 8.75].map(|y| car(y as i64 + 10, 150.0, move |_| y, |time| (20.0 - 4.0 * time).max(0.0)));
    let driver = car(1, 100.0, |_| 1.75, |_| 20.0);
    let rams = car(3, 40.0, |_| 1.75, |_| 20.0);
    let [left, right] = wall;
    let found = collisions(vec![driver, stops, rams, left, right]);
    assert!(found.by_recorded >= 1 && found.by_reactive == 0 && found.between_reactive == 0, "{found:?}");
}

#[test]
fn a_recorded_vehicle_that_cuts_in_is_at_fault_and_recorded_ones_may_overlap() {
    let beside = |time: f64| if time < 3.0 { 5.25 } else { (5.25 - 3.5 * (time - 3.0)).max(1.75) };
    let cuts_in = car(2, 101.0, beside, |_| 20.0);
    let found = collisions(vec![car(1, 100.0, |_| 1.75, |_| 20.0), cuts_in]);
    assert_eq!(found, Collisions { by_recorded: 1, ..Collisions::default() });
    let overlap = [car(3, 300.0, |_| 1.75, |_| 20.0), car(4, 298.0, |_| 1.75, |_| 20.0)];
    let found = collisions([vec![car(1, 100.0, |_| 5.25, |_| 20.0)], overlap.to_vec()].concat());
    assert_eq!(found, Collisions { between_recorded: 1, ..Collisions::default() });
}

#[test]
fn a_driver_comes_onto_the_road_as_soon_as_there_is_room_for_it() {
    // The leader stops where the other one comes later: as recorded, they would overlap.
    let stops = car(2, 100.0, |_| 1.75, |time| (20.0 - 8.0 * time).max(0.0));
    let mut comes = car(1, 118.0, |_| 1.75, |_| 20.0);
    comes.states.iter_mut().for_each(|it| it.frame += 30);
    let recording = Recording { step: 0.1, tracks: vec![stops, comes] };
    let file = written(&recording);
    let mut scenario = replayed(file, map("motorway_3_lanes.osm"), 1.0);
    scenario.styles = [("conservative".to_owned(), 1.0)].into();
    let mut simulation = crate::replayed::set_up::ready(&scenario);
    let mut came = None;
    for step in 1..=150 {
        simulation.advance();
        if came.is_none() && simulation.played().any(|it| it.recorded == 1) {
            came = Some(step);
        }
    }
    // Its own place is free when it is recorded there, but the one who stopped drives on as a driver and is behind it.
    assert!(came.is_some_and(|it| (30..=150).contains(&it)), "{came:?}");
    assert_eq!(simulation.counters().collisions, 0);
}
