//! `laneweave reproduce`: the experiments.

use crate::command::program::Folder;

#[test]
fn what_is_asked_wrongly_is_refused_and_nothing_is_written() {
    let folder = Folder::new();
    for (line, message) in [
        ("C9", "invalid value 'C9' for '[EXPERIMENT]...'"),
        ("C1 --seeds 0", "invalid value '0' for '--seeds <N>'"),
        ("C1 --seeds many", "invalid value 'many' for '--seeds <N>'"),
        ("C1 --map a.osm", "the following required arguments were not provided"),
        (
            "C1 --site a.csv --map a.osm",
            "--site: only C2 is measured at a recorded site; write: laneweave reproduce C2",
        ),
        ("C2 --site a.csv --map a.osm", "a.csv"),
        ("C1 --quick --quick", "the argument '--quick' cannot be used multiple times"),
    ] {
        let run = folder.laneweave(&format!("reproduce {line}"));
        assert_eq!(run.code(), 2, "{line}");
        assert!(run.errors().contains(message), "{line}: {}", run.errors());
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn the_folder_of_a_run_is_not_mixed_with_experiments() {
    let folder = Folder::new();
    assert_eq!(folder.laneweave("run MAPS/ramps.osm --duration 2 --record 0").code(), 0);
    let run = folder.laneweave("reproduce C1 --quick --out out");
    assert_eq!(run.code(), 2);
    assert!(run.errors().contains("this folder contains a scenario"), "{}", run.errors());
    assert!(!folder.holds("out/C1.md"));
}
