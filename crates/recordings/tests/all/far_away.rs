//! One time, one position or one id far from all others costs nothing, and what is left out is named.

use std::time::{Duration, Instant};

use laneweave_network::Network;
use laneweave_recordings::{
    JoinError, Matched, Recording, clean, commonroad, interaction, join, lane_changes, open, resampled,
};
use laneweave_test_data::data;

const HEADER: &str = "track_id,frame_id,timestamp_ms,agent_type,x,y,vx,vy,psi_rad,length,width";

/// Rows of a car in frames of 0.1 s.
fn rows(id: i64, frames: std::ops::Range<i64>) -> String {
    let row = |frame: i64| format!("{id},{frame},{},car,{},0,20,0,0,4.5,1.8\n", 100 * frame, 2 * frame);
    frames.map(row).collect()
}

fn read(rows: &str) -> (Recording, Vec<String>) {
    let text = format!("{HEADER}\n{rows}");
    let (recording, problems) = interaction::read(text.as_bytes()).expect("it is sound");
    (recording, problems.iter().map(ToString::to_string).collect())
}

fn network() -> Network {
    let map = laneweave_test_data::map("motorway_2_lanes.osm");
    laneweave_maps::load(&map, &laneweave_maps::ReadOptions::default()).expect("it can be read").network
}

#[test]
fn gaps_of_more_than_five_minutes_part_a_recording() {
    let (recording, problems) = read(&(rows(1, 0..20) + &rows(2, 3019..3030)));
    assert_eq!((recording.frames(), problems), (Some((0, 3029)), vec![]), "300 s are no such gap");
    let parts = rows(1, 0..20)
        + &rows(2, 3020..3050)
        + &rows(3, 9000..9001)
        + &rows(4, 10_i64.pow(12)..10_i64.pow(12) + 5);
    let (recording, problems) = read(&parts);
    assert_eq!(recording.tracks.len(), 1);
    assert_eq!((recording.tracks[0].id, recording.frames()), (2, Some((3020, 3049))));
    assert_eq!(
        problems,
        [
            "the recording: for more than 300 s nobody is there, so only its fullest part is used, frames 3020 to 3049; 26 \
          states are left out: frames 0 to 19, frame 9000, frames 1000000000000 to 1000000000004; correct their times, \
          or give each part as a file of its own"
        ]
    );
}

#[test]
fn many_parts_are_counted() {
    let (recording, problems) =
        read(&(0..8).map(|it| rows(it, 10_000 * it..10_000 * it + 2)).collect::<String>());
    assert_eq!(recording.frames(), Some((0, 1)));
    assert!(problems[0].contains("frames 30000 to 30001, 4 more parts; correct"), "{problems:?}");
}

#[test]
fn far_positions_and_huge_ids_cost_nothing() {
    let far = ["1e9", "-1e18", "1e300"];
    let row = |(frame, x): (i64, &&str)| {
        format!("{},{frame},{},car,{x},{x},20,0,0,4.5,1.8\n", i64::MAX, 100 * frame)
    };
    let far: String = (5..).zip(&far).map(row).collect();
    let begin = Instant::now();
    let (recording, _) = read(&(rows(1, 0..20) + &far + &rows(i64::MIN, 3..9)));
    let (recording, _) = clean(recording);
    let network = network();
    let matched = Matched::new(&network, &recording);
    assert_eq!(lane_changes(&matched), []);
    assert!(recording.free_ids().take(3).all(|id| recording.tracks.iter().all(|it| it.id != id)));
    assert!(begin.elapsed() < Duration::from_secs(1), "{:?}", begin.elapsed());
}

#[test]
fn far_positions_in_windows_do_not_move_frames() {
    let (first, _) = read(&rows(1, 0..20));
    let mut second = first.clone();
    second.tracks[0].states.iter_mut().for_each(|it| it.x += 1e300);
    assert!(matches!(join(vec![first, second]), Err(JoinError::Elsewhere { agreeing: 0, .. })));
}

#[test]
fn who_is_seen_twice_far_apart_is_not_looked_for_between() {
    let (recording, _) = read(&(rows(1, 0..2) + &rows(2, 1..3000) + &rows(1, 2999..3001)));
    let track = &recording.tracks[0];
    let found = resampled(&track.states, 0.1, 0.05);
    assert_eq!(found.iter().map(|it| it.frame).collect::<Vec<_>>(), [0, 1, 2, 5998, 5999, 6000]);
    let network = network();
    let matched = Matched::new(&network, &recording);
    assert_eq!(matched.present(1).map(|it| it.0).collect::<Vec<_>>(), [0, 1]);
    assert_eq!(matched.present(100).collect::<Vec<_>>(), [(1, 99)]);
    assert_eq!(matched.present(3500).count(), 0);
    let (sparse, _) = read(&(rows(1, 0..2) + &rows(2, 1000..1002)));
    assert_eq!(sparse.frames_by(10), [0, 1000]);
    assert_eq!(sparse.frames_by(1), [0, 1, 1000, 1001]);
}

#[test]
fn steps_of_commonroad_are_those_of_recordings() {
    let text = "<commonRoad commonRoadVersion=\"2020a\" timeStepSize=\"1e9\"></commonRoad>";
    let said = commonroad::read(text.as_bytes()).expect_err("nobody records so").to_string();
    assert!(
        said.starts_with("line 1: frames are 1000000000000 ms apart") && said.contains("timeStepSize"),
        "{said}"
    );
}

#[test]
fn small_cases_with_one_time_far_away_are_cut_at_once() {
    for (name, frames) in [
        ("ngsim_one_time_off.csv", 59),
        ("interaction_last_row_far_in_time.csv", 59),
        ("far_frame_highd/01_tracks.csv", 0),
    ] {
        let Some(path) = data(&format!("cases/{name}")) else { return };
        let begin = Instant::now();
        let (recording, problems) = open(&path, None).expect("it is read");
        let states: usize = recording.tracks.iter().map(|it| it.states.len()).sum();
        assert!(frames == 0 || states < 60, "{name}: {states}");
        assert!(problems.iter().any(|it| it.what.contains("are left out: frame")), "{name}: {problems:?}");
        assert!(begin.elapsed() < Duration::from_secs(1), "{name}");
    }
}
