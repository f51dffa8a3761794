//! All output arrives on standard output, or the command fails.

use std::fs::File;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use serde_json::Value;

use crate::command::program::{Folder, maps};

/// Command lines that print something, each with a file that must be complete afterwards.
const LINES: [(&str, &str); 10] = [
    ("run MAPS/ramps.osm --duration 5", "out/summary.json"),
    ("run MAPS/ramps.osm --duration 5 --json", "out/report.html"),
    ("compare MAPS/ramps.osm --duration 5 --seeds 2 --model mobil", "comparison/runs.csv"),
    ("check MAPS/ramps.osm --svg map.svg", "map.svg"),
    ("scenario new MAPS/ramps.osm --out s.toml", "s.toml"),
    ("man pages", "pages/laneweave.1"),
    ("styles list", "."),
    ("schema", "."),
    ("--help", "."),
    ("--version", "."),
];

/// Runs the program in `folder`, with its standard output going to `out`.
fn laneweave(folder: &Path, line: &str, out: impl Into<Stdio>) -> Output {
    let line = line.replace("MAPS", maps().to_str().unwrap());
    let mut command = Command::new(env!("CARGO_BIN_EXE_laneweave"));
    command.args(line.split_whitespace()).current_dir(folder).stdout(out).output().unwrap()
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_standard_output_is_an_error() {
    for (line, file) in LINES {
        let folder = Folder::new();
        let full = File::options().write(true).open("/dev/full").unwrap();
        let output = laneweave(folder.path(), line, full);
        let told = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{line}: {told}");
        let expected = "error: standard output: cannot be written: no space left on device; free some space there, or redirect the \
                        output\n";
        assert!(told.ends_with(expected), "{line}: {told}");
        assert!(folder.holds(file), "{line}");
    }
}

#[test]
fn a_closed_standard_output_ends_a_command_quietly_with_whole_results() {
    for (line, file) in LINES {
        let folder = Folder::new();
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let output = laneweave(folder.path(), line, writer);
        let told = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{line}: {told}");
        assert!(!told.contains("error"), "{line}: {told}");
        assert!(folder.holds(file), "{line}");
    }
}

#[test]
fn a_run_into_a_closed_standard_output_has_ended_all_the_same() {
    let folder = Folder::new();
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    laneweave(folder.path(), "run MAPS/ramps.osm --duration 20 --checkpoint 5", writer);
    let summary: Value = serde_json::from_str(&folder.read("out/summary.json")).unwrap();
    assert_eq!(summary["interrupted"], false);
    assert!(!folder.holds("out/checkpoint"));
}
