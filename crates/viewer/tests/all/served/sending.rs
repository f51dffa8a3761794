//! What sending costs, in bytes.

use laneweave::maps::{ReadOptions, load};
use laneweave::recordings::{Recording, RoadUser, State, Track};
use laneweave_test_data::map;
use laneweave_viewer::{Asked, Recorded};

use crate::served::client::{Page, serving};

const VEHICLES: i64 = 10_000;
/// Time between two frames [s].
const STEP_S: f64 = 0.1;
/// Recorded time [s].
const RECORDED_S: f64 = 8.0;
/// Frames that are measured.
const MEASURED: u32 = 50;
const FRAMES_A_SECOND: f64 = 10.0;

/// Vehicles side by side that drive at 10 to 16 m/s.
fn crowd() -> Recording {
    let track = |id: i64| {
        let (lane, place, speed) = ((id % 25) as f64, (id / 25) as f64, 10.0 + (id % 7) as f64);
        let state = |frame: i64| {
            let x = 12.0 * place + speed * STEP_S * frame as f64;
            State { frame, x, y: 3.5 * lane, speed, heading: 0.0 }
        };
        let states = (0..(RECORDED_S / STEP_S) as i64).map(state).collect();
        Track { id, class: RoadUser::Car, length: 4.5, width: 1.8, states }
    };
    Recording { step: STEP_S, tracks: (1..=VEHICLES).map(track).collect(), ..Recording::default() }
}

#[test]
fn ten_thousand_vehicles_at_ten_frames_a_second_cost_2_mb_a_second() {
    let map = load(&map("motorway_2_lanes.osm"), &ReadOptions::default()).expect("a map");
    let source = Recorded::new("crowd".into(), &map, crowd()).expect("a recording");
    let (server, token) = serving(Box::new(source));
    let mut page = Page::of(&server, &token);
    let mut frame = || {
        server.ask(Asked::Step(1));
        page.frame().expect("a frame").len()
    };
    // The first frames name all vehicles.
    (0..3).for_each(|_| assert!(frame() > 0));
    let bytes: usize = (0..MEASURED).map(|_| frame()).sum();
    let rate = bytes as f64 / (f64::from(MEASURED) / FRAMES_A_SECOND);
    assert!(rate < 2e6, "{:.2} MB/s", rate / 1e6);
}
