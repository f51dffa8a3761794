//! Runs that a signal ends.

use std::io::Read;
use std::os::unix::process::ExitStatusExt;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use serde_json::Value;

use crate::command::program::{Folder, maps};
use crate::command::run::number;

/// A run of some days, which has begun to write its results.
fn long_run(folder: &Folder, options: &str) -> Child {
    let line = format!("run {}/ramps.osm --duration 1e6 {options}", maps().display());
    let mut command = Command::new(env!("CARGO_BIN_EXE_laneweave"));
    command.args(line.split_whitespace()).current_dir(folder.path());
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    // It listens to signals before it writes anything.
    while folder.length("out/trajectories.csv.partial") == 0 && !folder.holds("out/checkpoint") {
        std::thread::sleep(Duration::from_millis(10));
    }
    child
}

fn send(child: &Child, signal: &str) {
    let sent = Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap();
    assert!(sent.success());
}

#[test]
fn ctrl_c_and_a_termination_end_a_run_with_whole_results_and_the_code_of_the_signal() {
    for (signal, code) in [("-INT", 130), ("-TERM", 143)] {
        let folder = Folder::new();
        let mut child = long_run(&folder, "--json --format csv");
        send(&child, signal);
        let mut text = String::new();
        child.stdout.take().unwrap().read_to_string(&mut text).unwrap();
        let status = child.wait().unwrap();
        assert_eq!((status.code(), status.signal()), (Some(code), None));
        assert_eq!(text, folder.read("out/summary.json"));
        let summary: Value = serde_json::from_str(&text).unwrap();
        assert_eq!(summary["interrupted"], true);
        // It has written of what it simulated.
        let duration = number(&summary, "duration_s");
        assert!(duration > 0.0 && duration < 1e6, "{duration}");
        assert!(folder.read("out/trajectories.csv").ends_with('\n'));
        for file in ["trips.csv", "lanelets.csv", "lane_changes.csv", "time_space.svg", "report.html"] {
            assert!(folder.holds(&format!("out/{file}")), "{file}");
        }
        let files = std::fs::read_dir(folder.path().join("out")).unwrap();
        let begun =
            files.filter(|it| it.as_ref().unwrap().path().extension().is_some_and(|it| it == "partial"));
        assert_eq!(begun.count(), 0);
    }
}

#[test]
fn a_second_signal_ends_a_run_at_once_with_the_same_code() {
    for (signal, code) in [("-INT", 130), ("-TERM", 143)] {
        let folder = Folder::new();
        let mut child = long_run(&folder, "--quiet --format csv");
        send(&child, signal);
        send(&child, signal);
        assert_eq!(child.wait().unwrap().code(), Some(code));
    }
}

#[test]
fn a_run_that_was_terminated_can_be_resumed() {
    let folder = Folder::new();
    let mut child = long_run(&folder, "--checkpoint 20 --quiet");
    send(&child, "-TERM");
    assert_eq!(child.wait().unwrap().code(), Some(143));
    assert!(folder.holds("out/checkpoint") && folder.holds("out/checkpoint.pages"));
}

#[test]
fn a_terminal_that_closes_ends_a_run_with_whole_results_however_often_it_says_so() {
    let folder = Folder::new();
    let mut child = long_run(&folder, "--format csv");
    // Nobody reads any more.
    drop((child.stdout.take(), child.stderr.take()));
    (0..3).for_each(|_| send(&child, "-HUP"));
    let status = child.wait().unwrap();
    assert_eq!((status.code(), status.signal()), (Some(129), None));
    let summary: Value = serde_json::from_str(&folder.read("out/summary.json")).unwrap();
    assert_eq!(summary["interrupted"], true);
    assert!(folder.read("out/trajectories.csv").ends_with('\n') && folder.holds("out/report.html"));
}

#[test]
#[cfg(target_os = "linux")]
fn a_run_that_was_begun_with_nohup_goes_on_when_the_terminal_closes() {
    let folder = Folder::new();
    let line = format!("run {}/ramps.osm --duration 1e6 --quiet --format csv", maps().display());
    let mut command = Command::new("nohup");
    command.arg(env!("CARGO_BIN_EXE_laneweave")).args(line.split_whitespace()).current_dir(folder.path());
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    while folder.length("out/trajectories.csv.partial") == 0 {
        std::thread::sleep(Duration::from_millis(10));
    }
    send(&child, "-HUP");
    std::thread::sleep(Duration::from_millis(200));
    assert!(child.try_wait().unwrap().is_none());
    send(&child, "-TERM");
    assert_eq!(child.wait().unwrap().code(), Some(143));
}
