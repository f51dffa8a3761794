//! Twins: with nothing changed they stay the same to the last bit; with one thing changed they differ where it
//! matters, not before.

use std::path::Path;

use laneweave::Simulation;
use laneweave::record::{End, Record, fingerprint};
use laneweave::scenario::{Origin, Scenario};
use laneweave_studies::branch::{Setting, Twins};

/// The end of the runs [s].
const END: f64 = 240.0;

/// A run on a built-in map, with guidance, with the usual drivers.
fn record(map: &str, demand: f64) -> Record {
    let mut scenario = Scenario::of_map(laneweave_test_data::map(map));
    scenario.demand.vehicles_per_hour = Some(demand);
    scenario.guidance.interval_s = 60.0;
    scenario.run.duration_s = END;
    let origin = Origin::default();
    let fingerprint = fingerprint(&scenario, &origin).expect("the map is there");
    let state_hash = format!("{:016x}", alone(&scenario, &origin, END).state_hash());
    let end = End { state_hash, fingerprint, duration_s: END, warmup_s: 0.0 };
    Record { scenario, origin, end }
}

/// The run without a twin up to `until` [s].
fn alone(scenario: &Scenario, origin: &Origin, until: f64) -> Simulation {
    let mut simulation = Simulation::from_scenario(scenario, origin).expect("the map is sound");
    simulation.run(until).expect("it is a time to come");
    simulation
}

/// The vehicles that have arrived, whether they have entered or wait.
fn arrived(it: &Simulation) -> u64 {
    it.counts().entered + it.waiting_to_enter() as u64
}

fn setting(text: &str) -> Setting {
    text.parse().expect("a setting")
}

#[test]
fn with_nothing_changed_the_rest_of_the_run_is_the_same_to_the_last_bit() {
    for (map, demand) in [("ramps.osm", 4000.0), ("town.osm", 4000.0), ("grid.osm", 2500.0)] {
        let record = record(map, demand);
        for at in [0.0, 100.3] {
            for settings in [vec![], vec![setting("conservative.speed.weight=0.44")]] {
                let mut twins = Twins::part(&record, at, &settings).expect("it can be repeated");
                let differences = twins.drive();
                assert!(differences.are_none(), "{map} at {at}: {differences:?}");
                let ends = [&twins.base, &twins.branch].map(|it| format!("{:016x}", it.state_hash()));
                assert_eq!(
                    ends,
                    [record.end.state_hash.clone(), record.end.state_hash.clone()],
                    "{map} at {at}"
                );
            }
        }
    }
}

#[test]
fn with_one_weight_changed_nothing_differs_before_and_something_after() {
    const AT: f64 = 120.0;
    let record = record("ramps.osm", 4000.0);
    let mut twins = Twins::part(&record, AT, &[setting("style.speed.weight=2")]).expect("it can be repeated");
    let before = alone(&record.scenario, &record.origin, AT);
    for twin in [&twins.base, &twins.branch] {
        assert_eq!(twin.state_hash(), before.state_hash());
        assert_eq!(twin.counts(), before.counts());
    }
    let differences = twins.drive();
    assert_eq!(
        format!("{:016x}", twins.base.state_hash()),
        record.end.state_hash,
        "the base goes on as it did"
    );
    assert_ne!(twins.base.state_hash(), twins.branch.state_hash());
    let first = differences.vehicles.values().map(|it| it.since_s).fold(f64::INFINITY, f64::min);
    assert!((AT..AT + 20.0).contains(&first), "{first}");
    let last = differences.instants.last().expect("there is one");
    // With a larger weight of speed, drivers change lanes more often.
    assert!(last.lane_changes[1] > last.lane_changes[0] + 10, "{last:?}");
    assert_eq!(arrived(&twins.base), arrived(&twins.branch), "the same come at the same times");
}

#[test]
fn only_the_drivers_of_a_style_change_where_one_is_named() {
    let record = record("ramps.osm", 4000.0);
    let twins =
        Twins::part(&record, 60.0, &[setting("aggressive.follow.jam_gap=4")]).expect("it can be repeated");
    let pairs = twins.base.driver_parameters().iter().zip(twins.branch.driver_parameters());
    for (base, branch) in pairs {
        assert_eq!(base.speed_factor, branch.speed_factor, "what is drawn stays");
        assert_eq!(base == branch, base.name == "conservative", "{}", base.name);
    }
}

#[test]
fn what_does_not_fit_is_refused_with_a_remedy() {
    let record = record("motorway_2_lanes.osm", 1000.0);
    let refused = |at, text: &str| {
        Twins::part(&record, at, &[setting(text)]).err().map(|it| it.to_string()).expect("it is refused")
    };
    assert!(refused(10.0, "agressive.speed.weight=2").contains("did you mean \"aggressive\"?"));
    assert!(refused(10.0, "style.sped.weight=2").contains("unknown key \"sped\"; did you mean \"speed\"?"));
    assert!(refused(10.0, "style.safety.min_gap=-1").contains("choose 0.1 to 50 m"));
    assert!(refused(END, "style.speed.weight=2").contains("choose a time before its end"));
    assert!(Path::new(&record.scenario.map).exists());
}
