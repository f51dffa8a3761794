//! Cleaning: what is corrected, what is cut out, and what stays unchanged.

use std::f64::consts::PI;

use laneweave_recordings::{CleaningReport, Example, Recording, RoadUser, State, Track, clean};

const STEP: f64 = 0.1;

/// A car to the east with 20 m/s.
fn car(frames: impl Iterator<Item = i64>) -> Track {
    let state = |frame| State { frame, x: 2.0 * frame as f64, y: 0.0, speed: 20.0, heading: 0.0 };
    Track { id: 5, class: RoadUser::Car, length: 4.5, width: 1.8, states: frames.map(state).collect() }
}

fn cleaned(track: Track) -> (Vec<Track>, CleaningReport) {
    let (recording, report) = clean(Recording { step: STEP, tracks: vec![track], ..Recording::default() });
    assert_eq!(recording.step, STEP);
    (recording.tracks, report)
}

/// The counts of a report in the order of its findings.
fn counts(report: &CleaningReport) -> [usize; 10] {
    report.findings().map(|(_, finding)| finding.count)
}

#[test]
fn what_is_sound_stays_as_it_is() {
    let (tracks, report) = cleaned(car(3..40));
    assert_eq!(tracks, [car(3..40)]);
    assert_eq!((report.states, counts(&report)), (37, [0; 10]));
    assert_eq!(report.to_string(), "37 states");
}

#[test]
fn states_that_come_twice_or_are_no_numbers_are_left_out() {
    let mut track = car(0..20);
    let (mut again, mut none) = (track.states[4], track.states[7]);
    (again.y, none.x) = (1.0, f64::NAN);
    track.states.push(again);
    track.states[7] = none;
    let (tracks, report) = cleaned(track);
    assert_eq!(tracks, [car(0..20)]);
    assert_eq!((report.duplicates.count, report.not_finite.count, report.interpolated.count), (1, 1, 1));
    assert_eq!(report.not_finite.examples, [Example { track: 5, time: 7.0 * STEP }]);
}

#[test]
fn gaps_up_to_one_second_are_interpolated_and_longer_ones_split_the_track() {
    let (tracks, report) = cleaned(car((0..20).chain(30..50)));
    assert_eq!((tracks.len(), report.interpolated.count, report.long_gaps.count), (1, 10, 0));
    for (state, expected) in tracks[0].states.iter().zip(car(0..50).states) {
        assert!((state.x - expected.x).abs() < 1e-9 && state.frame == expected.frame);
    }
    let (tracks, report) = cleaned(car((0..20).chain(31..50)));
    assert_eq!(tracks, [car(0..20), car(31..50)]);
    assert_eq!(report.long_gaps.examples, [Example { track: 5, time: 31.0 * STEP }]);
}

#[test]
fn headings_turn_the_short_way_through_a_gap() {
    let mut track = car((0..10).chain(11..20));
    track.states.iter_mut().for_each(|it| it.x = -it.x);
    track.states[..10].iter_mut().for_each(|it| it.heading = PI - 0.1);
    track.states[10..].iter_mut().for_each(|it| it.heading = 0.1 - PI);
    let (tracks, report) = cleaned(track);
    assert_eq!(report.headings.count, 0);
    assert!((tracks[0].states[10].heading - PI).abs() < 1e-9);
}

#[test]
fn headings_whose_difference_is_no_number_stay_finite_in_a_gap() {
    let mut track = car((0..3).chain(4..7));
    let (before, after) = track.states.split_at_mut(3);
    before.iter_mut().for_each(|it| it.heading = -f64::MAX);
    after.iter_mut().for_each(|it| it.heading = f64::MAX);
    let (tracks, report) = cleaned(track);
    assert_eq!((tracks[0].states.len(), report.interpolated.count), (7, 1));
    assert!(tracks[0].states.iter().all(|it| it.heading.is_finite()));
}

#[test]
fn a_state_off_the_path_is_left_out() {
    for offset in [4.0, -30.0, 5000.0] {
        let mut track = car(0..30);
        track.states[12].y = offset;
        let (tracks, report) = cleaned(track);
        assert_eq!((report.outliers.count, report.interpolated.count, report.jumps.count), (1, 1, 0));
        assert!(tracks.len() == 1 && tracks[0].states[12].y == 0.0);
    }
}

#[test]
fn a_jump_of_the_path_splits_the_track() {
    let mut track = car(0..30);
    track.states[15..].iter_mut().for_each(|it| it.y = 6.0);
    let (tracks, report) = cleaned(track);
    assert_eq!(tracks.iter().map(|it| (it.id, it.states.len())).collect::<Vec<_>>(), [(5, 15), (5, 15)]);
    assert_eq!(report.jumps.examples, [Example { track: 5, time: 15.0 * STEP }]);
}

#[test]
fn braking_hard_is_no_jump() {
    let mut track = car(0..40);
    let (mut x, mut speed) = (0.0, 35.0_f64);
    for state in &mut track.states {
        (state.x, state.speed) = (x, speed);
        let slower = (speed - 9.0 * STEP).max(0.0);
        x += 0.5 * (speed + slower) * STEP;
        speed = slower;
    }
    let (tracks, report) = cleaned(track.clone());
    assert_eq!((tracks, counts(&report)), (vec![track], [0; 10]));
}

#[test]
fn speeds_and_headings_that_contradict_the_positions_are_taken_from_these() {
    let mut track = car(0..30);
    track.states[9].speed = 25.5;
    track.states[20].speed = 24.5;
    track.states[11].heading = 0.9;
    track.states[22].heading = 0.7;
    let (tracks, report) = cleaned(track);
    assert_eq!((report.speeds.count, report.headings.count), (1, 1));
    let states = &tracks[0].states;
    assert!((states[9].speed - 20.0).abs() < 1e-9 && states[11].heading.abs() < 1e-9);
    assert_eq!((states[20].speed, states[22].heading), (24.5, 0.7));
}

#[test]
fn a_vehicle_that_is_seen_only_in_part_at_the_ends_is_where_its_motion_says_and_keeps_its_speed() {
    // At 5 Hz one box is cut off, at 25 Hz several are.
    for (step, cut_off) in [(0.2, vec![1.8]), (0.04, vec![2.0, 1.6, 1.2, 0.8, 0.2])] {
        let mut whole = car(0..60);
        whole.states.iter_mut().for_each(|it| it.x = 20.0 * step * it.frame as f64);
        let mut track = whole.clone();
        for (at, off) in cut_off.iter().enumerate() {
            track.states[at].x += off;
            track.states[59 - at].x -= off;
        }
        let (recording, report) = clean(Recording { step, tracks: vec![track], ..Recording::default() });
        assert_eq!(
            (report.partly_seen.count, report.speeds.count),
            (2 * cut_off.iter().filter(|it| **it > 0.5).count(), 0)
        );
        for (state, expected) in recording.tracks[0].states.iter().zip(&whole.states) {
            assert!((state.x - expected.x).abs() < 0.3 && state.speed == expected.speed, "{state:?}");
        }
    }
}

#[test]
fn a_car_may_back_up() {
    let mut track = car(0..30);
    for state in &mut track.states {
        (state.x, state.speed, state.heading) = (-0.1 * state.x, 2.0, 0.0);
    }
    let (tracks, report) = cleaned(track.clone());
    assert_eq!((tracks, counts(&report)), (vec![track], [0; 10]));
}

#[test]
fn absurd_sizes_become_usual_ones() {
    for (length, width) in [(0.2, 1.8), (4.5, 9.0), (f64::NAN, 1.8)] {
        let (tracks, report) = cleaned(Track { length, width, ..car(0..9) });
        assert_eq!((tracks[0].length, tracks[0].width, report.sizes.count), (4.5, 1.8, 1));
    }
}

#[test]
fn a_report_names_the_first_cases_of_each_kind() {
    let mut track = car(0..100);
    track.states.iter_mut().step_by(10).for_each(|it| it.speed = 40.0);
    let (_, report) = cleaned(track);
    assert_eq!(
        report.to_string(),
        "100 states\n10 speeds that contradict the positions, replaced: track 5 at 0.00 s, track 5 at 1.00 s, \
         track 5 at 2.00 s, track 5 at 3.00 s, track 5 at 4.00 s, …"
    );
}

#[test]
fn a_track_of_few_states_does_not_grow_without_bound() {
    let mut track = car((0..200).map(|it| 100 * it));
    track.states.iter_mut().for_each(|it| it.x = 0.2 * it.frame as f64);
    let recording = Recording { step: 0.01, tracks: vec![track], ..Recording::default() };
    let (recording, report) = clean(recording);
    // Six gaps of 99 frames are filled; the next would make the track more than four times as long.
    assert_eq!((report.interpolated.count, report.long_gaps.count), (6 * 99, 193));
    assert_eq!(recording.tracks.iter().map(|it| it.states.len()).sum::<usize>(), 200 + 6 * 99);
}
