//! Obstacles of a scenario.

use std::fs;

use laneweave::record::{End, Record, fingerprint};
use laneweave::run::Run;
use laneweave::scenario::{External, Obstacle, Origin, Scenario};
use laneweave::{Class, Simulation};
use laneweave_studies::branch::Twins;
use laneweave_test_data::map;

use super::runs::{assert_same_tables, folder, refused, run, scenario, simulation};

/// Something on the right lane of a motorway between 10 and 40 s.
fn load() -> Obstacle {
    let (from_s, until_s) = (10.0, Some(40.0));
    Obstacle { lanelet: 9.into(), position_m: 60.0, length_m: 2.0, width_m: 1.5, from_s, until_s }
}

fn with(obstacle: Vec<Obstacle>) -> Scenario {
    let mut scenario = scenario("motorway_2_lanes.osm", 1500.0, 60.0);
    scenario.obstacle = obstacle;
    scenario
}

#[test]
fn it_stands_there_between_its_times_and_is_no_vehicle() {
    let text = format!(
        "map = {:?}\n[run]\nduration_s = 60\n[demand]\nvehicles_per_hour = 100\n[[obstacle]]\nlanelet = 9\nposition_m = 60\nlength_m = 2\nwidth_m = 1.5\n\
         from_s = 10\nuntil_s = 40\n[[obstacle]]\nlanelet = 10\nposition_m = 30\nfrom_s = 50\n",
        map("motorway_2_lanes.osm")
    );
    let path = folder("obstacles").join("own.toml");
    fs::write(&path, text).expect("it is written");
    let mut own = Simulation::from_file(&path).expect("it is sound");
    let usual = Obstacle { lanelet: 10.into(), position_m: 30.0, from_s: 50.0, until_s: None, ..load() };
    assert_eq!(own.scenario().obstacle, [load(), Obstacle { length_m: 4.5, width_m: 1.8, ..usual }]);
    let mut lengths = Vec::new();
    for until_s in 1..=6 {
        own.run(9.0 * f64::from(until_s)).expect("it runs");
        lengths.push(own.obstacles().map(|it| it.1.length).collect::<Vec<_>>());
        assert_eq!(own.counts().inserted, 0);
    }
    let [none, first, second] = [vec![], vec![2.0], vec![4.5]];
    assert_eq!(lengths, [none.clone(), first.clone(), first.clone(), first, none, second]);
}

#[test]
fn its_run_is_repeated_from_its_table_and_goes_on_in_a_twin_and_from_a_saved_state() {
    let mut own = with(vec![load()]);
    let dir = folder("obstacle");
    let summary = run(&own, &dir);
    own.commands = Some(dir.join("commands.csv"));
    let repeated = folder("obstacle-again");
    assert_eq!(run(&own, &repeated).state_hash, summary.state_hash);
    assert_same_tables(&dir, &repeated);
    own.commands = None;
    let (origin, mut alone) = (Origin::default(), simulation(&own));
    alone.run(25.0).expect("it runs");
    let saved = alone.save().expect("it can be saved");
    let told = simulation(&with(Vec::new())).restore(&saved).expect_err("it has no obstacle");
    assert!(told.what.ends_with("with other external vehicles or obstacles"), "{told}");
    let mut later = simulation(&own);
    later.restore(&saved).expect("it is the same scenario");
    alone.run(60.0).expect("it runs");
    later.run(60.0).expect("it runs");
    assert_eq!((later.obstacles().count(), later.state_hash()), (0, alone.state_hash()));
    let fingerprint = fingerprint(&own, &origin).expect("the map is there");
    let end = End { state_hash: String::new(), fingerprint, duration_s: 60.0, warmup_s: 0.0 };
    let mut twins = Twins::part(&Record { scenario: own, origin, end }, 20.0, &[]).expect("it is repeated");
    assert!(twins.drive().are_none());
    assert_eq!(twins.base.state_hash(), alone.state_hash());
}

#[test]
fn what_stands_in_the_map_stands_on_its_lanes_from_the_start() {
    let parked = |id: i64, y: f64| {
        format!(
            "<staticObstacle id='{id}'><type>parkedVehicle</type><shape><rectangle><length>4</length><width>1.8</width>\
             </rectangle></shape><initialState><position><point><x>300</x><y>{y}</y></point></position><orientation>\
             <exact>0</exact></orientation><time><exact>0</exact></time></initialState></staticObstacle>\n"
        )
    };
    let lane = |id: i64, right: f64, beside: &str| {
        let bound = |y: f64| {
            let point = |x: i32| format!("<point><x>{x}</x><y>{y}</y></point>");
            (0..=10).map(|it| point(60 * it)).collect::<String>() + "<lineMarking>dashed</lineMarking>"
        };
        let (left, right) = (bound(right + 3.5), bound(right));
        format!(
            "<lanelet id='{id}'><leftBound>{left}</leftBound><rightBound>{right}</rightBound>{beside}\
             <laneletType>urban</laneletType></lanelet>\n"
        )
    };
    let map = format!(
        "<commonRoad commonRoadVersion='2020a'>{}{}{}{}</commonRoad>",
        lane(1, 0.0, "<adjacentLeft ref='2' drivingDir='same'/>"),
        lane(2, 3.5, "<adjacentRight ref='1' drivingDir='same'/>"),
        parked(8, 1.75),
        parked(9, -2.0)
    );
    let path = folder("standing").join("map.xml");
    fs::write(&path, map).expect("it is written");
    let mut own = Scenario::of_map(path);
    own.demand.vehicles_per_hour = Some(400.0);
    own.run.duration_s = 300.0;
    let mut simulation = simulation(&own);
    simulation.run(300.0).expect("it runs");
    let places: Vec<f64> = simulation.obstacles().map(|it| it.1.pose.at.y).collect();
    assert_eq!(places, [1.75], "the other one is beside the road");
    let counters = simulation.counters();
    assert_eq!((counters.collisions, counters.overlaps, counters.stuck), (0, 0, 0));
    assert!(simulation.counts().left > 15, "{}", simulation.counts().left);
}

#[test]
fn one_that_finds_no_place_is_told_and_one_that_comes_later_is_not() {
    let later = Obstacle { from_s: 300.0, until_s: None, ..load() };
    let mut own = with(vec![load(), later, Obstacle { lanelet: 10.into(), ..load() }]);
    own.external = vec![External {
        name: None,
        time_s: 0.0,
        lanelet: 10.into(),
        position_m: 60.0,
        speed_mps: 0.0,
        class: Class::Car,
        style: "conservative".into(),
        destination: None,
        held_speed_mps: Some(0.0),
        keeps_lane: true,
    }];
    own.output.dir = folder("obstacle-late");
    let ended = Run::begin(&own, &Origin::default(), "a test").and_then(|it| it.complete(|_| true));
    assert_eq!(ended.expect("it ends").warnings, ["obstacle 3: its place was never free"]);
}

#[test]
fn what_cannot_be_is_refused_with_a_remedy() {
    let told = |change: &dyn Fn(&mut Obstacle)| {
        let mut obstacle = load();
        change(&mut obstacle);
        refused(&with(vec![obstacle])).to_string()
    };
    assert!(told(&|it| it.lanelet = 4711.into()).contains("there is no lanelet 4711; choose one"));
    assert!(told(&|it| it.position_m = 1e6).contains("m long; choose 0 to "));
    assert!(told(&|it| it.position_m = f64::NAN).contains("m long; choose 0 to "));
    assert!(told(&|it| it.length_m = 0.0).contains("a length of 0; choose 0.1 to 60 m"));
    assert!(told(&|it| it.width_m = 61.0).contains("a width of 61; choose 0.1 to 60 m"));
    assert!(told(&|it| it.from_s = -1.0).contains("a time of -1 s; choose 0 to 10000000 s"));
    assert!(told(&|it| it.until_s = Some(10.0)).contains("choose a later time"));
}
