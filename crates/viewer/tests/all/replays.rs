//! Recorded vehicles beside simulated drivers.

use std::fmt::Write as _;
use std::fs;

use laneweave::scenario::{Origin, Replay};
use laneweave_studies::replay;
use laneweave_viewer::source::Wants;
use laneweave_viewer::{Live, Snapshot, Source};

#[test]
fn recorded_vehicles_are_no_drivers_and_nobody_drives_them() {
    let dir = std::env::temp_dir().join(format!("laneweave-view-replay-{}", std::process::id()));
    fs::create_dir_all(&dir).expect("a folder");
    let mut rows = "track_id,frame_id,timestamp_ms,agent_type,x,y,vx,vy,psi_rad,length,width\n".to_owned();
    for (id, ahead) in [(1, 100.0), (2, 60.0)] {
        for frame in 1..=100 {
            let x = ahead + 2.0 * f64::from(frame);
            writeln!(rows, "{id},{frame},{},car,{x},0,20,0,0,4.5,1.8", 100 * frame).expect("a row");
        }
    }
    let recording = dir.join("vehicle_tracks_000.csv");
    fs::write(&recording, rows).expect("a file");
    let replay = Replay { recording: vec![recording], reactive_ids: vec![2], ..Replay::default() };
    let map = laneweave_test_data::map("motorway_2_lanes.osm");
    let scenario = replay::scenario(map, replay).expect("a scenario").0;
    let mut live = Live::new(&scenario, &Origin::default(), dir.clone()).expect("a simulation");
    (0..50).for_each(|_| live.step(&mut Vec::new()).expect("a step"));
    let mut snapshot = Snapshot::default();
    // Vehicles of recordings have ids of their own, in the order in which they come.
    let ids = [1_000_000_000, 1_000_000_001];
    live.see(&Wants { selected: ids.to_vec(), ..Wants::default() }, &mut snapshot);
    let told = |id: i64| snapshot.vehicles.iter().find(|it| it.id == id).expect("it is there");
    assert_eq!(
        (told(ids[0]).is_recorded, told(ids[0]).is_external, told(ids[0]).is_ghost()),
        (true, false, false)
    );
    assert_eq!((told(ids[1]).is_recorded, told(ids[1]).is_external), (false, false));
    let [recorded, driver] = ids.map(|id| &*snapshot.drivers[&id]);
    assert!(recorded.contains("\"style\":null") && recorded.contains("\"is_external\":false"), "{recorded}");
    assert!(recorded.contains("\"lanelet\":\"") && recorded.contains("\"speed_kmh\":7"), "{recorded}");
    assert!(!driver.contains("\"style\":null") && driver.contains("\"is_external\":false"), "{driver}");
    let _ = fs::remove_dir_all(dir);
}
