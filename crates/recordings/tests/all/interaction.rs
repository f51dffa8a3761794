//! Track files of the INTERACTION dataset: what is read, what is refused, and the messages.

use laneweave_recordings::{Recording, RecordingError, RoadUser, interaction};

const HEADER: &str = "track_id,frame_id,timestamp_ms,agent_type,x,y,vx,vy,psi_rad,length,width";

fn read(rows: &[&str]) -> (Recording, Vec<String>) {
    let text = format!("{HEADER}\n{}\n", rows.join("\n"));
    let (recording, problems) = interaction::read(text.as_bytes()).expect("the file is sound");
    (recording, problems.iter().map(|it| it.to_string()).collect())
}

fn refusal(text: &str) -> String {
    interaction::read(text.as_bytes()).expect_err("it is no recording").to_string()
}

#[test]
fn a_row_becomes_a_state_in_metres_seconds_and_radians() {
    let (recording, problems) =
        read(&["7,1,100,truck,1.5,-2,3,4,0.5,12,2.5", "7,2,140,truck,1.62,-1.84,3,4,0.5,12,2.5"]);
    assert!(problems.is_empty(), "{problems:?}");
    assert_eq!((recording.step, recording.tracks.len(), recording.frames()), (0.04, 1, Some((1, 2))));
    let track = &recording.tracks[0];
    assert_eq!((track.id, track.class, track.length, track.width), (7, RoadUser::Truck, 12.0, 2.5));
    let state = track.states[0];
    assert_eq!((state.frame, state.x, state.y, state.speed, state.heading), (1, 1.5, -2.0, 5.0, 0.5));
}

#[test]
fn columns_and_rows_come_in_any_order() {
    let (expected, _) = read(&["1,1,0,car,0,0,9,0,0,4,2", "1,2,100,car,0.9,0,9,0,0,4,2"]);
    let text = "\u{feff}y, x ,note,vy,vx,width,\"length\",psi_rad,agent_type,timestamp_ms,frame_id,track_id\r\n\
                0,0.9,late,0,9,2,4,0,car,100,2,1\r\n\r\n0,0,early,0,9,2,4,0,\"car\",0,1,1";
    let (recording, problems) = interaction::read(text.as_bytes()).unwrap();
    assert_eq!((recording, problems), (expected, vec![]));
}

#[test]
fn a_missing_column_is_named() {
    for column in ["track_id", "frame_id", "timestamp_ms", "agent_type", "x", "y", "vx", "vy"] {
        let header: Vec<&str> = HEADER.split(',').filter(|it| *it != column).collect();
        let found = header.join(",");
        assert_eq!(
            refusal(&format!("{found}\n")),
            format!("line 1: the column {column} is missing; add it to the header, which has: {found}")
        );
    }
    assert!(refusal("").starts_with("the file is empty"));
}

#[test]
fn who_walks_needs_no_size_and_no_heading() {
    let text = "track_id,frame_id,timestamp_ms,agent_type,x,y,vx,vy\n\
                P3,1,0,pedestrian,0,0,0,0\nP3,2,100,pedestrian,0,0.1,0,1\nP3,3,200,pedestrian,0,0.2,0,0\n\
                P4,1,0,pedestrian/bicycle,0,0,0,0\n";
    let (recording, problems) = interaction::read(text.as_bytes()).unwrap();
    assert!(problems.is_empty());
    let [walker, other] = &recording.tracks[..] else { panic!("two tracks") };
    assert_eq!((walker.class, walker.length, walker.width), (RoadUser::Pedestrian, 0.6, 0.6));
    assert_eq!([walker.id, other.id].map(|it| recording.name(it)), ["P3", "P4"]);
    let north = std::f64::consts::FRAC_PI_2;
    assert_eq!(walker.states.iter().map(|it| it.heading).collect::<Vec<_>>(), [north; 3]);
    assert_eq!((other.class, other.states[0].heading), (RoadUser::Other, 0.0));
}

#[test]
fn a_car_without_a_size_gets_the_usual_one_and_is_listed() {
    let (recording, problems) = read(&["1,1,0,car,0,0,9,0,0,,", "1,2,100,car,0.9,0,9,0,,,"]);
    assert_eq!((recording.tracks[0].length, recording.tracks[0].width), (4.5, 1.8));
    assert_eq!(
        problems,
        ["track 1 (line 2): it has no size, so 4.5 m × 1.8 m is assumed; fill in length and width"]
    );
}

#[test]
fn rows_that_cannot_be_used_are_left_out_and_listed_with_their_line() {
    let (recording, problems) = read(&[
        "1,1,0,car,0,0,9,0,0,4,2",
        "1,2,100,car,zero,0,9,0,0,4,2",
        "1,3,200,car,1.8",
        "1,4,300,car,2.7,0,9,0,0,4,2",
        "1,4,300,car,9.9,0,9,0,0,4,2",
        "2,1152921504606846976,0,car,0,0,9,0,0,4,2",
        "3,1,0,hovercraft,0,0,9,0,0,4,2",
    ]);
    let track = &recording.tracks[0];
    assert_eq!(track.states.iter().map(|it| (it.frame, it.x)).collect::<Vec<_>>(), [(1, 0.0), (4, 2.7)]);
    assert_eq!(recording.tracks[1].class, RoadUser::Other);
    assert_eq!(
        problems,
        [
            "row (line 3): x is \"zero\", which is not a valid number for it, so it is left out; correct the number",
            "row (line 4): it has 5 fields, the header names at least 8, so it is left out; fill in all columns",
            "track 1 (line 6): frame 4 occurs again, so only its first row is used; keep one row for each frame",
            "row (line 7): frame_id is 1152921504606846976, beyond ±1125899906842624, so it is left out; correct \
             the number",
            "track 3 (line 8): its agent_type \"hovercraft\" is unknown, so it is not used as a vehicle; use one of car, van, \
             truck, bus, motorcycle, bicycle, pedestrian",
        ]
    );
}

#[test]
fn many_problems_of_one_kind_are_counted() {
    let mut rows = vec!["1,1,0,car,0,0,9,0,0,4,2", "1,2,100,car,0.9,0,9,0,0,4,2"];
    rows.extend(["?"; 1000]);
    let (_, problems) = read(&rows);
    assert_eq!(problems.len(), 11);
    assert_eq!(
        problems[10],
        "the file: 990 more of the kind \"row that cannot be read\"; fill in all columns"
    );
}

#[test]
fn times_must_belong_to_frames_at_equal_distances() {
    let row = |frame: i64, time: i64| format!("1,{frame},{time},car,0,0,9,0,0,4,2\n");
    let file = |rows: &[(i64, i64)]| {
        format!("{HEADER}\n{}", rows.iter().map(|it| row(it.0, it.1)).collect::<String>())
    };
    // 30 frames a second, in whole milliseconds.
    let thirds = file(&[(0, 0), (1, 33), (2, 67), (3, 100)]);
    assert!((interaction::read(thirds.as_bytes()).unwrap().0.step - 1.0 / 30.0).abs() < 1e-12);
    assert_eq!(
        refusal(&file(&[(0, 0), (1, 100), (2, 250), (3, 300)])),
        "line 4: frame 2 is at 250 ms, but should be at 200 ms with 100 ms between frames; correct timestamp_ms or \
         frame_id"
    );
    assert_eq!(
        refusal(&file(&[(5, 0), (5, 0)])),
        "line 2: all rows are of the frame 5; a recording needs two frames at least"
    );
    assert!(refusal(&file(&[(0, 0), (1, 3)])).starts_with("line 2: frames are 3 ms apart"));
    assert!(refusal(&file(&[(0, 100), (1, 0)])).starts_with("line 2: frames are -100 ms apart"));
}

#[test]
fn a_file_without_usable_rows_is_refused() {
    assert_eq!(
        refusal(&format!("{HEADER}\n1,2\n")),
        "none of its 1 rows can be used (the first problem is row (line 2): it has 2 fields, the header names at \
         least 8, so it is left out; fill in all columns); add rows of tracks below the header"
    );
    assert!(matches!(
        interaction::read(HEADER.as_bytes()),
        Err(RecordingError::NoRows { rows: 0, problem: None })
    ));
}
