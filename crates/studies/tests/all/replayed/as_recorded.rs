//! With nobody reactive all vehicles are where they were recorded.

use std::collections::HashMap;
use std::path::PathBuf;

use laneweave::{Departures, VehicleId};
use laneweave_recordings::{Recording, State, open};
use laneweave_test_data::map;

use crate::replayed::set_up::{mona, observed, of_style, ready, replayed, written};

/// Replays a recording, and compares all vehicles with it in every frame.
fn assert_as_recorded(file: PathBuf, map: PathBuf) {
    let (recording, _) = open(&file, None).expect("it can be read");
    let mut simulation = ready(&replayed(file, map, 0.0));
    let (first, last) = recording.frames().expect("it has frames");
    let steps_a_frame = (recording.step / simulation.step_s()).round().max(1.0) as u32;
    let frames_a_step = (simulation.step_s() / recording.step).round().max(1.0) as i64;
    let states = by_frame(&recording);
    let mut compared = 0;
    for _ in 0..simulation.run_steps()[1] {
        simulation.advance();
        let step = simulation.clock().step;
        let ids: HashMap<VehicleId, i64> = simulation.played().map(|it| (it.vehicle, it.recorded)).collect();
        assert!(simulation.views().all(|it| it.driver.is_external), "no driver is simulated");
        if !step.is_multiple_of(steps_a_frame) {
            continue;
        }
        let frame = first + i64::from(step / steps_a_frame) * frames_a_step;
        let there = states.get(&frame).cloned().unwrap_or_default();
        assert_eq!(simulation.views().count(), there.len(), "in frame {frame} of {first} to {last}");
        for vehicle in simulation.views() {
            let state = there[&ids[&vehicle.id()]];
            let at = vehicle.pose().at;
            assert!((at.x - state.x).hypot(at.y - state.y) < 0.01, "{state:?}");
            compared += 1;
        }
    }
    assert_eq!(simulation.departures(), &Departures::default(), "nobody is handed over, late, or taken off");
    let all: usize = states.values().map(HashMap::len).sum();
    let skipped = 1.1 * frames_a_step as f64;
    assert!(compared as f64 * skipped > all as f64, "{compared} of {all} states were compared");
}

fn by_frame(recording: &Recording) -> HashMap<i64, HashMap<i64, State>> {
    let mut frames: HashMap<i64, HashMap<i64, State>> = HashMap::new();
    for track in &recording.tracks {
        for state in &track.states {
            frames.entry(state.frame).or_default().insert(track.id, *state);
        }
    }
    frames
}

#[test]
fn on_our_own_motorway_and_in_our_own_town() {
    for (name, demand) in [("ramps.osm", 3000.0), ("town.osm", 1500.0)] {
        let recording = observed(&of_style(name, "conservative", demand, 60.0), 0.1);
        assert_as_recorded(written(&recording), map(name));
    }
}

#[test]
fn on_a_real_road() {
    if let Some([recording, map]) = mona() {
        assert_as_recorded(recording, map);
    }
}
