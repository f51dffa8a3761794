//! Recordings through to what users get of them: no bytes make the report, the replay or the plan of a fit panic or
//! take long. The file says itself which layout it has.

#![no_main]

use std::path::PathBuf;
use std::sync::LazyLock;

use laneweave::scenario::{MapOptions, Origin, Replay, open_map};
use laneweave::{Simulation, open_recording};
use laneweave_maps::Map;
use laneweave_studies::check::RecordingReport;
use laneweave_studies::{fit, replay};
use libfuzzer_sys::fuzz_target;

mod file;

/// Most steps of a replay.
const STEPS: u32 = 200;

static MAP_FILE: LazyLock<PathBuf> =
    LazyLock::new(|| PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../maps/ramps.osm")));
static MAP: LazyLock<Map> =
    LazyLock::new(|| open_map(&MAP_FILE, &MapOptions::default()).expect("the map is sound"));

fuzz_target!(|bytes: &[u8]| {
    let path = file::holding(bytes);
    let Ok((mut recording, problems)) = open_recording(&path, None) else { return };
    recording.place(MAP.origin);
    assert!(!RecordingReport::of(recording, &problems, &MAP.network).to_text().is_empty());
    let asked = Replay { recording: vec![path.clone()], reactive_share: 0.5, ..Replay::default() };
    if let Ok((scenario, _)) = replay::scenario(MAP_FILE.clone(), asked)
        && let Ok(mut simulation) = Simulation::from_scenario(&scenario, &Origin::default())
    {
        let steps = (simulation.end_s() / simulation.step_s()) as u32;
        simulation.steps(steps.min(STEPS));
    }
    let usual = fit::Request::new(vec![path]);
    let request = fit::Request { map: Some(MAP_FILE.clone()), draws: 2, repetitions: 1, ..usual };
    if let Ok(observed) = request.observe() {
        observed.plan();
    }
});
