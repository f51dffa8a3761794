//! External vehicles of a scenario.

use std::fs;

use laneweave::record::{End, Record, fingerprint};
use laneweave::run::{Resumed, Run, kept, resume};
use laneweave::scenario::{External, Origin, Scenario};
use laneweave::{Class, Control, Id, Lateral, Longitudinal, Simulation};
use laneweave_studies::branch::Twins;
use laneweave_test_data::map;

use super::runs::{assert_same_tables, folder, refused, run, scenario, simulation};

/// A car on a motorway from 20 s on, at 15 m/s.
fn lead() -> External {
    External {
        name: Some("lead".into()),
        time_s: 20.0,
        lanelet: 5.into(),
        position_m: 60.0,
        speed_mps: 15.0,
        class: Class::Car,
        style: "conservative".into(),
        destination: None,
        held_speed_mps: Some(15.0),
        keeps_lane: true,
    }
}

fn with(external: Vec<External>) -> Scenario {
    let mut scenario = scenario("motorway_2_lanes.osm", 3000.0, 60.0);
    scenario.external = external;
    scenario
}

#[test]
fn it_is_on_the_road_as_soon_as_its_place_is_free() {
    let text = format!(
        "map = {:?}\n[run]\nduration_s = 60\n[demand]\nvehicles_per_hour = 3000\n[[external]]\nname = \"lead\"\n\
         time_s = 20\nlanelet = 5\nposition_m = 60\nspeed_mps = 15\nstyle = \"conservative\"\n\
         held_speed_mps = 15\nkeeps_lane = true\n",
        map("motorway_2_lanes.osm")
    );
    let path = folder("scenario").join("own.toml");
    fs::write(&path, text).expect("it is written");
    let mut own = Simulation::from_file(&path).expect("it is sound");
    assert_eq!(own.scenario().external, [lead()]);
    own.run(20.0).expect("it runs");
    assert_eq!((own.external("lead"), own.external("other")), (None, None));
    own.run(40.0).expect("it runs");
    let id = own.external("lead").expect("it is on the road");
    let state = own.vehicle(id).expect("it is on the road");
    assert_eq!((state.speed_mps, state.is_external, state.class), (15.0, true, Class::Car));
    let (longitudinal, lateral) = (Longitudinal::Speed(15.0), Lateral::Keep);
    assert_eq!(own.control_of(id), Control::Drive { longitudinal, lateral });
    // The program takes over.
    own.control(id, Control::DRIVER).expect("it is on the road");
    own.step();
    assert_eq!(own.control_of(id), Control::DRIVER);
}

#[test]
fn its_run_is_repeated_from_its_table_and_resumed_before_and_after_it_came() {
    let mut own = with(vec![External { held_speed_mps: None, keeps_lane: false, time_s: 0.0, ..lead() }, {
        External { name: None, time_s: 30.0, ..lead() }
    }]);
    own.output.checkpoint_s = 5.0;
    let dir = folder("external");
    let summary = run(&own, &dir);
    assert_eq!(summary.inserted, 2);
    let again = Scenario { external: Vec::new(), commands: Some(dir.join("commands.csv")), ..own.clone() };
    let repeated = folder("external-again");
    assert_eq!(run(&again, &repeated).state_hash, summary.state_hash);
    assert_same_tables(&dir, &repeated);
    for (number, until_s) in [17.0, 44.0].into_iter().enumerate() {
        own.output.dir = folder(&format!("external-{number}"));
        let begun = Run::begin(&own, &Origin::default(), "a test").expect("it begins");
        begun.complete(|simulation| simulation.time_s() < until_s).expect("it is stopped");
        let (kept, origin) = kept(&own.output.dir).expect("it is kept");
        let Resumed::Run(resumed) = resume(&kept, &origin).expect("it is resumed") else {
            panic!("it is not complete");
        };
        resumed.complete(|_| true).expect("it ends");
        assert_same_tables(&dir, &own.output.dir);
    }
}

#[test]
fn it_does_not_come_twice_into_a_twin_and_is_part_of_a_saved_state() {
    let own = with(vec![External { time_s: 5.0, ..lead() }]);
    let (origin, mut alone) = (Origin::default(), simulation(&own));
    let saved = alone.save().expect("it can be saved");
    let told = simulation(&with(Vec::new())).restore(&saved).expect_err("it has no external vehicle");
    assert!(told.what.ends_with("with other external vehicles or obstacles"), "{told}");
    alone.run(60.0).expect("it runs");
    let fingerprint = fingerprint(&own, &origin).expect("the map is there");
    let end = End { state_hash: String::new(), fingerprint, duration_s: 60.0, warmup_s: 0.0 };
    let mut twins = Twins::part(&Record { scenario: own, origin, end }, 40.0, &[]).expect("it is repeated");
    assert!(twins.drive().are_none());
    assert_eq!((twins.base.state_hash(), twins.base.counts().inserted), (alone.state_hash(), 1));
}

#[test]
fn one_that_finds_no_place_is_told() {
    let late = External { time_s: 300.0, ..lead() };
    let mut own = with(vec![lead(), late]);
    own.external[1].name = None;
    own.output.dir = folder("late");
    let ended = Run::begin(&own, &Origin::default(), "a test").and_then(|it| it.complete(|_| true));
    assert_eq!(ended.expect("it ends").warnings, ["external vehicle 2: its place was never free"]);
}

#[test]
fn what_cannot_be_is_refused_with_a_remedy() {
    let told = |change: &dyn Fn(&mut External)| {
        let mut external = lead();
        change(&mut external);
        refused(&with(vec![external])).to_string()
    };
    assert!(told(&|it| it.lanelet = 4711.into()).contains("there is no lanelet 4711; choose one"));
    assert!(told(&|it| it.position_m = 1e6).contains("m long; choose 0 to "));
    assert!(told(&|it| it.style = "odd".into()).contains("odd"));
    assert!(told(&|it| it.destination = Some(Id::from(-7))).contains("-7"));
    assert!(told(&|it| it.time_s = -1.0).contains("a time of -1 s; choose 0 to 10000000 s"));
    assert!(told(&|it| it.held_speed_mps = Some(500.0)).contains("a speed of 500; choose 0 to 83"));
    assert!(refused(&with(vec![lead(), lead()])).what.contains("the same name"));
    let mut both = with(vec![lead()]);
    both.commands = Some("commands.csv".into());
    assert!(refused(&both).remedy.contains("leave out [[external]]"));
    assert!(simulation(&with(vec![lead()])).external("lead").is_none());
}
