//! What sending costs: time of the thread that sends, and bytes.

use std::fs;

use laneweave::maps::{ReadOptions, load};
use laneweave::recordings::{Recording, RoadUser, State, Track};
use laneweave_test_data::map;
use laneweave_viewer::{Asked, Recorded, Server};

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
    Recording { step: STEP_S, tracks: (1..=VEHICLES).map(track).collect() }
}

/// The time for which the thread that sends was on a core [s].
fn sending_s(server: &Server) -> f64 {
    let thread = format!("sending {}", server.address().port());
    let tasks = fs::read_dir("/proc/self/task").expect("the threads of this process");
    let spent = tasks.filter_map(Result::ok).filter_map(|it| {
        let name = fs::read_to_string(it.path().join("comm")).ok()?;
        let times = fs::read_to_string(it.path().join("schedstat")).ok()?;
        (name.trim() == thread).then(|| times.split(' ').next()?.parse::<f64>().ok())?
    });
    spent.sum::<f64>() / 1e9
}

#[test]
fn ten_thousand_vehicles_at_ten_frames_a_second_cost_a_twentieth_of_a_core_and_2_mb_a_second() {
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
    let before = sending_s(&server);
    let bytes: usize = (0..MEASURED).map(|_| frame()).sum();
    // However long a frame takes on a machine that others use, too, ten of them count as a second.
    let seconds = f64::from(MEASURED) / FRAMES_A_SECOND;
    let (share, rate) = ((sending_s(&server) - before) / seconds, bytes as f64 / seconds);
    assert!(before > 0.0 && share < 0.05, "{:.1} % of a core", 100.0 * share);
    assert!(rate < 2e6, "{:.2} MB/s", rate / 1e6);
}
