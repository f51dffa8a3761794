//! Limits of the system: what it does not give is an error, and no more is lost than that.

use std::process::{Command, Output};

use crate::command::program::{Folder, maps};

/// A run of a map with `options`, under a limit as `ulimit` takes it.
fn limited(folder: &Folder, limit: &str, options: &str) -> Output {
    let program = env!("CARGO_BIN_EXE_laneweave");
    let script = format!("ulimit {limit}; exec {program} run {}/ramps.osm {options}", maps().display());
    let mut command = Command::new("sh");
    // Stacks of half a gigabyte, but only for the threads of the simulation.
    command.args(["-c", &script]).envs([("RUST_MIN_STACK", "500000000"), ("RAYON_NUM_THREADS", "1")]);
    command.current_dir(folder.path()).output().unwrap()
}

#[test]
fn threads_that_do_not_start_are_an_error_with_a_remedy() {
    let folder = Folder::new();
    // Four gigabytes of addresses have no room for the stacks of so many.
    let refused = limited(&folder, "-v 4000000", "--duration 5 --threads 256");
    let errors = String::from_utf8(refused.stderr).unwrap();
    assert_eq!(refused.status.code(), Some(2), "{errors}");
    let expected = "error: --threads: 256 threads cannot be started: ";
    assert!(
        errors.contains(expected) && errors.contains("; choose fewer, or close other programs"),
        "{errors}"
    );
    assert!(!folder.holds("out"));
}

/// A file that is too large is like one on a full disk: the others are whole, and it is named.
#[test]
fn a_file_for_which_there_is_no_room_is_named_and_the_others_are_whole() {
    /// Room for a file, in the blocks of `ulimit` [512 bytes]: the report is larger, the tables are not.
    const ROOM: u32 = 100;
    let folder = Folder::new();
    let run = |out: &str, limit: &str| {
        let options = format!("--duration 30 --record 0 --format csv --out {out}");
        limited(&folder, &format!("-f {limit}"), &options)
    };
    assert!(run("all", "unlimited").status.success());
    let refused = run("out", &ROOM.to_string());
    let errors = String::from_utf8(refused.stderr).unwrap();
    assert_eq!(refused.status.code(), Some(2), "{errors}");
    let whole = |name: &str| folder.length(&format!("all/{name}")) <= u64::from(ROOM) * 512;
    assert!(!whole("report.html"));
    let named = errors.lines().find_map(|it| it.strip_prefix("error: ")).unwrap();
    assert!(named.contains("file too large; make room for it, or choose another place"), "{named}");
    for entry in std::fs::read_dir(folder.path().join("all")).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        let path = format!("out/{name}");
        assert_eq!(folder.holds(&path), whole(&name), "{name}");
        assert_eq!(named.contains(&path), !whole(&name), "{name}: {named}");
        if name.ends_with(".csv") && whole(&name) {
            assert_eq!(folder.read(&path), folder.read(&format!("all/{name}")));
        }
    }
    let files = std::fs::read_dir(folder.path().join("out")).unwrap();
    assert!(files.into_iter().all(|it| it.unwrap().path().extension().is_none_or(|it| it != "partial")));
}
