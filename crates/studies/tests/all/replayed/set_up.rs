//! Recordings and their replays for these tests.

use std::env;
use std::fs;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

use laneweave::Simulation;
use laneweave::scenario::{Origin, Replay, Scenario};
use laneweave_recorded::Drone;
use laneweave_recordings::{Recording, interaction};
use laneweave_studies::replay;
use laneweave_test_data::{data, map};

/// A run on one of our own maps as a drone sees it, with errors of so much [m].
pub(crate) fn observed(scenario: &Scenario, noise: f64) -> Recording {
    let mut simulation =
        Simulation::from_scenario(scenario, &Origin::default()).expect("the scenario is sound");
    (0..simulation.run_steps()[0]).for_each(|_| simulation.advance());
    let mut watch = simulation.drone_watch();
    for _ in 0..simulation.run_steps()[1] {
        simulation.advance();
        simulation.show(&mut watch);
    }
    Drone { noise, ..Drone::exact(10.0) }.observe(&watch.into_recording())
}

/// The scenario of a map with one style of drivers, for so long after a minute of warm-up [s].
pub(crate) fn of_style(name: &str, style: &str, demand: f64, duration_s: f64) -> Scenario {
    let mut scenario = Scenario::of_map(map(name));
    scenario.demand.vehicles_per_hour = Some(demand);
    scenario.run.warmup_s = 60.0;
    scenario.run.duration_s = duration_s;
    scenario.styles = [(style.to_owned(), 1.0)].into();
    scenario
}

/// A recording as a file.
pub(crate) fn written(recording: &Recording) -> PathBuf {
    static COUNT: AtomicUsize = AtomicUsize::new(0);
    let number = COUNT.fetch_add(1, Ordering::Relaxed);
    let folder = env::temp_dir().join(format!("laneweave-replayed-{}", std::process::id()));
    fs::create_dir_all(&folder).expect("it can be made");
    let path = folder.join(format!("{number}.csv"));
    let mut file = fs::File::create(&path).expect("it can be made");
    interaction::write(recording, &mut file).expect("it can be written");
    path
}

/// The replay of a recording, with this share of drivers.
pub(crate) fn replayed(recording: PathBuf, map: PathBuf, reactive_share: f64) -> Scenario {
    let replay = Replay { recording: vec![recording], reactive_share, ..Replay::default() };
    replay::scenario(map, replay).expect("it can be read").0
}

pub(crate) fn ready(scenario: &Scenario) -> Simulation {
    Simulation::from_scenario(scenario, &Origin::default()).expect("it can be replayed")
}

/// The recording and the map of a place, if they are there.
pub(crate) fn mona() -> Option<[PathBuf; 2]> {
    let folder = data("recordings/mona_east")?;
    Some([folder.join("vehicle_tracks_000.csv"), folder.join("map.osm_xy")])
}
