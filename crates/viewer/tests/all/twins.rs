//! The twin of a run that has ended, whichever of its times is looked at: before the parting both are the same, and
//! after it the twin is the one of `laneweave branch`.

use std::collections::BTreeMap;
use std::path::PathBuf;

use laneweave::Simulation;
use laneweave::record::Record;
use laneweave_studies::branch::{Setting, Twins};
use laneweave_viewer::{Live, Rerun, Snapshot, Source};

/// The time at which the twins part, and the end of the run [s].
const AT: f64 = 60.0;
const END: f64 = 120.0;
/// What a frame has for a vehicle that is where its twin is.
const SAME: u8 = 1;

/// The results of a run on a motorway with ramps.
fn results(name: &str) -> PathBuf {
    let map = laneweave_test_data::map("ramps.osm");
    let dir = std::env::temp_dir().join(format!("laneweave-{name}-{}", std::process::id()));
    let simulation = Simulation::builder(map.as_path()).warmup_s(20.0).duration_s(END - 20.0).build();
    simulation.expect("a simulation").run_to_results(&dir).expect("results");
    dir
}

fn settings(texts: &[&str]) -> Vec<Setting> {
    texts.iter().map(|it| it.parse().expect("a setting")).collect()
}

/// How far the vehicles of the traffic, and those of its twin, are from their own in the other, by their ids.
fn differences(source: &dyn Source) -> [BTreeMap<i64, u8>; 2] {
    let mut snapshot = Snapshot::default();
    source.see(&Default::default(), &mut snapshot);
    [false, true].map(|is_ghost| {
        let of_one = snapshot.vehicles.iter().filter(|it| it.is_ghost() == is_ghost);
        of_one.map(|it| (if is_ghost { -1 - it.id } else { it.id }, it.values[3])).collect()
    })
}

#[test]
fn before_the_parting_both_are_the_same_and_after_it_the_twin_is_that_of_branch() {
    let dir = results("twins");
    let record = Record::open(&dir).expect("its record");
    let settings = settings(&["style.speed.weight=4", "aggressive.follow.jam_gap=4"]);
    let mut twins = Twins::part(&record, AT, &settings).expect("twins");
    assert!(!twins.drive().are_none());
    let ends = [&twins.base, &twins.branch].map(|it| it.state_hash());

    let mut run = Rerun::with_twin(&dir, AT, &settings).expect("a run and its twin");
    assert!(run.hello().can.twin);
    let facts = run.twin_facts().expect("a twin is shown");
    assert_eq!((facts.since_s, facts.settings.len()), (AT, 2));
    let mut seen: BTreeMap<u32, (u64, Option<u64>)> = BTreeMap::new();
    for time in [90, 30, 120, 0, 61, 60, 110, 90, 59, 120, 61, 30] {
        run.seek(f64::from(time)).expect("a time");
        let hashes = (run.state_hash(), run.twin_hash());
        assert_eq!(*seen.entry(time).or_insert(hashes), hashes, "at {time} s");
        let is_parted = f64::from(time) > AT;
        assert_eq!(Some(hashes.0) != hashes.1, is_parted, "at {time} s");
        let [of_run, of_twin] = differences(&run);
        if !is_parted {
            assert_eq!(of_run, of_twin, "at {time} s");
            assert!(of_run.values().all(|it| *it == SAME), "at {time} s");
        }
    }
    assert_eq!(seen[&120], (ends[0], Some(ends[1])));
    run.seek(END).expect("the end");
    let [of_run, of_twin] = differences(&run);
    assert!(of_run.values().any(|it| *it > SAME) && of_twin.values().any(|it| *it > SAME));
    // Who is in both is told the same of its distance in both.
    assert!(of_run.iter().all(|(id, it)| of_twin.get(id).is_none_or(|other| other == it)));

    // It can be hidden, and shown again.
    run.twin(false).expect("hidden");
    assert!(run.twin_facts().is_none() && differences(&run)[1].is_empty());
    run.twin(true).expect("shown");
    assert_eq!(differences(&run), [of_run, of_twin]);
    let _ = std::fs::remove_dir_all(dir);
}

#[test]
fn a_twin_with_nothing_changed_stays_the_same_to_the_last_bit() {
    let dir = results("twins-same");
    let mut run = Rerun::with_twin(&dir, AT, &[]).expect("a run and its twin");
    for time in [100.0, 70.0, END] {
        run.seek(time).expect("a time");
        assert_eq!(Some(run.state_hash()), run.twin_hash(), "at {time} s");
    }
    let _ = std::fs::remove_dir_all(dir);
}

#[test]
fn what_is_no_time_or_no_setting_of_a_run_is_refused_and_a_run_alone_has_no_twin() {
    let dir = results("twins-refused");
    let refused = |at: f64, text: &str| {
        Rerun::with_twin(&dir, at, &settings(&[text])).map(drop).expect_err("refused").to_string()
    };
    assert!(refused(500.0, "style.speed.weight=2").contains("120"));
    assert!(refused(-1.0, "style.speed.weight=2").contains("--at"));
    assert!(refused(AT, "nobody.speed.weight=2").contains("nobody"));
    let mut alone = Rerun::open(&dir).expect("a run");
    assert!(!alone.hello().can.twin && alone.twin(true).is_err() && alone.twin(false).is_ok());
    assert!(alone.twin_facts().is_none() && alone.twin_hash().is_none());
    let _ = std::fs::remove_dir_all(dir);
}

#[test]
fn a_live_twin_says_since_when_it_is_shown_and_starts_without_a_difference() {
    let map = laneweave_test_data::map("ramps.osm");
    let (scenario, origin) = laneweave::scenario::Origin::open(&map).expect("a map");
    let mut live = Live::new(&scenario, &origin, std::env::temp_dir()).expect("a simulation");
    (0..300).for_each(|_| live.step(&mut Vec::new()).expect("a step"));
    live.twin(true).expect("a twin");
    (0..100).for_each(|_| live.step(&mut Vec::new()).expect("a step"));
    let since_s = live.twin_facts().expect("it is shown").since_s;
    assert!((since_s - 30.0).abs() < 1e-6, "{since_s}");
    let [of_run, of_twin] = differences(&live);
    assert!(of_run == of_twin && !of_run.is_empty() && of_run.values().all(|it| *it == SAME));
}
