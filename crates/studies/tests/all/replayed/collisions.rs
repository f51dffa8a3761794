//! Who is in the way of a recorded vehicle hands it over, so that nobody is run into.

use laneweave::Departures;
use laneweave::scenario::Origin;
use laneweave_recordings::{Recording, RoadUser, State, Track};
use laneweave_studies::replay::{Asked, HandOvers, Matched, Mean, replay};
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

/// What happens in the recording of these cars, of which number 1 becomes a driver.
fn replayed_once(tracks: Vec<Track>) -> Matched {
    let file = written(&Recording { step: 0.1, tracks, ..Recording::default() });
    let mut scenario = replayed(file.clone(), map("motorway_3_lanes.osm"), 0.0);
    scenario.replay.reactive_ids = vec![1];
    scenario.styles = [("conservative".to_owned(), 1.0)].into();
    scenario.output.dir = file.with_extension("out");
    let asked = Asked { rollouts: 1, models: Vec::new(), threads: 1 };
    let done = replay(&scenario, &Origin::default(), &asked, "a test", |_| (), || false).expect("it runs");
    done.report.expect("it was not interrupted").models.remove(0)
}

fn of(mean: Option<Mean>) -> f64 {
    mean.expect("there is one").mean
}

#[test]
fn a_recorded_vehicle_behind_a_driver_who_stops_is_handed_over_and_stops_too() {
    // The leader stops; the follower drove on in another way than it could behind the driver.
    let stops = car(2, 150.0, |_| 1.75, |time| (20.0 - 4.0 * time).max(0.0));
    let wall =
        [5.25, 8.75].map(|y| car(y as i64 + 10, 150.0, move |_| y, |time| (20.0 - 4.0 * time).max(0.0)));
    let driver = car(1, 100.0, |_| 1.75, |_| 20.0);
    let comes = car(3, 40.0, |_| 1.75, |_| 20.0);
    let [left, right] = wall;
    let found = replayed_once(vec![driver, stops, comes, left, right]);
    assert_eq!(
        (found.contacts_per_driver.map(|it| it.mean), found.collisions.between_recorded),
        (Some(0.0), 0.0)
    );
    let HandOvers { share, compared_share, taken_off, late, .. } = found.hand_overs;
    // One of the four, from a few seconds on to the end.
    assert!((0.05..0.25).contains(&of(share)), "{share:?}");
    assert!((0.05..0.6).contains(&of(compared_share)), "{compared_share:?}");
    assert_eq!((taken_off, late), (0.0, 0.0));
}

#[test]
fn who_is_in_nobodys_way_hands_nobody_over() {
    let found = replayed_once(vec![car(1, 100.0, |_| 1.75, |_| 20.0), car(2, 40.0, |_| 1.75, |_| 15.0)]);
    let HandOvers { per_veh_km, share, compared_share, .. } = found.hand_overs;
    assert_eq!([of(per_veh_km), of(share), of(compared_share)], [0.0, 0.0, 1.0]);
}

#[test]
fn a_recorded_vehicle_that_would_cut_in_on_a_driver_waits_beside_it_and_recorded_ones_may_overlap() {
    let beside = |time: f64| if time < 3.0 { 5.25 } else { (5.25 - 0.6 * (time - 3.0)).max(1.75) };
    let cuts_in = car(2, 101.0, beside, |_| 20.0);
    let found = replayed_once(vec![car(1, 100.0, |_| 1.75, |_| 20.0), cuts_in]);
    assert!(found.collisions.by_recorded == 0.0 && of(found.hand_overs.share) > 0.0, "{found:?}");
    let overlap = [car(3, 300.0, |_| 1.75, |_| 20.0), car(4, 298.0, |_| 1.75, |_| 20.0)];
    let found = replayed_once([vec![car(1, 100.0, |_| 5.25, |_| 20.0)], overlap.to_vec()].concat());
    assert_eq!((found.collisions.between_recorded, of(found.contacts_per_driver)), (1.0, 0.0));
    assert_eq!(of(found.hand_overs.share), 0.0, "both are where the recording has them");
}

#[test]
fn a_driver_leaves_when_its_record_ends_and_one_whose_place_is_taken_comes_behind() {
    // Number 2 stands where number 1 is first seen, since it became a driver 3 s before.
    let mut ends = car(1, 118.0, |_| 1.75, |_| 20.0);
    ends.states.truncate(100);
    ends.states.iter_mut().for_each(|it| it.frame += 30);
    let recording = Recording {
        step: 0.1,
        tracks: vec![car(2, 100.0, |_| 1.75, |time| (20.0 - 8.0 * time).max(0.0)), ends],
        ..Recording::default()
    };
    let mut scenario = replayed(written(&recording), map("motorway_3_lanes.osm"), 1.0);
    scenario.styles = [("conservative".to_owned(), 1.0)].into();
    let mut simulation = crate::replayed::set_up::ready(&scenario);
    let mut last_seen = 0;
    for step in 1..=150 {
        simulation.advance();
        let first = simulation.played().find(|it| it.recorded == 1);
        if first.is_some_and(|it| simulation.view(it.vehicle).is_some()) {
            last_seen = step;
        }
    }
    let departures = simulation.departures();
    assert_eq!((departures.taken_off.as_slice(), last_seen), ([1].as_slice(), 129));
    for start in &departures.starts {
        assert!(start.recorded == 1 && start.because_of.is_some(), "{start:?}");
        assert!(start.behind_m > 0.0 || start.late_steps > 0);
    }
    assert_eq!(simulation.counters().collisions, 0);
}

/// The departures of a replay in which number 1 becomes a driver at once and stops behind number 9, which is recorded.
/// The vehicle 2 of a class is first seen where number 1 stands, for so many frames.
fn arrives_where_a_driver_stands(class: RoadUser, frames: usize) -> Departures {
    let stands = car(9, 106.0, |_| 1.75, |_| 0.0);
    let driver = car(1, 100.0, |_| 1.75, |time| if time < 5.0 { 0.0 } else { 20.0 });
    let mut comes = Track { class, ..car(2, 100.0, |_| 1.75, |_| 0.0) };
    comes.states.iter_mut().for_each(|it| it.frame += 100);
    comes.states.truncate(frames);
    let mut recording = Recording { step: 0.1, tracks: vec![stands, driver, comes], ..Recording::default() };
    recording.tracks[0].states.iter_mut().for_each(|it| it.speed = 0.0);
    let mut scenario = replayed(written(&recording), map("motorway_3_lanes.osm"), 0.0);
    scenario.replay.reactive_ids = vec![1];
    scenario.styles = [("conservative".to_owned(), 1.0)].into();
    let mut simulation = crate::replayed::set_up::ready(&scenario);
    (0..simulation.run_steps()[1]).for_each(|_| simulation.advance());
    simulation.departures().clone()
}

#[test]
fn who_finds_no_room_before_its_record_ends_is_counted_and_a_cyclist_is_where_it_was() {
    assert_eq!(arrives_where_a_driver_stands(RoadUser::Car, 10).never_came, [2]);
    let cyclist = arrives_where_a_driver_stands(RoadUser::Bicycle, 10);
    assert!(cyclist.never_came.is_empty() && cyclist.hand_overs.is_empty(), "{cyclist:?}");
}
