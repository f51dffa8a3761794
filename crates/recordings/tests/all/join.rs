//! Recordings that were cut are joined again.

use laneweave_recordings::{JoinError, Recording, RoadUser, State, Track, join};
use proptest::prelude::*;

/// Vehicles on two lanes that follow one another for a minute, with different speeds that change.
fn traffic(step: f64, noise: f64) -> Recording {
    let track = |id: i64| {
        let begins = 20 * id;
        let speed = 8.0 + (id % 5) as f64 * 3.0;
        let states = (begins..begins + 500).map(|frame| {
            let t = (frame - begins) as f64 * step;
            let jitter =
                |n: i64| noise * (((frame * 7919 + id * 104_729 + n * 1299) % 1000) as f64 / 500.0 - 1.0);
            let x = speed * t + 5.0 * (1.0 - (0.3 * t).cos()) + jitter(1);
            let y = 3.5 * (id % 2) as f64 + jitter(2);
            State { frame, x, y, speed: speed + 1.5 * (0.3 * t).sin(), heading: 0.0 }
        });
        let (length, width) = RoadUser::Car.usual_size();
        Track { id, class: RoadUser::Car, length, width, states: states.collect() }
    };
    Recording { step, tracks: (1..40).map(track).collect(), ..Recording::default() }
}

/// `whole` in windows of so many frames, the next of which begins `overlap` frames before the last one ends; each with
/// frames from 0 on if they are `recounted`.
fn cut(whole: &Recording, length: i64, overlap: i64, recounted: bool) -> Vec<Recording> {
    let (first, last) = whole.frames().expect("there is traffic");
    let starts = (first..=last).step_by((length - overlap) as usize);
    let window = |start: i64| {
        let within = |it: &&State| (start..start + length).contains(&it.frame);
        let shift = if recounted { start } else { 0 };
        let part = |track: &Track| {
            let states: Vec<State> = track.states.iter().filter(within).copied().collect();
            let states = states.into_iter().map(|it| State { frame: it.frame - shift, ..it }).collect();
            Track { states, ..*track }
        };
        let tracks = whole.tracks.iter().map(part).filter(|it| !it.states.is_empty()).collect();
        Recording { step: whole.step, tracks, ..Recording::default() }
    };
    starts.map(window).filter(|it| !it.tracks.is_empty()).collect()
}

fn by_id(mut recording: Recording) -> Vec<Track> {
    recording.tracks.sort_by_key(|it| it.id);
    recording.tracks
}

/// The recording with its first frame as number 0.
fn from_zero(mut recording: Recording) -> Recording {
    let first = recording.frames().expect("there is traffic").0;
    recording.tracks.iter_mut().flat_map(|it| &mut it.states).for_each(|it| it.frame -= first);
    recording
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]
    #[test]
    fn windows_joined_again_give_the_uncut_recording(
        length in 80..400_i64, overlap in 0..3_i64, recounted in any::<bool>(), noisy in any::<bool>(),
        turned in 0..20_usize,
    ) {
        let whole = traffic(0.04, if noisy { 0.1 } else { 0.0 });
        let mut parts = cut(&whole, length, 10 * overlap, recounted);
        // The first one gives the frames; the others may come in any order.
        let others = &mut parts[1..];
        others.rotate_left(turned % others.len().max(1));
        let joined = join(parts).expect("they continue one another");
        prop_assert_eq!(joined.renamed, 0);
        let expected = if recounted { from_zero(whole) } else { whole };
        prop_assert!(by_id(joined.recording) == by_id(expected), "offsets {:?}", joined.offsets);
    }
}

#[test]
fn recordings_of_other_places_or_frame_rates_are_refused() {
    let whole = traffic(0.04, 0.0);
    let mut parts = cut(&whole, 200, 0, true);
    parts[1].tracks.iter_mut().flat_map(|it| &mut it.states).for_each(|it| it.y += 50.0);
    let error = join(parts.clone()).expect_err("it is elsewhere");
    assert!(matches!(error, JoinError::Elsewhere { number: 2, agreeing: 0, .. }), "{error}");
    parts[1].step = 0.1;
    assert!(
        join(parts)
            .expect_err("another rate")
            .to_string()
            .starts_with("recording 2: its frames are 0.1 s apart")
    );
    assert_eq!(join(Vec::new()), Err(JoinError::Nothing));
}

#[test]
fn another_vehicle_with_a_known_id_gets_a_new_one() {
    let whole = traffic(0.04, 0.0);
    let mut parts = cut(&whole, 400, 0, true);
    let id = parts[1].tracks[0].id;
    parts[1].tracks[0].states.iter_mut().for_each(|it| it.y += 20.0);
    let joined = join(parts).expect("most of them go on");
    assert_eq!(joined.renamed, 1);
    let tracks = &joined.recording.tracks;
    assert!(tracks.iter().filter(|it| it.id == id).count() == 1 && tracks.iter().any(|it| it.id > 39));
}

#[test]
fn who_was_out_of_sight_is_the_same_if_it_is_no_farther_off_than_a_usual_acceleration_explains() {
    // Within 1 m and 3/8 m/s² t²: 1.41 m after 1.04 s.
    for (off, renamed) in [(1.3, 0), (1.5, 1)] {
        let mut parts = cut(&traffic(0.04, 0.0), 400, 0, true);
        let track = &mut parts[1].tracks[0];
        track.states.drain(..25);
        track.states.iter_mut().for_each(|it| it.y += off);
        assert_eq!(join(parts).expect("the others go on").renamed, renamed, "{off} m");
    }
}

#[test]
fn a_vehicle_that_is_seen_once_after_a_cut_does_not_move_the_frames() {
    let whole = traffic(0.04, 0.0);
    let joined = join(cut(&whole, 177, 0, true)).expect("they continue one another");
    assert_eq!(joined.offsets, [0, 177, 354, 531, 708, 885, 1062, 1239]);
}
