//! Track files of the INTERACTION dataset: what is written can be read again.

use laneweave_recordings::{Recording, RoadUser, State, Track, interaction};

fn written(recording: &Recording) -> String {
    let mut file = Vec::new();
    interaction::write(recording, &mut file).expect("memory can be written to");
    String::from_utf8(file).expect("it is text")
}

fn recording() -> Recording {
    let tracks = RoadUser::ALL.into_iter().zip(1..).map(|(class, id)| {
        let states = (10 * id..10 * id + 3).map(|frame| {
            let x = 1000.125 + 0.5 * frame as f64;
            State { frame, x, y: -7.25 * id as f64, speed: 12.5, heading: 0.0 }
        });
        let (length, width) = class.usual_size();
        Track { id, class, length, width, states: states.collect() }
    });
    Recording { step: 0.04, tracks: tracks.collect(), ..Recording::default() }
}

#[test]
fn a_state_becomes_a_row() {
    let mut recording = recording();
    recording.tracks.truncate(1);
    recording.tracks[0].states.truncate(1);
    assert_eq!(
        written(&recording),
        "track_id,frame_id,timestamp_ms,agent_type,x,y,vx,vy,psi_rad,length,width\n\
         1,10,400,car,1005.125,-7.250,12.500,0.000,0.000,4.50,1.80\n"
    );
}

#[test]
fn what_is_written_is_read_as_it_was() {
    let recording = recording();
    let (again, problems) = interaction::read(written(&recording).as_bytes()).expect("it is a recording");
    assert_eq!(problems, []);
    assert!((again.step - 0.04).abs() < 1e-12);
    assert_eq!(again.tracks, recording.tracks);
}

#[test]
fn numbers_keep_millimetres_and_a_thousandth_of_a_radian() {
    let mut recording = recording();
    for (state, number) in recording.tracks.iter_mut().flat_map(|it| &mut it.states).zip(0..) {
        let turn = 0.317 * f64::from(number);
        (state.x, state.y) = (1000.0 * turn.sin(), 500.0 * turn.cos());
        (state.speed, state.heading) = (1.7 * turn, turn.sin() * 3.1);
    }
    let (again, _) = interaction::read(written(&recording).as_bytes()).expect("it is a recording");
    let states = |it: &Recording| it.tracks.iter().flat_map(|it| it.states.clone()).collect::<Vec<_>>();
    for (read, written) in states(&again).iter().zip(&states(&recording)) {
        assert!((read.x - written.x).abs() <= 0.000_51 && (read.y - written.y).abs() <= 0.000_51);
        assert!(
            (read.speed - written.speed).abs() <= 0.001 && (read.heading - written.heading).abs() <= 0.000_51
        );
    }
}
