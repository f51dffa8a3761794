//! CommonRoad recordings: a small one made for the test, broken ones, and real ones if they are available.

use std::f64::consts::FRAC_PI_2;
use std::fs;

use laneweave_maps::{Problem, ReadOptions};
use laneweave_recordings::{Recording, RecordingError, RoadUser, State, Track, commonroad};
use laneweave_test_data::data;

/// A car with three states (the second one's values are intervals) and a parked one, in version 2020a.
const TWO_CARS: &str = "\
<commonRoad commonRoadVersion='2020a' timeStepSize='0.5'>
<dynamicObstacle id='7'><type>car</type>
<shape><rectangle><length>4.5</length><width>1.8</width></rectangle></shape>
<initialState><position><point><x>10</x><y>-2</y></point></position><orientation><exact>0</exact></orientation>\
<time><exact>0</exact></time><velocity><exact>20</exact></velocity></initialState>
<trajectory>
<state><position><rectangle><length>1</length><width>1</width><center><x>20</x><y>-2</y></center></rectangle>\
</position><orientation><intervalStart>-0.1</intervalStart><intervalEnd>0.3</intervalEnd></orientation>\
<time><intervalStart>1</intervalStart><intervalEnd>1</intervalEnd></time>\
<velocity><intervalStart>18</intervalStart><intervalEnd>22</intervalEnd></velocity></state>
<state><position><point><x>31</x><y>-2</y></point></position><orientation><exact>0</exact></orientation>\
<time><exact>2</exact></time></state>
</trajectory></dynamicObstacle>
<staticObstacle id='8'><type>parkedVehicle</type></staticObstacle>
<planningProblem id='9'><initialState><time><exact>0</exact></time></initialState></planningProblem>
</commonRoad>
";

fn read(text: &str) -> Result<(Recording, Vec<String>), RecordingError> {
    let (recording, problems) = commonroad::read(text.as_bytes())?;
    Ok((recording, problems.iter().map(Problem::to_string).collect()))
}

/// The problems of the recording with `from` replaced, which must be there, without the problem of the parked car;
/// and the remaining tracks.
fn broken(from: &str, to: &str) -> (Vec<String>, Vec<Track>) {
    assert!(TWO_CARS.contains(from), "{from}");
    let (recording, mut problems) = read(&TWO_CARS.replace(from, to)).expect("a track is left");
    problems.retain(|it| !it.starts_with("obstacle 8"));
    (problems, recording.tracks)
}

#[test]
fn tracks_are_read_with_their_frames() {
    let (recording, problems) = read(TWO_CARS).unwrap();
    let state = |frame, x, speed, heading| State { frame, x, y: -2.0, speed, heading };
    // The last state's velocity is that of the path: 11 m in 0.5 s.
    let states = vec![state(0, 10.0, 20.0, 0.0), state(1, 20.0, 20.0, 0.1), state(2, 31.0, 22.0, 0.0)];
    let car = Track { id: 7, class: RoadUser::Car, length: 4.5, width: 1.8, states };
    assert!((recording.tracks[0].states[1].heading - 0.1).abs() < 1e-15);
    let mut read = recording.clone();
    read.tracks[0].states[1].heading = 0.1;
    assert_eq!(read, Recording { step: 0.5, tracks: vec![car], ..Recording::default() });
    assert_eq!(
        problems,
        ["obstacle 8 (line 9): parked vehicles are no tracks: this one and 0 more; \
          take this file as the map: then they stand on its roads"]
    );
}

#[test]
fn version_2018b_names_the_role_inside() {
    let old = TWO_CARS
        .replace("<dynamicObstacle id='7'>", "<obstacle id='7'><role>dynamic</role>")
        .replace("</dynamicObstacle>", "</obstacle>")
        .replace("<staticObstacle id='8'>", "<obstacle id='8'><role>static</role>")
        .replace("</staticObstacle>", "</obstacle>");
    assert_eq!(read(&old).unwrap().0, read(TWO_CARS).unwrap().0);
    assert_eq!(read(&old).unwrap().1, read(TWO_CARS).unwrap().1);
}

#[test]
fn shapes_may_lie_off_the_position_and_turned() {
    let offset = "<orientation>1</orientation><center><x>2</x><y>0.5</y></center></rectangle></shape>";
    let (problems, tracks) = broken("</rectangle></shape>", offset);
    assert_eq!(problems, [""; 0]);
    let first = tracks[0].states[0];
    assert_eq!((first.x, first.y, first.heading), (12.0, -1.5, 1.0));
    let turned = TWO_CARS
        .replace("<orientation><exact>0</exact>", &format!("<orientation><exact>{FRAC_PI_2}</exact>"))
        .replace("</rectangle></shape>", "<center><x>2</x><y>0.5</y></center></rectangle></shape>");
    let first = read(&turned).unwrap().0.tracks[0].states[0];
    assert!((first.x - 9.5).abs() < 1e-12 && first.y.abs() < 1e-12, "{first:?}");
    let circle = "<circle><radius>0.4</radius></circle>";
    let (_, tracks) = broken("<rectangle><length>4.5</length><width>1.8</width></rectangle>", circle);
    assert_eq!((tracks[0].length, tracks[0].width), (0.8, 0.8));
}

#[test]
fn types_become_classes() {
    use RoadUser::{Bicycle, Bus, Car, Motorcycle, Other, Pedestrian, Truck};
    for (name, class) in [
        ("car", Car),
        ("taxi", Car),
        ("priorityVehicle", Car),
        ("truck", Truck),
        ("bus", Bus),
        ("motorcycle", Motorcycle),
        ("bicycle", Bicycle),
        ("pedestrian", Pedestrian),
        ("train", Other),
        ("unknown", Other),
    ] {
        let (_, tracks) = broken("<type>car</type>", &format!("<type>{name}</type>"));
        assert_eq!(tracks[0].class, class, "{name}");
    }
}

#[test]
fn states_that_cannot_be_used_are_counted() {
    let why = |from: &str, to: &str| {
        let (problems, tracks) = broken(from, to);
        assert_eq!((problems.len(), tracks[0].states.len()), (1, 2), "{problems:?}");
        problems[0].clone()
    };
    assert_eq!(
        why("<time><exact>2</exact></time>", "<time><exact>2.5</exact></time>"),
        "obstacle 7 (line 2): 1 of its states are left out (the first, line 7: its time is not a whole number of steps); correct or \
         delete them"
    );
    assert!(why("<x>31</x>", "<x>1e9</x>").contains("line 7: it has no position"));
    assert!(why("<x>31</x>", "<x>wide</x>").contains("line 7: it has no position"));
    let heading =
        "<orientation><intervalStart>-0.1</intervalStart><intervalEnd>0.3</intervalEnd></orientation>";
    assert!(why(heading, "").contains("line 6: it has no orientation"));
    assert!(why("<exact>20</exact>", "<exact>200</exact>").contains("do not give a velocity up to 150 m/s"));
    assert!(why("<x>31</x>", "<x>310</x>").contains("do not give a velocity up to 150 m/s"));
    assert!(why("<time><exact>2</exact></time>", "<time><exact>1</exact></time>").contains("the same time"));
    for absurd in ["-1", "nan", "1e12", ""] {
        why("<time><exact>2</exact></time>", &format!("<time><exact>{absurd}</exact></time>"));
    }
}

#[test]
fn states_come_in_order_of_frames() {
    let turned = TWO_CARS
        .replace("<time><exact>2</exact>", "<time><exact>5</exact>")
        .replace("<time><exact>0</exact>", "<time><exact>9</exact>");
    let frames: Vec<i64> = read(&turned).unwrap().0.tracks[0].states.iter().map(|it| it.frame).collect();
    assert_eq!(frames, [1, 5, 9]);
}

#[test]
fn obstacles_that_cannot_be_used_are_left_out() {
    let good = "<obstacle id='1'><type>bus</type><shape><circle><radius>1</radius></circle></shape><initialState>\
                <position><point><x>0</x><y>0</y></point></position><orientation><exact>0</exact></orientation>\
                <time><exact>0</exact></time><velocity><exact>0</exact></velocity></initialState></obstacle>\n";
    let with = |more: &str| {
        let (problems, tracks) = broken("<planningProblem", &format!("{good}{more}<planningProblem"));
        (problems, tracks.iter().map(|it| it.id).collect::<Vec<_>>())
    };
    assert_eq!(with(""), (vec![], vec![7, 1]));
    for (more, what) in [
        (good.replace("'1'", "'x'"), "obstacle x (line 11): its id is missing or not a whole number"),
        (good.into(), "obstacle 1 (line 11): another obstacle above has the same id"),
        (
            good.replace("'1'", "'2'").replace("<radius>1<", "<radius>-1<"),
            "obstacle 2 (line 11): its first shape",
        ),
        (
            good.replace("'1'", "'2'").replace("circle", "polygon"),
            "obstacle 2 (line 11): its first shape is no",
        ),
    ] {
        let (problems, ids) = with(&more);
        assert_eq!((problems.len(), &ids[..]), (1, &[7, 1][..]), "{problems:?}");
        assert!(problems[0].starts_with(what), "{problems:?}");
    }
    let (problems, ids) = with(&good.replace("'1'", "'2'").replace("initialState", "firstState"));
    assert!(problems[0].starts_with("obstacle 2 (line 11): it has no state, so it is left out"));
    assert_eq!(ids, [7, 1]);
    let shapes =
        good.replace("'1'", "'2'").replace("</circle>", "</circle><circle><radius>9</radius></circle>");
    let (problems, ids) = with(&shapes);
    assert!(problems[0].contains("only the first of its 2 shapes is used"));
    assert_eq!(ids, [7, 1, 2]);
}

#[test]
fn occupancy_sets_are_passed_over() {
    let set = "<occupancySet><occupancy><shape><circle><radius>3</radius></circle></shape>\
               <time><exact>1</exact></time></occupancy></occupancySet></dynamicObstacle>";
    let (problems, tracks) = broken("</dynamicObstacle>", set);
    assert_eq!(
        problems,
        ["obstacle 7 (line 2): its occupancy set is ignored; give it a trajectory if it was observed"]
    );
    assert_eq!(tracks, read(TWO_CARS).unwrap().0.tracks);
}

#[test]
fn files_that_are_no_recording_say_why() {
    let why = |text: &str| read(text).unwrap_err().to_string();
    assert_eq!(
        why("<osm/>"),
        "line 1: the outermost element is <osm>, not <commonRoad>; is this a file of another format?"
    );
    let step = "line 1: commonRoad has no time between frames above 0 s; give it the attribute timeStepSize";
    assert_eq!(why(&TWO_CARS.replace(" timeStepSize='0.5'", "")), step);
    for absurd in ["0", "-1", "nan", "inf", "fast"] {
        assert_eq!(why(&TWO_CARS.replace("0.5", absurd)), step, "{absurd}");
    }
    let empty = why(&TWO_CARS.replace("<length>4.5", "<length>0"));
    assert!(
        empty.starts_with("no road user moves in it (the first problem is obstacle 7 (line 2): its first")
    );
    assert!(empty.ends_with("; choose a recording with trajectories"));
    assert!(why(&TWO_CARS.replace("31", "\n&x;")).starts_with("line 8: not well-formed XML (the entity &x;"));
}

/// Pseudo-random numbers: a linear congruential generator with Knuth's constants.
struct Dice(u64);

impl Dice {
    /// A number below `sides`.
    fn roll(&mut self, sides: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as usize) % sides
    }
}

#[test]
fn ten_thousand_mutated_files_never_panic() {
    const SCRAP: [&str; 20] = [
        "",
        "<",
        ">",
        "/>",
        "&",
        "&#65;",
        "<!--",
        "<![CDATA[",
        "</state>",
        "<state>",
        "<exact>",
        "-",
        "NaN",
        "inf",
        "1e308",
        "1e-308",
        "7",
        "0",
        ".",
        "\u{feff}",
    ];
    let mut dice = Dice(1);
    let mut read_nevertheless = 0;
    for _ in 0..10_000 {
        let mut bytes = TWO_CARS.as_bytes().to_vec();
        for _ in 0..=dice.roll(4) {
            let from = dice.roll(bytes.len());
            if bytes[from].is_ascii_digit() {
                bytes[from] = b"-.0e9x"[dice.roll(6)];
            } else if dice.roll(2) == 0 {
                let to = (from + dice.roll(8)).min(bytes.len());
                bytes.splice(from..to, SCRAP[dice.roll(SCRAP.len())].bytes());
            }
        }
        if let Ok((recording, _)) = commonroad::read(&bytes) {
            read_nevertheless += 1;
            let states = || recording.tracks.iter().flat_map(|it| &it.states);
            assert!(states().all(|it| [it.x, it.y, it.speed, it.heading].iter().all(|it| it.is_finite())));
            assert!(recording.tracks.iter().all(|it| it.states.is_sorted_by(|a, b| a.frame < b.frame)));
        }
    }
    // Some mutations only touch numbers and names.
    assert!((1_000..9_000).contains(&read_nevertheless), "{read_nevertheless}");
}

#[test]
fn cut_files_are_refused_but_never_panic() {
    for end in 0..TWO_CARS.len() - 1 {
        assert!(commonroad::read(&TWO_CARS.as_bytes()[..end]).is_err(), "{end}");
    }
}

/// Tracks, states, the last frame, and sums over all states of x [m], y [m] and speed [m/s], of lengths [m].
type Sums = (usize, usize, i64, [f64; 4]);

#[test]
fn windows_of_ngsim_agree_with_the_reference_library() {
    let expected: [(&str, Sums); 17] = [
        ("USA_Lanker-1_1_T-1", (24, 938, 40, [-1753.701, -2481.602, 6098.784, 114.818])),
        ("USA_Lanker-1_3_T-1", (36, 1357, 40, [3311.185, -22071.074, 8152.889, 175.992])),
        ("USA_Lanker-1_4_T-1", (34, 540, 15, [-5489.294, -866.398, 808.090, 164.714])),
        ("USA_Peach-3_1_T-1", (5, 255, 50, [-3919.270, 116.350, 2558.312, 23.500])),
        ("USA_Peach-4_8_T-1", (9, 368, 60, [-521.080, 9104.156, 2298.293, 43.830])),
        ("USA_US101-11_4_T-1", (32, 1558, 72, [68532.846, -58748.242, 26233.912, 152.095])),
        ("USA_US101-15_1_T-1", (37, 2273, 80, [91750.965, -63287.827, 17270.658, 194.005])),
        ("USA_US101-17_1_T-1", (39, 2492, 80, [174523.611, -125976.019, 30361.367, 195.072])),
        ("USA_US101-1_1_T-1", (2, 122, 60, [5153.789, 231.036, 1948.586, 10.668])),
        ("USA_US101-1_2_T-1", (2, 122, 60, [5153.789, 231.036, 1948.586, 10.668])),
        ("USA_US101-26_1_T-1", (27, 1591, 80, [73181.907, -43585.530, 21209.962, 134.417])),
        ("USA_US101-3_1_T-1", (34, 1985, 80, [70539.991, -77498.458, 28337.265, 169.926])),
        ("USA_US101-3_3_T-1", (12, 384, 31, [4661.895, -7317.556, 3622.997, 63.094])),
        ("USA_US101-4_1_T-1", (22, 1271, 100, [16217.700, -22433.887, 9817.030, 117.653])),
        ("USA_US101-5_1_T-1", (25, 1619, 100, [33970.068, -47363.779, 12939.104, 138.989])),
        ("USA_US101-6_1_T-1", (29, 1750, 80, [103482.860, -95721.732, 30308.647, 148.438])),
        ("USA_US101-8_1_T-1", (27, 1427, 75, [73273.579, -77686.800, 17489.574, 133.350])),
    ];
    for (name, expected) in expected {
        let Some(path) = data(&format!("recordings/ngsim_commonroad/{name}.xml")) else { continue };
        let (recording, problems) = commonroad::read(&fs::read(&path).unwrap()).expect("it is sound");
        assert_eq!((recording.step, &problems[..]), (0.1, &[][..]), "{name}");
        let states: Vec<&State> = recording.tracks.iter().flat_map(|it| &it.states).collect();
        let sum = |of: fn(&State) -> f64| states.iter().map(|it| of(it)).sum::<f64>();
        let length = recording.tracks.iter().map(|it| it.length).sum::<f64>();
        let last = states.iter().map(|it| it.frame).max().unwrap();
        assert_eq!(
            (recording.tracks.len(), states.len(), last),
            (expected.0, expected.1, expected.2),
            "{name}"
        );
        let sums = [sum(|it| it.x), sum(|it| it.y), sum(|it| it.speed), length];
        for (found, expected) in sums.iter().zip(expected.3) {
            assert!((found - expected).abs() < 1e-3, "{name}: {found} {expected}");
        }
        assert!(recording.tracks.iter().all(|it| it.class == RoadUser::Car), "{name}");
    }
}

#[test]
fn cars_of_a_window_drive_on_its_map() {
    let Some(path) = data("recordings/ngsim_commonroad/USA_US101-3_1_T-1.xml") else { return };
    let bytes = fs::read(path).expect("it can be read");
    let map = laneweave_maps::commonroad::read(&bytes, &ReadOptions::default()).unwrap();
    let (recording, _) = commonroad::read(&bytes).unwrap();
    let is_near = |state: &State| {
        let centres = map
            .network
            .lanelets
            .iter()
            .flat_map(|it| (0..=it.length() as usize).map(|station| it.centre.at(station as f64)));
        centres.map(|it| (it.x - state.x).hypot(it.y - state.y)).fold(f64::INFINITY, f64::min) < 3.0
    };
    let firsts: Vec<&State> = recording.tracks.iter().map(|it| &it.states[0]).collect();
    assert_eq!(firsts.iter().filter(|it| is_near(it)).count(), firsts.len());
}
