//! What a recording shows after a time t has no influence on what a driver does before t.

use std::path::PathBuf;

use laneweave::sim::{Purpose, Random};
use laneweave_recordings::{Recording, State, open};
use laneweave_test_data::map;

use crate::replayed::set_up::{mona, observed, of_style, ready, replayed, written};

/// All drivers at every step up to a time [s]: ids in the recording, places and speeds, bit for bit.
fn driven(recording: PathBuf, map: PathBuf, until_s: f64) -> Vec<(u32, i64, [u64; 3])> {
    let mut simulation = ready(&replayed(recording, map, 0.4));
    let mut seen = Vec::new();
    while simulation.time_s() + simulation.step_s() <= until_s + 1e-9 {
        simulation.advance();
        for played in simulation.played().filter(|it| it.is_reactive) {
            let vehicle = simulation.view(played.vehicle).filter(|it| !it.driver.is_external);
            if let Some(vehicle) = vehicle {
                let at = vehicle.pose().at;
                let state = [at.x, at.y, vehicle.speed()].map(f64::to_bits);
                seen.push((simulation.clock().step, played.recorded, state));
            }
        }
    }
    seen
}

/// The same recording, in which all that happened after a frame is permuted: each vehicle then goes on where another
/// one was, and some are gone.
fn permuted(recording: &Recording, after: i64, seed: u64) -> Recording {
    let random = Random::new(seed);
    let draw = |at: usize, count| random.uniform(at as u32, Purpose::Observation, count);
    let mut changed = recording.clone();
    let mut futures: Vec<Vec<State>> = Vec::new();
    for track in &mut changed.tracks {
        let begins = track.states.partition_point(|it| it.frame <= after);
        futures.push(track.states.split_off(begins));
    }
    for at in (1..futures.len()).rev() {
        futures.swap(at, (draw(at, 0) * (at + 1) as f64) as usize);
    }
    for (at, (track, future)) in changed.tracks.iter_mut().zip(futures).enumerate() {
        if draw(at, 1) < 0.8 {
            track.states.extend(future);
        }
    }
    changed.tracks.retain(|it| !it.states.is_empty());
    changed
}

fn assert_nothing_changes_before(recording: &Recording, map: PathBuf, until_s: f64) {
    let (first, _) = recording.frames().expect("it has frames");
    let after = first + (until_s / recording.step).round() as i64;
    let as_it_was = driven(written(recording), map.clone(), until_s);
    assert!(as_it_was.len() > 1000, "{} states of drivers", as_it_was.len());
    for seed in 1..=3 {
        let other = permuted(recording, after, seed);
        assert_ne!(&other, recording);
        let driven = driven(written(&other), map.clone(), until_s);
        let first = driven.iter().zip(&as_it_was).find(|(a, b)| a != b);
        assert!(driven == as_it_was, "permutation {seed}: {first:?}");
    }
    let cut = permuted(recording, after, 4);
    let tracks = cut.tracks.into_iter().map(|mut track| {
        track.states.retain(|it| it.frame <= after);
        track
    });
    let cut = Recording { tracks: tracks.filter(|it| !it.states.is_empty()).collect(), ..cut };
    assert!(driven(written(&cut), map, until_s) == as_it_was, "a recording that ends there");
}

#[test]
fn on_our_own_motorway_and_in_our_own_town() {
    for (name, demand) in [("ramps.osm", 3000.0), ("town.osm", 1500.0)] {
        let recording = observed(&of_style(name, "conservative", demand, 60.0), 0.1);
        assert_nothing_changes_before(&recording, map(name), 40.0);
    }
}

#[test]
fn on_a_real_road() {
    let Some([file, map]) = mona() else { return };
    let (recording, _) = open(&file, None).expect("it can be read");
    assert_nothing_changes_before(&recording, map, 60.0);
}
