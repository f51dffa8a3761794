//! Tables of datasets: what is written in their layouts is read as it was.

mod written;

use std::f64::consts::{FRAC_PI_2, PI};
use std::fs;
use std::path::PathBuf;

use laneweave_recordings::datasets::Dataset;
use laneweave_recordings::table::{Known, Layout, read};
use laneweave_recordings::{Recording, RecordingError, RoadUser, State, Track, clean, open};
use proptest::prelude::*;
pub(crate) use written::ind;
use written::{highd, ngsim};

const FEET: f64 = 0.3048;

/// Cars and a truck that drive along x in both directions, with a slight bend.
pub(crate) fn motorway(step: f64) -> Recording {
    let track = |id: i64, class: RoadUser, along: f64| {
        let (length, width) = class.usual_size();
        let states = (5 * id..5 * id + 200).map(|frame| {
            let t = frame as f64 * step;
            let (vx, vy) = (along * (20.0 + 2.0 * (0.2 * t).sin()), 0.3 * (0.1 * t).cos());
            let heading = vy.atan2(vx);
            let x = 500.0 + along * (20.0 * t + 10.0 * (1.0 - (0.2 * t).cos()));
            let y = -10.0 * id as f64 + 3.0 * (0.1 * t).sin();
            State { frame, x, y, speed: vx.hypot(vy), heading }
        });
        Track { id, class, length, width, states: states.collect() }
    };
    let tracks =
        vec![track(1, RoadUser::Car, 1.0), track(2, RoadUser::Truck, -1.0), track(7, RoadUser::Car, -1.0)];
    Recording { step, tracks, ..Recording::default() }
}

/// A folder of its own for the files of a test.
pub(crate) fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("laneweave_datasets_{}_{name}", std::process::id()));
    fs::create_dir_all(&folder).expect("it can be made");
    folder
}

/// How much two headings differ.
fn turn(a: f64, b: f64) -> f64 {
    (a - b + PI).rem_euclid(2.0 * PI) - PI
}

#[track_caller]
fn assert_same(read: &Recording, written: &Recording, [metres, speed, angle]: [f64; 3]) {
    assert!((read.step - written.step).abs() < 1e-9, "{}", read.step);
    assert_eq!(read.tracks.len(), written.tracks.len());
    for (a, b) in read.tracks.iter().zip(&written.tracks) {
        assert_eq!((a.id, a.class, a.states.len()), (b.id, b.class, b.states.len()));
        assert!((a.length - b.length).abs() < 0.01 && (a.width - b.width).abs() < 0.01, "{a:?}");
        let first = [a, b].map(|it| it.states[0].frame);
        for (a, b) in a.states.iter().zip(&b.states) {
            assert_eq!(a.frame - first[0], b.frame - first[1]);
            assert!((a.x - b.x).hypot(a.y - b.y) < metres, "{a:?} {b:?}");
            assert!((a.speed - b.speed).abs() < speed, "{a:?} {b:?}");
            assert!(turn(a.heading, b.heading).abs() < angle, "{a:?} {b:?}");
        }
    }
}

#[test]
fn highd_is_mirrored_and_its_corners_become_centres() {
    let written = motorway(0.04);
    let folder = folder("highd");
    let path = highd(&written, &folder);
    let (recording, problems) = open(&path, None).expect("it is sound");
    assert_eq!(problems, []);
    assert_same(&recording, &written, [0.02, 0.01, 0.001]);
    fs::remove_file(folder.join("01_tracksMeta.csv")).unwrap();
    let (recording, problems) = open(&path, None).expect("it is sound");
    assert_eq!(recording.tracks[1].class, RoadUser::Car);
    assert!(problems[0].what.starts_with("no tracksMeta file is beside the table"), "{problems:?}");
}

#[test]
fn ind_has_degrees_and_classes_in_another_file() {
    let mut written = motorway(1.0 / 29.97);
    written.tracks[2].class = RoadUser::Pedestrian;
    let folder = folder("ind");
    let (recording, problems) = open(&ind(&written, &folder), None).expect("it is sound");
    assert_eq!(problems, []);
    assert_same(&recording, &written, [0.02, 0.01, 0.001]);
}

#[test]
fn ngsim_has_feet_fronts_times_and_ids_that_are_used_again() {
    let mut written = motorway(0.1);
    // The same id, five minutes later.
    let mut again = written.tracks[0].clone();
    again.states.iter_mut().for_each(|it| it.frame += 3000);
    let mut both = written.clone();
    both.tracks[0].states.extend(again.states.iter().copied());
    let folder = folder("ngsim");
    let (recording, problems) = open(&ngsim(&both, &folder), None).expect("it is sound");
    again.id = 8;
    written.tracks.insert(1, again);
    // Headings come from positions of the front, which rounds a bend a little differently.
    assert_same(&recording, &written, [0.05, 0.05, 0.02]);
    assert_eq!(problems.len(), 1, "{problems:?}");
    assert!(problems[0].to_string().starts_with("track 1"), "{problems:?}");
    assert!(problems[0].what.contains("its id is used again from frame"), "{problems:?}");
}

#[test]
fn a_table_of_several_places_is_refused() {
    let folder = folder("places");
    let path = ngsim(&motorway(0.1), &folder);
    let table = fs::read_to_string(&path).expect("it is there");
    let mixed = format!("{table}9,9,9,1118846980200,0,0,9,6,2,40,0,2,i-80\n");
    fs::write(&path, mixed).expect("it can be written");
    let said = open(&path, None).expect_err("it holds two recordings").to_string();
    assert!(
        said.contains("Location is \"i-80\", and \"us-101\" above") && said.ends_with("keep the rows of one"),
        "{said}"
    );
}

#[test]
fn any_table_is_read_by_a_layout_in_toml() {
    let layout = Layout::parse(
        "frames_per_second = 10\npoint = \"front\"\n[columns]\ntrack = \"who\"\nframe = \"n\"\nx = \"east\"\ny = \"north\"\n\
         class = \"kind\"\nlength = \"l\"\n[units]\nlength = \"ft\"\n[classes]\nlorry = \"truck\"\nPkw = \"car\"\n",
    )
    .expect("it is a layout");
    let rows: String =
        (0..40).map(|n| format!("3,{n},lorry,{},0,40\n4,{n},Pkw,0,{},15\n", 10 * n, -5 * n)).collect();
    let table = format!("who,n,kind,east,north,l\n{rows}");
    let (recording, problems) = read(table.as_bytes(), &layout, &Known::default()).expect("it is sound");
    assert_eq!(problems.len(), 2, "no width: {problems:?}");
    let [truck, car] = &recording.tracks[..] else { panic!("two tracks") };
    assert_eq!((truck.class, car.class, recording.step), (RoadUser::Truck, RoadUser::Car, 0.1));
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-9, "{a} {b}");
    near(truck.states[20].speed, 100.0 * FEET);
    near(truck.states[20].x, (200.0 - 20.0) * FEET);
    near(car.states[20].heading, -FRAC_PI_2);
    near(car.states[20].y, (-100.0 + 7.5) * FEET);
}

#[test]
fn what_is_wrong_with_a_layout_or_a_table_is_said() {
    let says = |text: &str| Layout::parse(text).expect_err("it is none").to_string();
    let said = says("[columns]\ntrack = \"id\"\nx = \"x\"\ny = \"y\"\nspeeed = \"v\"\n");
    assert!(said.starts_with("line 5: unknown field `speeed`"), "{said}");
    assert!(says("points = 3\n").contains("unknown field `points`"));
    assert!(says("[columns]\ntrack = \"id\"\n").contains("missing field `x`"));
    let layout = Layout::parse("[columns]\ntrack = \"id\"\nx = \"x\"\ny = \"y\"\n").unwrap();
    let refused = |layout: &Layout, table: &str| {
        read(table.as_bytes(), layout, &Known::default()).expect_err("it is none").to_string()
    };
    assert!(refused(&layout, "id,x,y\n1,2,3\n").starts_with("its layout names neither a column `frame`"));
    let layout = Layout::parse("[columns]\ntrack = \"id\"\nframe = \"n\"\nx = \"x\"\ny = \"y\"\n").unwrap();
    assert!(refused(&layout, "id,n,x,y\n1,1,2,3\n").starts_with("nothing says how many frames a second has"));
    let unknown = folder("unknown").join("a.csv");
    fs::write(&unknown, "a,b,c\n1,2,3\n").unwrap();
    let error = open(&unknown, None).expect_err("nobody knows it");
    assert!(matches!(error, RecordingError::UnknownTable { .. }), "{error}");
    assert!(error.to_string().contains("INTERACTION; highD; inD, rounD, exiD; NGSIM"), "{error}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]
    #[test]
    fn damaged_tables_are_read_or_refused_and_what_is_read_can_be_cleaned(
        which in 0..3_usize, places in proptest::collection::vec((0..20_000_usize, any::<u8>(), 0..4_usize), 1..8),
    ) {
        let mut recording = motorway(0.1);
        recording.tracks.iter_mut().for_each(|it| it.states.truncate(12));
        let name = format!("damaged_{which}");
        let path = [highd, ind, ngsim][which](&recording, &folder(&name));
        let mut table = fs::read(path).unwrap();
        let strange: [&[u8]; 4] = [b",", b"nan", b"-1e308", b"\n"];
        for (place, byte, kind) in places {
            let at = place % table.len();
            if kind == 0 {
                table[at] = byte;
            } else {
                let end = (at + 3).min(table.len());
                table.splice(at..end, strange[kind].iter().copied());
            }
        }
        let layout = [Dataset::HighD, Dataset::InD, Dataset::Ngsim][which].layout();
        if let Ok((recording, _)) = read(&table[..], &layout, &Known::default()) {
            let (cleaned, _) = clean(recording);
            for state in cleaned.tracks.iter().flat_map(|it| &it.states) {
                prop_assert!([state.x, state.y, state.speed, state.heading].iter().all(|it| it.is_finite()));
            }
        }
    }
}

#[test]
fn datasets_are_recognised_by_their_headers() {
    for dataset in Dataset::ALL {
        let columns = dataset.layout().columns;
        let named = [
            &Some(columns.track),
            &columns.frame,
            &columns.time,
            &Some(columns.x),
            &columns.vx,
            &columns.width,
        ];
        let header: Vec<&str> = named.into_iter().flatten().map(String::as_str).collect();
        assert_eq!(Dataset::of_start(header.join(",").as_bytes()), Some(dataset));
    }
    assert_eq!(Dataset::of_start(b"id,frame,x,y"), None);
}
