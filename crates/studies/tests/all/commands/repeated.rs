//! Runs that are repeated from their table of commands.

use std::fs;
use std::num::NonZero;
use std::path::PathBuf;

use laneweave::record::Record;
use laneweave::run::{Resumed, Run, kept, resume};
use laneweave::scenario::TableFormat;
use laneweave::scenario::{Origin, Scenario};
use laneweave::{Class, Control, Lateral, Longitudinal, NewVehicle, Simulation};
use laneweave_studies::branch::{Setting, Twins};

use super::runs::{assert_same_tables, folder, run, scenario, simulation, tables};
use super::user::User;

/// A run of the town in which a user does very much, and the folder of its results.
fn busy(name: &str, duration_s: f64) -> (Scenario, PathBuf, User, String) {
    let mut scenario = scenario("town.osm", 1500.0, duration_s);
    scenario.run.warmup_s = 20.0;
    let dir = folder(name);
    let mut user = User::new();
    let ended = simulation(&scenario).run_to_results_with(&dir, |it| user.act(it));
    let summary = ended.expect("it runs");
    (scenario, dir, user, summary.state_hash)
}

#[test]
fn ten_thousand_commands_are_repeated_bit_for_bit_on_any_number_of_threads() {
    let (mut scenario, recorded, user, hash) = busy("recorded", 1000.0);
    let rows = fs::read_to_string(recorded.join("commands.csv")).expect("it is there").lines().count() - 1;
    assert_eq!(rows as u32, user.obeyed.iter().sum::<u32>());
    assert!(rows >= 10_000 && user.obeyed.iter().all(|it| *it > 300), "{:?}", user.obeyed);
    scenario.commands = Some(recorded.join("commands.csv"));
    for threads in [1, 2, 4] {
        scenario.run.threads = NonZero::new(threads);
        let again = folder(&format!("again-{threads}"));
        let summary = run(&scenario, &again);
        assert_eq!((summary.state_hash, summary.commands_refused), (hash.clone(), 0), "{threads} threads");
        assert_same_tables(&recorded, &again);
    }
}

#[test]
fn a_table_in_parquet_says_the_same() {
    let (mut scenario, recorded, _, hash) = busy("csv", 60.0);
    scenario.commands = Some(recorded.join("commands.csv"));
    scenario.output.format = TableFormat::Parquet;
    let parquet = folder("parquet");
    assert_eq!(run(&scenario, &parquet).state_hash, hash);
    scenario.commands = Some(parquet.join("commands.parquet"));
    scenario.output.format = TableFormat::Csv;
    let again = folder("csv-again");
    assert_eq!(run(&scenario, &again).state_hash, hash);
    assert_same_tables(&recorded, &again);
}

#[test]
fn with_another_seed_commands_find_the_inserted_vehicles_and_some_are_refused() {
    let (mut scenario, recorded, ..) = busy("seed-1", 120.0);
    scenario.commands = Some(recorded.join("commands.csv"));
    scenario.run.seed = 2;
    scenario.output.checkpoint_s = 10.0;
    let whole = folder("whole");
    let summary = run(&scenario, &whole);
    // Vehicles of the demand have other ids and places now, so that some commands are not possible.
    assert!(summary.commands_refused > 50 && summary.inserted > 30, "{summary:?}");

    // Stopped and resumed, it knows which vehicles it has inserted.
    let stopped = folder("stopped");
    scenario.output.dir = stopped.clone();
    let begun = Run::begin(&scenario, &Origin::default(), "a test").expect("it begins");
    let ended = begun.complete(|simulation| simulation.time_s() < 77.0).expect("it is stopped");
    assert!(ended.summary.interrupted);
    let (kept, origin) = kept(&stopped).expect("it is kept");
    let Resumed::Run(resumed) = resume(&kept, &origin).expect("it is resumed") else {
        panic!("it is not complete");
    };
    let ended = resumed.complete(|_| true).expect("it ends");
    assert_eq!(ended.summary.state_hash, summary.state_hash);
    assert_eq!(ended.summary.commands_refused, summary.commands_refused);
    assert_eq!(ended.warnings.len(), 4, "{:?}", ended.warnings);
    assert!(ended.warnings[0].contains("commands.csv, row ") && ended.warnings[0].contains(" s): "));
    assert_same_tables(&whole, &stopped);
}

#[test]
fn a_saved_simulation_goes_on_with_its_commands() {
    let (mut scenario, recorded, ..) = busy("saved", 60.0);
    scenario.commands = Some(recorded.join("commands.csv"));
    scenario.run.seed = 3;
    let mut whole = simulation(&scenario);
    whole.run(40.0).expect("it runs");
    let saved = whole.save().expect("it can be saved");
    let mut restored = simulation(&scenario);
    restored.restore(&saved).expect("it is of the same scenario");
    whole.run(80.0).expect("it runs");
    restored.run(80.0).expect("it runs");
    assert_eq!(whole.state_hash(), restored.state_hash());
    let damaged: Vec<u8> = saved.iter().map(|it| it ^ 1).collect();
    assert!(restored.restore(&damaged).is_err());
}

/// A truck that blocks a lane of a motorway from 20 s on, and its results.
fn blocked(dir: &str) -> PathBuf {
    let dir = folder(dir);
    let mut truck = None;
    let act = |it: &mut Simulation| -> Result<(), laneweave::Fault> {
        if it.clock().step == 200 {
            let (class, style) = (Class::Truck, "conservative".to_owned());
            let vehicle = NewVehicle {
                lanelet: 5.into(),
                position_m: 60.0,
                speed_mps: 20.0,
                class,
                style,
                destination: None,
            };
            let id = it.insert(vehicle)?;
            let (longitudinal, lateral) = (Longitudinal::Speed(0.0), Lateral::Keep);
            it.control(id, Control::Drive { longitudinal, lateral })?;
            truck = Some(id);
        }
        Ok(())
    };
    let scenario = scenario("motorway_2_lanes.osm", 300.0, 90.0);
    simulation(&scenario).run_to_results_with(&dir, act).expect("it runs");
    assert!(truck.is_some());
    dir
}

#[test]
fn a_run_of_a_program_is_repeated_from_its_table_and_has_twins() {
    let dir = blocked("program");
    let record = Record::open(&dir).expect("it is a run");
    let setting = |text: &str| text.parse::<Setting>().expect("a setting");
    let mut same = Twins::part(&record, 40.0, &[]).expect("it is repeated");
    assert!(same.drive().are_none());
    assert_eq!(format!("{:016x}", same.base.state_hash()), record.end.state_hash);

    // Without the commands from 10 s on there is no truck.
    let mut without = Twins::part(&record, 10.0, &[setting("commands=none")]).expect("it is repeated");
    let differences = without.drive();
    assert_eq!(format!("{:016x}", without.base.state_hash()), record.end.state_hash);
    assert!(differences.vehicles.values().any(|it| it.class == "truck" && it.since_s == 20.1));
    // Nobody else differs before, and the same drivers come.
    assert!(differences.vehicles.values().all(|it| it.since_s >= 20.1));
    let [base, branch] = [&without.base, &without.branch];
    let arrived = |it: &Simulation| it.counts().entered - it.counts().inserted + it.waiting_to_enter() as u64;
    assert_eq!(arrived(base), arrived(branch));
    let driver = |it: laneweave::sim::Vehicle| (it.id(), it.driver.class, it.driver.parameters);
    let both: Vec<_> = base.views().filter_map(|it| Some((it, branch.view(it.id())?))).collect();
    assert!(both.len() > 3 && both.into_iter().all(|(one, other)| driver(one) == driver(other)));

    // A file of other commands may name the vehicles of the run: here the truck drives on at 50 s.
    let table = fs::read_to_string(dir.join("commands.csv")).expect("it is there");
    let id: u32 = table.lines().nth(1).and_then(|it| it.split(',').nth(2)?.parse().ok()).expect("an id");
    assert_eq!(id, laneweave::sim::FIRST_INSERTED);
    let file = folder("drives-on").join("other.csv");
    let go = r#"{""drive"":{""longitudinal"":""driver"",""lateral"":""driver""}}"#;
    fs::write(&file, format!("time_s,act,values\n50,control,\"[{id},{go}]\"\n")).expect("it is written");
    let setting = setting(&format!("commands={}", file.display()));
    let mut other = Twins::part(&record, 40.0, &[setting]).expect("it is repeated");
    let differences = other.drive();
    assert!(other.warnings().is_empty(), "{:?}", other.warnings());
    let first = differences.vehicles.values().map(|it| it.since_s).fold(f64::INFINITY, f64::min);
    assert!(differences.vehicles[&id].since_s == first && (50.0..50.2).contains(&first), "{first}");
}

#[test]
fn a_run_of_a_program_is_not_resumed_without_it() {
    let dir = blocked("alone");
    fs::remove_file(dir.join("summary.json")).expect("it is there");
    let (scenario, origin) = kept(&dir).expect("it is kept");
    let told = resume(&scenario, &origin).err().expect("it is refused").to_string();
    assert!(told.ends_with("only that program can give them again; run the program again"), "{told}");
}

#[test]
fn commands_may_be_given_before_a_run_begins_and_its_time_stays_its_own() {
    let scenario = scenario("motorway_2_lanes.osm", 300.0, 10.0);
    let mut begun = simulation(&scenario);
    begun.set_demand(1, 0.0).expect("it is an entrance");
    let dir = folder("before");
    begun.run_to_results(&dir).expect("it runs");
    assert!(tables(&dir).iter().any(|(_, text)| text.contains("\n0.0,origin,1,set_demand,")));

    let stepped = |it: &mut Simulation| -> Result<(), laneweave::Fault> {
        it.step();
        Ok(())
    };
    let told =
        simulation(&scenario).run_to_results_with(folder("stepped"), stepped).expect_err("it is refused");
    assert_eq!(told.remedy, "give commands only: the run simulates the steps");
}

#[test]
fn a_run_without_commands_has_an_empty_table_and_does_not_replace_its_own_commands() {
    let mut scenario = scenario("motorway_2_lanes.osm", 300.0, 10.0);
    let dir = folder("none");
    run(&scenario, &dir);
    let table = dir.join("commands.csv");
    assert_eq!(fs::read_to_string(&table).expect("it is there"), "time_s,target,id,act,values\n");
    scenario.commands = Some(table.clone());
    let told = simulation(&scenario).run_to_results(&dir).expect_err("it is refused").to_string();
    assert!(told.contains("would replace these commands; choose another results folder"), "{told}");
    assert!(table.exists() && Simulation::from_scenario(&scenario, &Origin::default()).is_ok());
}
