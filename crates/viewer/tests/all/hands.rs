//! What is done by hand and saved gives the same bits when it is run again.

use std::path::{Path, PathBuf};

use laneweave::scenario::Origin;
use laneweave::{Class, LightState, Parameter, Simulation};
use laneweave_test_data::map;
use laneweave_viewer::source::{DriveSide, Wants};
use laneweave_viewer::{Hand, Live, Seen, Snapshot, Source};

/// A folder of this test alone.
fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("laneweave-hands-{}-{name}", std::process::id()));
    let _ = std::fs::remove_dir_all(&folder);
    folder
}

fn live(name: &str, dir: &Path) -> Live {
    let (scenario, origin) = Origin::open(&map(name)).expect("a map");
    Live::new(&scenario, &origin, dir.to_owned()).expect("a simulation")
}

fn steps(live: &mut Live, count: u32) {
    (0..count).for_each(|_| live.step(&mut Vec::new()).expect("a step"));
}

/// The hash at the end of the saved scenario.
fn run_again(live: &Live) -> u64 {
    let saved = live.save().expect("a scenario");
    let mut again = Simulation::from_file(&saved.scenario).expect("the saved scenario");
    assert!((again.end_s() - live.time_s()).abs() < 1e-6);
    again.run(again.end_s()).expect("a run");
    again.state_hash()
}

#[test]
fn a_town_changed_by_hand_is_the_same_when_it_is_run_again() {
    let dir = folder("town");
    let mut untouched = live("town.osm", &dir);
    let mut live = live("town.osm", &dir);
    steps(&mut untouched, 900);
    steps(&mut live, 200);
    let style = live.hello().styles[0].name.clone();
    let set = |value| Hand::SetParameter { style: style.clone(), parameter: Parameter::SpeedFactor, value };
    live.hand(&set(0.6)).expect("a slower style");
    // The slider moves on before the next step.
    live.hand(&set(0.7)).expect("a slower style");
    let origin = live.hello().demand[0].origin.clone();
    live.hand(&Hand::SetDemand { origin, vehicles_per_hour: 1500.0 }).expect("more demand");
    live.hand(&Hand::SetShare { style: style.clone(), weight: 30.0 }).expect("more of them");
    steps(&mut live, 300);
    let light = scene(&live)["lights"][0]["id"].as_str().expect("a light").to_owned();
    live.hand(&Hand::SetLight { light: light.clone(), shows: Some(LightState::Red) }).expect("a red light");
    live.hand(&Hand::SetOffset { light, offset_s: 20.0 }).expect("another offset");
    let [x, y] = beside_an_entrance(&live);
    let put = live.hand(&Hand::Put { x, y, class: Class::Truck }).expect("a new vehicle");
    let vehicle = put.expect("its id").to_string();
    steps(&mut live, 100);
    live.hand(&Hand::Drive { vehicle: vehicle.clone(), speed_kmh: Some(20.0), side: None }).expect("a drive");
    steps(&mut live, 100);
    live.undo().expect("the drive is taken back");
    steps(&mut live, 100);
    live.hand(&Hand::Drive { vehicle, speed_kmh: None, side: None }).expect("its driver drives it");
    steps(&mut live, 100);
    assert_ne!(live.state_hash(), untouched.state_hash());
    assert_eq!(run_again(&live), live.state_hash());
    // A second one goes beside the first.
    assert_eq!(live.save().expect("another").folder, dir.join("2"));
    let _ = std::fs::remove_dir_all(dir);
}

#[test]
fn acts_on_one_thing_that_follow_each_other_are_one_and_are_taken_back_as_one() {
    let dir = folder("undo");
    let mut live = live("ramps.osm", &dir);
    let value = |live: &Live| {
        let style = live.hello().styles.swap_remove(0);
        let found = style.parameters.into_iter().find(|it| it.key == Parameter::SpeedFactor.key());
        found.expect("a number").value
    };
    let style = live.hello().styles[0].name.clone();
    let before = value(&live);
    for value in [0.9, 0.8, 0.7] {
        let style = style.clone();
        live.hand(&Hand::SetParameter { style, parameter: Parameter::SpeedFactor, value }).expect("a number");
        steps(&mut live, 2);
    }
    assert_eq!((live.hands().done.len(), value(&live)), (1, 0.7));
    let text = &live.hands().done[0].text;
    assert!(text.contains(" from 1") && text.ends_with(" to 0.7"), "{text}");
    live.undo().expect("an act");
    steps(&mut live, 1);
    assert!((value(&live) - before).abs() < 1e-9);
    assert!(live.undo().is_err());
    // Each is taken back to what it was before, whatever has been done in between.
    let origin = live.hello().demand[0].origin.clone();
    let demand = |live: &Live| live.hello().demand[0].vehicles_per_hour;
    let (planned, set) =
        (demand(&live), |it| Hand::SetDemand { origin: origin.clone(), vehicles_per_hour: it });
    live.hand(&set(500.0)).expect("a demand");
    steps(&mut live, 20);
    live.hand(&Hand::SetShare { style: style.clone(), weight: 3.0 }).expect("a share");
    live.hand(&set(700.0)).expect("a demand");
    steps(&mut live, 20);
    live.undo().expect("an act");
    assert_eq!(demand(&live), 500.0);
    steps(&mut live, 1);
    live.undo().expect("an act");
    live.undo().expect("an act");
    assert_eq!(demand(&live), planned);
    let gone = Hand::Remove { vehicle: "999".into() };
    assert!(live.hand(&gone).expect_err("no vehicle").what.contains("999"));
}

#[test]
fn a_twin_goes_on_without_what_is_done_by_hand() {
    let dir = folder("twin");
    let [mut live, mut untouched] = ["ramps.osm"; 2].map(|it| live(it, &dir));
    steps(&mut live, 600);
    steps(&mut untouched, 1200);
    live.twin(true).expect("a twin");
    let seen = |live: &Live| {
        let mut snapshot = Snapshot::default();
        live.see(&Wants::default(), &mut snapshot);
        snapshot.vehicles
    };
    let own = |all: &[Seen]| all.iter().filter(|it| it.id >= 0).copied().collect::<Vec<_>>();
    let ghosts =
        |all: &[Seen]| all.iter().filter(|it| it.id < 0).map(|it| (-1 - it.id, it.at)).collect::<Vec<_>>();
    let places = |all: &[Seen]| all.iter().map(|it| (it.id, it.at)).collect::<Vec<_>>();
    // At first both are the same.
    let begin = seen(&live);
    assert!(begin.len() > 40 && ghosts(&begin) == places(&own(&begin)));
    assert!(own(&begin).iter().all(|it| it.values[3] == 1));
    for style in live.hello().styles {
        let (style, parameter, value) = (style.name, Parameter::SpeedFactor, 0.5);
        live.hand(&Hand::SetParameter { style, parameter, value }).expect("slower drivers");
    }
    steps(&mut live, 600);
    let all = seen(&live);
    assert_eq!(ghosts(&all), places(&seen(&untouched)), "the twin is the untouched traffic");
    assert!(own(&all).iter().any(|it| it.values[3] > 100));
    live.twin(false).expect("no twin");
    assert!(ghosts(&seen(&live)).is_empty());
}

/// What stands still, as a page gets it.
fn scene(live: &Live) -> serde_json::Value {
    serde_json::to_value(live.scene()).expect("JSON")
}

/// A place on the first lane of an entrance, a little into the map [m].
fn beside_an_entrance(live: &Live) -> [f64; 2] {
    /// How far in [m].
    const IN: f64 = 12.0;
    let scene = scene(live);
    let number = |it: &serde_json::Value| it.as_f64().expect("a number");
    let gate = &scene["entrances"][0];
    let heading = number(&gate["heading"]);
    let at = |axis: usize| number(&scene["origin"][axis]) + number(&gate["at"][axis]);
    [at(0) + IN * heading.cos(), at(1) + IN * heading.sin()]
}

#[test]
fn what_is_set_is_known_as_it_is_now_whoever_set_it() {
    let dir = folder("set");
    let mut live = live("town.osm", &dir);
    let light = scene(&live)["lights"][0]["id"].as_str().expect("a light").to_owned();
    let offset = |offset_s| Hand::SetOffset { light: light.clone(), offset_s };
    let red = |shows| Hand::SetLight { light: light.clone(), shows };
    let planned = scene(&live)["lights"][0]["plan"]["offset_s"].as_f64().expect("the offset of its plan");
    assert!(live.hands().set.is_empty() && live.news_of_hands().is_none());
    live.hand(&offset(20.0)).expect("another offset");
    live.hand(&red(Some(LightState::Red))).expect("a red light");
    assert!(live.news_of_hands().is_some() && live.news_of_hands().is_none());
    // Before the step and after it.
    for _ in 0..2 {
        let set = live.hands().set;
        assert!(set.len() == 2 && set.contains(&offset(20.0)) && set.contains(&red(Some(LightState::Red))));
        steps(&mut live, 1);
    }
    live.undo().expect("an act");
    live.undo().expect("an act");
    let set = live.hands().set;
    assert!(set.len() == 2 && set.contains(&offset(planned)) && set.contains(&red(None)), "{set:?}");
    // A scenario that was saved does the same by itself.
    live.hand(&offset(30.0)).expect("another offset");
    steps(&mut live, 2);
    let saved = live.save().expect("a scenario").scenario;
    let (scenario, origin) = Origin::open(&saved).expect("the saved scenario");
    let mut again = Live::new(&scenario, &origin, dir.clone()).expect("a simulation");
    steps(&mut again, 4);
    assert!(again.news_of_hands().is_some_and(|it| it.set.contains(&offset(30.0))));
    assert!(again.hands().set.contains(&offset(30.0)));
    let _ = std::fs::remove_dir_all(dir);
}

#[test]
fn what_was_taken_off_the_road_does_not_keep_the_rest_from_being_taken_back() {
    let dir = folder("removed");
    let mut live = live("ramps.osm", &dir);
    let style = live.hello().styles[0].name.clone();
    live.hand(&Hand::SetShare { style, weight: 3.0 }).expect("a share");
    let [x, y] = beside_an_entrance(&live);
    let vehicle = live.hand(&Hand::Put { x, y, class: Class::Car }).expect("a car").expect("its id");
    live.hand(&Hand::Remove { vehicle: vehicle.to_string() }).expect("it leaves");
    // It does nothing else before it has gone.
    let drive = Hand::Drive { vehicle: vehicle.to_string(), speed_kmh: Some(20.0), side: None };
    assert!(live.hand(&drive).expect_err("it leaves").what.contains("off the road"));
    steps(&mut live, 1);
    assert!(live.find(i64::from(vehicle)).is_none());
    live.undo().expect("the share");
    assert_eq!(live.hands().done.iter().map(|it| it.is_undone).collect::<Vec<_>>(), [true, false, false]);
    assert!(live.undo().expect_err("it has gone").what.contains("taken off the road"));
    let _ = std::fs::remove_dir_all(dir);
}

#[test]
fn a_car_that_is_put_and_taken_back_while_time_stands_was_never_there() {
    let dir = folder("stands");
    let [mut live, mut untouched] = ["ramps.osm"; 2].map(|it| live(it, &dir));
    steps(&mut live, 300);
    steps(&mut untouched, 301);
    let [x, y] = beside_an_entrance(&live);
    let vehicle = live.hand(&Hand::Put { x, y, class: Class::Car }).expect("a car").expect("its id");
    assert!(live.waits());
    live.undo().expect("the car");
    steps(&mut live, 1);
    assert!(!live.waits() && live.find(i64::from(vehicle)).is_none());
    assert!(live.hands().done[0].is_undone);
    assert_eq!(live.state_hash(), untouched.state_hash());
    assert_eq!(run_again(&live), live.state_hash());
    let _ = std::fs::remove_dir_all(dir);
}

#[test]
fn a_lane_change_that_was_asked_for_goes_on_at_another_speed() {
    let dir = folder("speeds");
    let mut live = live("motorway_3_lanes.osm", &dir);
    let [x, y] = beside_an_entrance(&live);
    let vehicle = live.hand(&Hand::Put { x, y, class: Class::Car }).expect("a car").expect("its id");
    let drive =
        |speed_kmh, side| Hand::Drive { vehicle: vehicle.to_string(), speed_kmh: Some(speed_kmh), side };
    steps(&mut live, 1);
    let begin = live.find(i64::from(vehicle)).expect("it is there");
    live.hand(&drive(60.0, Some(DriveSide::Left))).expect("to the left");
    live.hand(&drive(65.0, None)).expect("faster");
    steps(&mut live, 20);
    live.hand(&drive(70.0, None)).expect("faster still");
    steps(&mut live, 150);
    let end = live.find(i64::from(vehicle)).expect("it is there");
    assert!((end[1] - begin[1]).abs() > 3.0, "{begin:?} {end:?}");
    // Who takes back the speed does not change lanes once more.
    live.undo().expect("the speed");
    steps(&mut live, 150);
    let later = live.find(i64::from(vehicle)).expect("it is there");
    assert!((later[1] - end[1]).abs() < 0.5, "{end:?} {later:?}");
    let _ = std::fs::remove_dir_all(dir);
}
