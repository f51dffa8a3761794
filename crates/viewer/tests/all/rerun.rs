//! A run that has ended is driven again bit for bit, whichever of its times is looked at.

use std::time::{Duration, Instant};

use laneweave::Simulation;
use laneweave::record::Record;
use laneweave_viewer::source::Wants;
use laneweave_viewer::{Rerun, Snapshot, Source};

/// Who waits longer waits in vain, however slow the machine is.
const PATIENCE: Duration = Duration::from_secs(600);

#[test]
fn every_time_of_a_run_is_as_it_was_in_whatever_order_they_are_looked_at() {
    let map = laneweave_test_data::map("ramps.osm");
    let dir = std::env::temp_dir().join(format!("laneweave-rerun-{}", std::process::id()));
    let simulation = || Simulation::builder(map.as_path()).warmup_s(20.0).duration_s(100.0).build();
    let mut fresh = simulation().expect("a simulation");
    let hashes: Vec<u64> = (0..=12)
        .map(|tens| {
            fresh.run(f64::from(tens) * 10.0).expect("ten seconds");
            fresh.state_hash()
        })
        .collect();
    simulation().expect("a simulation").run_to_results(&dir).expect("results");

    let mut run = Rerun::open(&dir).expect("a run");
    assert_eq!(run.hello().end_s, Some(120.0));
    for tens in [7, 2, 12, 0, 11, 3, 3, 4] {
        run.seek(f64::from(tens) * 10.0).expect("a time");
        assert_eq!(run.state_hash(), hashes[tens as usize], "at {tens}0 s");
    }
    // What a page is told of the minute before does not depend on how a time was reached.
    let mut straight = Rerun::open(&dir).expect("a run");
    (0..1000).for_each(|_| straight.step(&mut Vec::new()).expect("a step"));
    let look = |run: &Rerun| {
        let mut snapshot = Snapshot::default();
        run.see(&Wants { lanes: true, ..Wants::default() }, &mut snapshot);
        (snapshot.vehicles, snapshot.lanes)
    };
    let begin = Instant::now();
    while run.marks().expect("marks").lock().expect("marks").until_s < 100.0 && begin.elapsed() < PATIENCE {
        std::thread::sleep(Duration::from_millis(20));
    }
    run.seek(20.0).expect("a time");
    run.seek(100.0).expect("a time");
    assert!(look(&run).1.is_some_and(|it| it.len() > 100));
    assert_eq!(look(&run), look(&straight));
    run.seek(1e9).expect("a time");
    assert!(run.has_ended() && run.state_hash() == hashes[12]);
    let kept = Record::open(&dir).expect("its record").end.state_hash;
    assert_eq!(kept, format!("{:016x}", hashes[12]));

    // The survey finds the lane changes of the whole run.
    let marks = run.marks().expect("marks");
    let begin = Instant::now();
    while marks.lock().expect("marks").until_s < 120.0 && begin.elapsed() < PATIENCE {
        std::thread::sleep(Duration::from_millis(20));
    }
    let marks = marks.lock().expect("marks");
    assert!(marks.until_s >= 119.9 && !marks.marks.is_empty());
    assert!(marks.marks.is_sorted_by(|a, b| a.time_s <= b.time_s + 10.0));
    let mut snapshot = Snapshot::default();
    run.see(&Default::default(), &mut snapshot);
    assert!(!snapshot.vehicles.is_empty());
    let _ = std::fs::remove_dir_all(dir);
}
