//! Runs that are killed at any moment and resumed have the same results as uninterrupted ones.

use std::process::{Command, Stdio};
use std::time::Duration;

use laneweave_test_data::size;

use crate::command::program::{Folder, maps};

/// A run with checkpoints every twenty seconds, and with commands.
const RUN: &str =
    "own.toml --demand 5000 --duration 500 --warmup 20 --checkpoint 20 --format csv --flows 100";
/// The files that are compared to the last byte.
const FILES: [&str; 11] = [
    "commands.csv",
    "trajectories.csv",
    "lane_changes.csv",
    "incidents.csv",
    "trips.csv",
    "lanelets.csv",
    "flows.csv",
    "lane_change_rate.svg",
    "time_space.svg",
    "report.html",
    "scenario.toml",
];

/// A folder with the scenario of the run, and its commands: every four seconds a vehicle comes, brakes and is removed.
fn with_commands() -> Folder {
    let map = maps().join("ramps.osm");
    let scenario = format!("map = \"{}\"\ncommands = \"acts.csv\"\n", map.display());
    let mut acts = "time_s,id,act,values\n".to_owned();
    for (number, time) in (0..520).step_by(4).enumerate() {
        let vehicle = r#"{""lanelet"":95,""position_m"":60,""speed_mps"":12.3,""class"":""car"",""style"":""aggressive""}"#;
        let control = r#"{""drive"":{""longitudinal"":{""speed"":7.1},""lateral"":""driver""}}"#;
        acts += &format!(
            "{time},{number},insert,\"{vehicle}\"\n{},,control,\"[{number},{control}]\"\n",
            time + 3
        );
        acts += &format!("{},,remove,{number}\n", time + 9);
    }
    Folder::new().with("own.toml", &scenario).with("acts.csv", &acts)
}

/// Uniformly distributed in [0, 1), the same numbers in each test.
fn drawn(number: u64) -> f64 {
    let mixed = (number + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    let mixed = (mixed ^ (mixed >> 29)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    (mixed >> 11) as f64 / (1_u64 << 53) as f64
}

/// Starts the program in `folder` and kills it when its file of trajectories has so many bytes, if it still runs; below
/// zero at once.
fn killed(folder: &Folder, line: &str, bytes: f64) {
    let line = line.replace("MAPS", maps().to_str().unwrap());
    let mut child = Command::new(env!("CARGO_BIN_EXE_laneweave"))
        .args(line.split_whitespace())
        .current_dir(folder.path())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let is_early = || (folder.length("out/trajectories.csv.partial") as f64) < bytes;
    while is_early() && child.try_wait().unwrap().is_none() {
        std::thread::sleep(Duration::from_millis(1));
    }
    let _ = child.kill();
    child.wait().unwrap();
}

#[test]
fn killed_at_any_moment_a_run_is_resumed_and_ends_as_if_undisturbed() {
    let wanted = size().pick(5, 60);
    let undisturbed = with_commands();
    let expected = undisturbed.summary(RUN);
    assert!(expected["inserted"].as_u64() > Some(20) && expected["commands_refused"].as_u64() > Some(0));
    // From a kill at once to one at the end.
    let whole = undisturbed.length("out/trajectories.csv") as f64;
    let moment = |number: u64| whole * (1.1 * drawn(number) - 0.05);
    let read = |folder: &Folder, file: &str| std::fs::read(folder.path().join("out").join(file)).unwrap();
    let is_same = |folder: &Folder, file: &str| read(folder, file) == read(&undisturbed, file);
    let (mut resumed, mut from_a_checkpoint) = (0, 0);
    for number in 0..10 * wanted {
        if resumed == wanted {
            break;
        }
        let folder = with_commands();
        let out = folder.path().join("out");
        killed(&folder, &format!("run {RUN} --json"), moment(2 * number));
        if !out.join("scenario.toml").exists() {
            // Killed before any file existed.
            continue;
        }
        // Every third is killed once more.
        if number % 3 == 0 {
            killed(&folder, "run out --resume", moment(2 * number + 1));
        }
        let has_ended = out.join("summary.json").exists();
        // A file with its final name is complete.
        for file in &FILES[..10] {
            if out.join(file).exists() {
                assert!(is_same(&folder, file), "{file} after kill {number}");
            }
        }
        resumed += u64::from(!has_ended);
        from_a_checkpoint += u64::from(!has_ended && out.join("checkpoint").exists());
        let summary = folder.summary("out --resume");
        for field in [
            "state_hash",
            "inserted",
            "removed",
            "commands_refused",
            "entered",
            "completed",
            "lane_changes",
            "considerations",
            "updates",
            "mean_speed_mps",
        ] {
            assert_eq!(summary[field], expected[field], "{field} after kill {number}");
        }
        for file in FILES {
            assert!(is_same(&folder, file), "{file} after kill {number}");
        }
        let left_over: Vec<_> = std::fs::read_dir(&out)
            .unwrap()
            .map(|it| it.unwrap().file_name().into_string().unwrap())
            .filter(|it| it.contains("checkpoint") || it.ends_with(".partial"))
            .collect();
        assert!(left_over.is_empty(), "{left_over:?} after kill {number}");
    }
    assert!(
        resumed == wanted && from_a_checkpoint > 0,
        "{resumed} resumed, {from_a_checkpoint} from a checkpoint"
    );
}

#[test]
fn a_run_that_has_ended_has_nothing_to_resume() {
    let folder = Folder::new();
    let ended = folder.summary("MAPS/ramps.osm --duration 20 --record 0 --checkpoint 5");
    assert!(!folder.holds("out/checkpoint") && !folder.holds("out/checkpoint.pages"));
    let again = folder.laneweave("run out --resume");
    assert_eq!(again.code(), 0);
    assert!(again.errors().contains("the run is already complete"), "{}", again.errors());
    assert_eq!(folder.summary("out --resume")["wall_s"], ended["wall_s"]);
}

#[test]
fn what_cannot_be_resumed_is_refused_with_a_remedy() {
    let folder = Folder::new();
    let refused = |line: &str| {
        let run = folder.laneweave(line);
        assert_eq!(run.code(), 2, "{line}");
        run.errors()
    };
    assert!(refused("run nowhere --resume").contains("nothing to resume"));
    folder.summary("MAPS/ramps.osm --duration 20 --record 0");
    std::fs::remove_file(folder.path().join("out/summary.json")).unwrap();
    std::fs::write(folder.path().join("out/checkpoint"), b"half of a checkpoint").unwrap();
    let damaged = refused("run out --resume");
    assert!(damaged.contains("the checkpoint is damaged; run again from the beginning"), "{damaged}");
    assert!(refused("run MAPS/ramps.osm --checkpoint 0.25").contains("choose a multiple of it"));
}

#[test]
fn a_run_is_not_resumed_as_another_one() {
    let folder = Folder::new();
    folder.laneweave("styles new mild --from conservative");
    folder.summary(
        "MAPS/ramps.osm --demand 900 --duration 20 --record 2 --format csv --sumo fcd --style mild.toml=2",
    );
    std::fs::remove_file(folder.path().join("out/summary.json")).unwrap();
    let line = "run out --resume --demand 800 --seed 3 --out other --record 1 --sumo tripinfo --style cautious=1 --duration 20";
    let refused = folder.laneweave(line);
    assert_eq!(refused.code(), 2);
    let told = refused.errors();
    for part in [
        "error: --resume: the options differ from those of the run: ",
        "--demand 800 instead of 900",
        "--seed 3 instead of 1",
        "--out other instead of out",
        "--record 1 instead of 2",
        "--sumo [\"tripinfo\"] instead of [\"fcd\"]",
        "--style cautious=1 instead of styles/mild.toml=2",
        "; remove these options, or run again from the beginning without --resume",
    ] {
        assert!(told.contains(part), "{part}: {told}");
    }
    assert!(!told.contains("--duration") && !folder.holds("other"), "{told}");
    let refused = folder.laneweave("run out --resume --model mobil").errors();
    assert!(refused.contains("--model mobil instead of none"), "{refused}");
}

#[test]
fn options_that_are_those_of_the_run_may_be_given_again() {
    let folder = Folder::new();
    folder.laneweave("styles new mild --from conservative");
    let options = "--demand 900 --duration 20 --record 0 --seed 5 --style mild.toml=2 --style cautious=1";
    let whole = folder.summary(&format!("MAPS/ramps.osm {options}"));
    std::fs::remove_file(folder.path().join("out/summary.json")).unwrap();
    let resumed = folder.summary(&format!("out --resume {options} --out ./out/ --threads 1"));
    assert_eq!(resumed["state_hash"], whole["state_hash"]);
    assert_eq!(resumed["threads"], 1);
}

/// A folder with a run that was killed after its first checkpoint.
fn broken_off() -> Folder {
    let folder = Folder::new();
    let line =
        "run MAPS/ramps.osm --duration 1e6 --checkpoint 20 --quiet".replace("MAPS", maps().to_str().unwrap());
    let mut child = Command::new(env!("CARGO_BIN_EXE_laneweave"))
        .args(line.split_whitespace())
        .current_dir(folder.path())
        .spawn()
        .unwrap();
    while !folder.holds("out/checkpoint") {
        std::thread::sleep(Duration::from_millis(10));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    folder
}

#[test]
fn what_is_not_as_it_was_kept_is_not_resumed() {
    let folder = broken_off();
    let refused = || {
        let run = folder.laneweave("run out --resume");
        assert_eq!(run.code(), 2);
        run.errors()
    };
    let scenario = folder.read("out/scenario.toml");
    let path = folder.path().join("out/scenario.toml");
    for (key, other) in [
        ("record_s = 1.0", "record_s = 2.0"),
        ("flows_s = 0.0", "flows_s = 60.0"),
        ("format = \"parquet\"", "format = \"csv\""),
        ("sumo = []", "sumo = [\"fcd\"]"),
        ("checkpoint_s = 20.0", "checkpoint_s = 0.0"),
    ] {
        assert!(scenario.contains(key), "{key}: {scenario}");
        std::fs::write(&path, scenario.replace(key, other)).unwrap();
        let told = refused();
        assert!(
            told.contains("the [output] of its scenario has changed since this was run"),
            "{other}: {told}"
        );
    }
    std::fs::write(&path, scenario.replace("duration_s = 1000000.0", "duration_s = 100.0")).unwrap();
    assert!(refused().contains("the scenario or the program has changed since this was run"));
    std::fs::write(&path, &scenario).unwrap();

    let pages = folder.path().join("out/checkpoint.pages");
    let mut bytes = std::fs::read(&pages).unwrap();
    bytes[1000] ^= 1;
    std::fs::write(&pages, &bytes).unwrap();
    let told = refused();
    assert!(told.contains("a batch is damaged; run again from the beginning"), "{told}");
    assert!(folder.holds("out/checkpoint") && !folder.holds("out/summary.json"));
    let told = folder.laneweave("explain out --summary").errors();
    assert!(
        told.contains("this run is not complete; wait, or resume it: laneweave run out --resume"),
        "{told}"
    );
}

/// Runs the program with a limit of some kilobytes on file sizes.
#[cfg(target_os = "linux")]
fn on_a_small_disk(folder: &Folder, line: &str) -> String {
    let line = line.replace("MAPS", maps().to_str().unwrap());
    let output = Command::new("sh")
        .args(["-c", "trap '' XFSZ; ulimit -f 40; exec \"$0\" \"$@\"", env!("CARGO_BIN_EXE_laneweave")])
        .args(line.split_whitespace())
        .current_dir(folder.path())
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(2));
    String::from_utf8(output.stderr).unwrap()
}

#[cfg(target_os = "linux")]
#[test]
fn a_checkpoint_that_cannot_be_written_is_told_and_nothing_half_written_is_left() {
    // With samples the batches are too large at the first checkpoint; without them the checkpoint is.
    for (record, file) in [(1, "checkpoint.pages"), (0, "checkpoint")] {
        let folder = Folder::new();
        let options = format!("--warmup 150 --checkpoint 20 --record {record}");
        let told =
            on_a_small_disk(&folder, &format!("run MAPS/ramps.osm --demand 6000 --duration 200 {options}"));
        assert!(told.contains(&format!("out/{file}: cannot be written: file too large")), "{told}");
        let left: Vec<_> = std::fs::read_dir(folder.path().join("out")).unwrap().flatten().collect();
        assert!(left.iter().all(|it| !it.path().to_string_lossy().ends_with(".partial")), "{left:?}");
    }
}
