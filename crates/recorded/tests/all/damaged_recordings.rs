//! Reading, cleaning, matching and perceiving do not panic, whatever the bytes.

use laneweave_generate::{Motorway, motorway};
use laneweave_network::{Network, Side};
use laneweave_recorded::{Assumed, Replay};
use laneweave_recordings::{Matched, Recording, RoadUser, State, Track, clean, interaction, lane_changes};
use laneweave_sim::Navigator;
use proptest::prelude::*;

use crate::drivers::usual;

fn small_file() -> String {
    let mut text = String::from("track_id,frame_id,timestamp_ms,agent_type,x,y,vx,vy,psi_rad,length,width\n");
    for track in 1..4 {
        for frame in 0..12 {
            let (x, y) = (3.0 * frame as f64, 1.0 + 0.3 * (track * frame) as f64);
            text += &format!("{track},{frame},{},car,{x:.3},{y:.3},29.5,3.1,0.10,4.5,1.8\n", 100 * frame);
        }
    }
    text
}

fn use_it(recording: Recording) {
    let road = Motorway { lanes: 2, length_m: 100.0, ..Motorway::default() };
    let network = motorway(&road).expect("it fits").build().expect("it has lanes").network;
    perceive(&network, &recording);
    let (recording, report) = clean(recording);
    perceive(&network, &recording);
    assert!(report.to_string().starts_with(&format!("{} states", report.states)));
    let matched = Matched::new(&network, &recording);
    for change in lane_changes(&matched) {
        assert!(change.time.is_finite() && change.seen_after >= 0.8);
    }
    for frame in -1..13 {
        assert!(matched.frame(frame).is_sorted_by_key(|it| (it.place.lanelet, it.place.station)));
    }
}

/// Perceives every frame of a recording.
fn perceive(network: &Network, recording: &Recording) {
    let matched = Matched::new(network, recording);
    let navigator = Navigator::new(network);
    let assume = |track| Assumed::by_its_speeds(&matched, track, 0);
    let (changes, driver_parameters) = (lane_changes(&matched), [usual()]);
    let replay =
        Replay::new(&matched, &changes, &navigator, &driver_parameters, assume).expect("they are drivers");
    for number in -1..13 {
        let frame = replay.frame(number);
        for vehicle in frame.vehicles() {
            let sides = Side::BOTH.into_iter().filter_map(|side| frame.perceive(vehicle, side)).count();
            assert!(sides <= 1, "there are two lanes");
        }
    }
}

#[test]
fn the_small_file_is_sound() {
    let (recording, problems) = interaction::read(small_file().as_bytes()).unwrap();
    assert_eq!((recording.tracks.len(), problems.len()), (3, 0));
    use_it(recording);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn any_bytes_are_read_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        let _ = interaction::read(&bytes);
    }

    #[test]
    fn files_with_changed_bytes_never_panic(
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..20),
    ) {
        let mut bytes = small_file().into_bytes();
        for (at, byte) in changes {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        if let Ok((recording, _)) = interaction::read(&bytes) {
            use_it(recording);
        }
    }

    #[test]
    fn files_with_changed_fields_never_panic(
        changes in prop::collection::vec(
            (any::<prop::sample::Index>(), prop_oneof![
                any::<f64>().prop_map(|it| it.to_string()),
                any::<i64>().prop_map(|it| it.to_string()),
                Just(String::new()),
                Just("\"".into()),
            ]),
            1..12,
        ),
    ) {
        let text = small_file();
        let mut fields: Vec<String> = text.split(',').map(String::from).collect();
        for (at, field) in changes {
            let at = at.index(fields.len());
            fields[at] = field;
        }
        if let Ok((recording, _)) = interaction::read(fields.join(",").as_bytes()) {
            use_it(recording);
        }
    }

    #[test]
    fn any_recording_is_cleaned_and_matched(
        step in any::<f64>(),
        states in prop::collection::vec((any::<i64>(), any::<f64>(), -20.0..20.0_f64, any::<f64>()), 0..20),
    ) {
        let state = |(frame, x, y, heading)| State { frame, x, y, speed: 20.0, heading };
        let states = states.into_iter().map(state).collect();
        let track = Track { id: 1, class: RoadUser::Car, length: 4.5, width: 1.8, states };
        use_it(Recording { step, tracks: vec![track], ..Recording::default() });
    }
}
