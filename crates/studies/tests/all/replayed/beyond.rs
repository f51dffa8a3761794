//! Drivers who drive on when their records end: where they come into view, and how they leave it.

use laneweave::Simulation;
use laneweave::scenario::{Origin, Replay, Scenario};
use laneweave_recordings::{Recording, RoadUser, State, Track, clean};
use laneweave_scenario::{AtItsEnd, Recorded};
use laneweave_test_data::map;

/// Time between frames [s], and length of the road in view [m].
const STEP: f64 = 0.2;
const VIEW: f64 = 600.0;
/// So many vehicles come one after the other, so far apart [s].
const COUNT: i64 = 60;
const APART: f64 = 2.2;

/// Vehicles that come in the slow lane of our motorway at 20 m/s, and drive `speed_at` each place [m] of the view.
fn recording(speed_at: impl Fn(f64) -> f64) -> Recording {
    let speed_at = &speed_at;
    let states = |first: i64| {
        let mut x = 0.0;
        (0..).map_while(move |frame| {
            let state =
                State { frame: first + frame, x: 100.0 + x, y: 1.75, heading: 0.0, speed: speed_at(x) };
            x += state.speed * STEP;
            (x < VIEW).then_some(state)
        })
    };
    let track = |number: i64, states: Vec<State>| Track {
        id: number,
        class: RoadUser::Car,
        length: 4.5,
        width: 1.8,
        states,
    };
    let frames = (APART / STEP) as i64;
    Recording {
        step: STEP,
        tracks: (0..COUNT).map(|it| track(it, states(it * frames).collect())).collect(),
        ..Recording::default()
    }
}

/// What is on the road at all steps of a replay in which all are drivers who drive on.
fn driven(recording: Recording) -> Recording {
    let duration = (recording.frames().expect("it has frames").1 as f64 + 1.0) * STEP;
    let mut scenario = Scenario::of_map(map("motorway_2_lanes.osm"));
    scenario.demand.vehicles_per_hour = Some(0.0);
    scenario.run.duration_s = duration;
    scenario.replay =
        Replay { recording: vec!["in memory".into()], reactive_share: 1.0, ..Replay::default() };
    let recorded = Recorded { recording, from_s: 0.0, permitted: [].into(), at_its_end: AtItsEnd::DrivesOn };
    let mut simulation =
        Simulation::replaying(&scenario, &Origin::default(), recorded).expect("it can be replayed");
    let mut watch = simulation.drone_watch();
    for _ in 0..simulation.run_steps()[1] {
        simulation.advance();
        simulation.show(&mut watch);
    }
    watch.into_recording()
}

#[test]
fn a_vehicle_that_was_lost_and_found_again_under_another_number_is_on_the_road_once() {
    let mut whole = recording(|_| 20.0);
    // Every third vehicle is lost in the middle of the view, and found 40 m further on.
    let lost: Vec<Track> = whole
        .tracks
        .iter_mut()
        .step_by(3)
        .map(|it| {
            let found = it.states.split_off(85);
            it.states.truncate(75);
            Track { id: it.id + COUNT, states: found, ..*it }
        })
        .collect();
    whole.tracks.extend(lost);
    assert_eq!(clean(whole.clone()).0.tracks.len(), COUNT as usize + 20);
    assert_eq!(driven(whole).tracks.len(), COUNT as usize);
}

/// The mean speed in the last 100 m of the view [m/s].
fn speed_at_the_end(recording: &Recording) -> f64 {
    let states = recording.tracks.iter().flat_map(|it| &it.states);
    let there: Vec<f64> = states.filter(|it| (600.0..700.0).contains(&it.x)).map(|it| it.speed).collect();
    there.iter().sum::<f64>() / there.len() as f64
}

#[test]
fn a_queue_beyond_the_view_slows_drivers_and_a_free_road_does_not() {
    let queued = driven(recording(|x| (400.0 - 2.0 * (x - 300.0).clamp(0.0, 182.0)).sqrt()));
    let free = driven(recording(|_| 20.0));
    // Nobody goes on for long where nobody was recorded, though the lane does.
    let furthest = free.tracks.iter().flat_map(|it| &it.states).map(|it| it.x).fold(0.0, f64::max);
    assert!((700.0..800.0).contains(&furthest), "{furthest}");
    let [queued, free] = [&queued, &free].map(speed_at_the_end);
    assert!((5.0..13.0).contains(&queued), "{queued}");
    assert!(free > 18.0, "{free}");
}
