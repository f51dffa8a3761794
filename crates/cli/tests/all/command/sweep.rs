//! `laneweave sweep`: processes do the runs, and what ends them loses nothing.

use std::fs;
use std::process::{Child, Command};
use std::time::Duration;

use crate::command::program::{Folder, maps};

/// Forty runs.
fn plan() -> String {
    let map = maps().join("on_ramp.osm");
    format!(
        "scenario = \"{}\"\nseeds = 10\n[grid]\nrun.duration_s = [60]\nmodel = [\"mcdm\", \"mobil\"]\ndemand.trucks = [0.0, 0.2]\n",
        map.display()
    )
}

fn begin(folder: &Folder) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_laneweave"));
    command.args(["sweep", "plan.toml", "--out", "ended", "--quiet"]).current_dir(folder.path());
    command.spawn().unwrap()
}

/// The number of rows.
fn done(folder: &Folder, name: &str) -> usize {
    let rows = fs::read_dir(folder.path().join(name).join("rows")).into_iter().flatten();
    rows.filter(|it| it.as_ref().is_ok_and(|it| it.path().extension().is_some_and(|it| it == "json"))).count()
}

#[test]
fn a_sweep_that_is_ended_again_and_again_has_the_table_of_one_that_is_not() {
    let folder = Folder::new().with("plan.toml", &plan());
    let told = folder.laneweave("sweep plan.toml --out whole --workers 2");
    assert_eq!((told.code(), told.errors().as_str()), (0, ""));
    assert!(told.text().starts_with("40 runs of 4 variants\n"), "{}", told.text());
    let mut ends = 0;
    for most in [0, 5, 20] {
        let mut child = begin(&folder);
        while done(&folder, "ended") <= most && child.try_wait().unwrap().is_none() {
            std::thread::sleep(Duration::from_millis(1));
        }
        child.kill().unwrap();
        ends += u32::from(!child.wait().unwrap().success());
    }
    assert!(ends > 0);
    assert_eq!(folder.laneweave("sweep plan.toml --out ended --quiet").code(), 0);
    for table in ["runs", "variants"] {
        let read = |name: &str| fs::read(folder.path().join(format!("{name}/{table}.parquet"))).unwrap();
        assert_eq!(read("ended"), read("whole"));
    }
    assert_eq!(done(&folder, "ended"), 40);
}

#[test]
fn a_part_says_what_others_have_to_do_and_the_last_one_writes_the_tables() {
    let folder = Folder::new().with("plan.toml", &plan().replace("[60]", "[5]"));
    let part = |it: &str| folder.laneweave(&format!("sweep plan.toml --shard {it}"));
    let first = part("1/2");
    assert_eq!((first.code(), first.errors().as_str()), (0, ""));
    assert_eq!(first.text(), "sweep: 20 of 40 runs are done; the part that ends last writes the tables\n");
    assert!(!folder.holds("sweep/runs.parquet"));
    assert_eq!(part("2/2").code(), 0);
    assert!(folder.holds("sweep/runs.parquet"));
    // The folder is enough to go on.
    fs::remove_file(folder.path().join("plan.toml")).unwrap();
    assert!(folder.laneweave("sweep sweep").text().contains("all runs: sweep/runs.parquet"));
}

#[test]
fn parts_that_begin_and_end_at_the_same_time_do_not_disturb_each_other() {
    let folder = Folder::new().with("plan.toml", &plan().replace("[60]", "[1]"));
    for round in 0..5 {
        let out = format!("shared{round}");
        let part = |number: u32| {
            let mut command = Command::new(env!("CARGO_BIN_EXE_laneweave"));
            command.args(["sweep", "plan.toml", "--out", &out, "--workers", "1", "--quiet"]);
            command.args(["--shard", &format!("{number}/4")]).current_dir(folder.path()).spawn().unwrap()
        };
        let parts: Vec<Child> = (1..=4).map(part).collect();
        assert!(parts.into_iter().all(|mut it| it.wait().unwrap().success()));
        let left = fs::read_dir(folder.path().join(&out)).unwrap().map(|it| it.unwrap().file_name());
        let mut left: Vec<_> = left.collect();
        left.sort();
        assert_eq!(left, ["rows", "runs.parquet", "sweep.json", "variants.parquet"]);
    }
}

#[test]
fn what_is_wrong_with_a_plan_is_said_before_anything_runs() {
    let folder = Folder::new().with("plan.toml", "scenario = \"none.osm\"\n").with("grid.toml", "[grid]\n");
    let cases = [
        (
            "plan.toml",
            "error: plan.toml:1:1: none.osm: cannot be read: no such file or directory; check the path\n",
        ),
        ("grid.toml", "error: grid.toml:1:1: the key \"scenario\" is missing; add it\n"),
        ("other.toml", "error: other.toml: cannot be read: no such file or directory; check the path\n"),
        (
            ". --out x",
            "error: --out: the input is the folder of a sweep already; leave it out, or give the plan as input\n",
        ),
    ];
    for (arguments, expected) in cases {
        let told = folder.laneweave(&format!("sweep {arguments}"));
        assert_eq!((told.code(), told.errors().as_str()), (2, expected));
    }
    assert!(!folder.holds("sweep"));
}
