//! The examples run, and what they assert is so.

use std::path::Path;

use laneweave::Fault;

#[path = "../../examples/01_run.rs"]
pub mod run;

#[path = "../../examples/02_own_style.rs"]
pub mod own_style;

#[path = "../../examples/03_observe_and_count.rs"]
pub mod observe_and_count;

#[path = "../../examples/04_external_control.rs"]
pub mod external_control;

#[path = "../../examples/05_checkpoint_and_twin.rs"]
pub mod checkpoint_and_twin;

#[path = "../../examples/06_recorded_frame.rs"]
pub mod recorded_frame;

#[path = "../../examples/07_commands_in_results.rs"]
pub mod commands_in_results;

#[path = "../../examples/09_many_worlds.rs"]
pub mod many_worlds;

/// Runs an example where its reader runs it: in the folder of the project.
fn runs(example: fn() -> Result<(), Fault>) {
    let home = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    std::env::set_current_dir(home).expect("the folder of the project is there");
    assert_eq!(example(), Ok(()));
}

#[test]
fn a_scenario_is_run_with_all_its_results() {
    runs(run::main);
    let out = std::env::temp_dir().join(format!("laneweave-example-{}", std::process::id()));
    assert!(out.join("trips.parquet").exists() || out.join("trips.csv").exists());
    std::fs::remove_dir_all(out).expect("the example has written into it");
}

#[test]
fn many_worlds_are_stepped_together() {
    runs(many_worlds::main);
}

#[test]
fn drivers_of_an_own_style_drive() {
    runs(own_style::main);
    let file = std::env::temp_dir().join(format!("laneweave-hasty-{}.toml", std::process::id()));
    std::fs::remove_file(file).expect("the example has written it");
}

#[test]
fn what_happens_is_observed_and_counted() {
    runs(observe_and_count::main);
}

#[test]
fn a_vehicle_is_driven_from_outside() {
    runs(external_control::main);
}

#[test]
fn a_simulation_is_continued_twice() {
    runs(checkpoint_and_twin::main);
}

#[test]
fn a_recorded_frame_is_perceived() {
    runs(recorded_frame::main);
}

#[test]
fn commands_are_given_during_a_run_and_repeated() {
    runs(commands_in_results::main);
    let out = std::env::temp_dir().join(format!("laneweave-commands-example-{}", std::process::id()));
    std::fs::remove_dir_all(out).expect("the example has written into it");
}

#[test]
fn every_example_is_run_here_and_short() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let own = include_str!("examples.rs");
    let mut count = 0;
    for entry in std::fs::read_dir(folder).expect("it is there") {
        let path = entry.expect("it can be read").path();
        let name = path.file_name().expect("it has a name").to_string_lossy().into_owned();
        assert!(own.contains(&name), "{name} is not run");
        let text = std::fs::read_to_string(&path).expect("it is text");
        assert!(text.lines().count() <= 64, "{name} is long");
        count += 1;
    }
    assert_eq!(count, 8);
}
