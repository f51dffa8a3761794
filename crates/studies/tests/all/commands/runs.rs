//! Runs that write their results into folders of their own.

use std::fs;
use std::num::NonZero;
use std::path::{Path, PathBuf};

use laneweave::output::Summary;
use laneweave::scenario::{Origin, Scenario, TableFormat};
use laneweave::{Fault, Simulation};
use laneweave_test_data::map;

/// An empty folder for a test.
pub(crate) fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("commands").join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("it can be made");
    folder
}

/// A run on a map, with tables in CSV.
pub(crate) fn scenario(name: &str, vehicles_per_hour: f64, duration_s: f64) -> Scenario {
    let mut scenario = Scenario::of_map(map(name));
    scenario.demand.vehicles_per_hour = Some(vehicles_per_hour);
    scenario.run.duration_s = duration_s;
    scenario.run.threads = NonZero::new(1);
    scenario.output.format = TableFormat::Csv;
    scenario.output.record_s = 5.0;
    scenario
}

pub(crate) fn simulation(scenario: &Scenario) -> Simulation {
    Simulation::from_scenario(scenario, &Origin::default()).expect("it is sound")
}

/// The summary of `scenario`, with its results in `dir`.
pub(crate) fn run(scenario: &Scenario, dir: &Path) -> Summary {
    simulation(scenario).run_to_results(dir).expect("it runs")
}

/// What is wrong with `scenario`.
pub(crate) fn refused(scenario: &Scenario) -> Fault {
    Simulation::from_scenario(scenario, &Origin::default()).err().expect("it is refused")
}

/// The tables of the run in `dir`, with their names.
pub(crate) fn tables(dir: &Path) -> Vec<(String, String)> {
    let files = fs::read_dir(dir).expect("it is there").map(|it| it.expect("an entry").path());
    let tables = files.filter(|it| it.extension().is_some_and(|it| it == "csv"));
    let read = |it: PathBuf| {
        let name = it.file_name().expect("a name").to_string_lossy().into_owned();
        (name, fs::read_to_string(&it).expect("text"))
    };
    let mut tables: Vec<_> = tables.map(read).collect();
    tables.sort();
    assert!(tables.iter().any(|(name, _)| name == "commands.csv"), "{tables:?}");
    tables
}

/// Asserts that the runs in two folders have the same tables.
pub(crate) fn assert_same_tables(one: &Path, other: &Path) {
    for ((name, one), (its_name, other)) in tables(one).into_iter().zip(tables(other)) {
        assert_eq!(name, its_name);
        let differing = one.lines().zip(other.lines()).find(|(a, b)| a != b);
        assert!(one == other, "{name}: {differing:?}");
    }
    assert_eq!(tables(one).len(), tables(other).len());
}
