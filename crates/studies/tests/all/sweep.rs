//! Sweeps: each row is that of a run of its own, nothing is lost or done twice, and what does not fit is refused.

use std::fs;
use std::path::{Path, PathBuf};
use std::process;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use laneweave::scenario::{Origin, Scenario};
use laneweave::{Fault, FaultKind, Simulation};
use laneweave_studies::sweep::{Shard, Sweep, Worker};

/// Four runs on a copy of a map.
const PLAN: &str = "scenario = \"road.osm\"\nseeds = [3, 8]\n[grid]\nrun.duration_s = [30]\ndemand.vehicles_per_hour = [1500, 3000]\n";

/// A folder that is removed with the test.
struct Home(PathBuf);

impl Home {
    fn new() -> Home {
        static NUMBER: AtomicU32 = AtomicU32::new(0);
        let number = NUMBER.fetch_add(1, Ordering::Relaxed);
        let path = std::env::temp_dir().join(format!("laneweave-sweep-{}-{number}", process::id()));
        fs::create_dir_all(&path).expect("a folder");
        fs::copy(laneweave_test_data::map("on_ramp.osm"), path.join("road.osm")).expect("a map");
        Home(path)
    }

    fn out(&self) -> PathBuf {
        self.0.join("out")
    }

    /// Begins, or goes on.
    fn begin(&self, plan: &str) -> Result<Arc<Sweep>, Fault> {
        let path = self.0.join("plan.toml");
        fs::write(&path, plan).expect("it is written");
        let sweep = Sweep::begin(&path, &self.out(), 2, |_| true)?;
        Ok(Arc::new(sweep.expect("it was not stopped")))
    }

    fn rows(&self) -> Vec<PathBuf> {
        let entries = fs::read_dir(self.out().join("rows")).expect("it is there");
        entries.map(|it| it.expect("an entry").path()).collect()
    }
}

impl Drop for Home {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn open(sweep: &Sweep) -> Vec<String> {
    sweep.open_keys(Shard::default()).expect("the folder is there")
}

fn do_all(sweep: &Arc<Sweep>) {
    let mut worker = Worker::of(Arc::clone(sweep));
    open(sweep).iter().for_each(|it| worker.run(it).expect("it runs"));
}

/// The hash of the state at the end of a run of its own.
fn alone(map: &Path, demand: f64, seed: u64) -> String {
    let mut scenario = Scenario::of_map(map.to_owned());
    scenario.demand.vehicles_per_hour = Some(demand);
    scenario.run.duration_s = 30.0;
    scenario.run.seed = seed;
    let mut simulation = Simulation::from_scenario(&scenario, &Origin::default()).expect("the map is sound");
    simulation.run(30.0).expect("it is a time to come");
    format!("{:016x}", simulation.state_hash())
}

#[test]
fn each_row_is_that_of_a_run_of_its_own() {
    let home = Home::new();
    let sweep = home.begin(PLAN).expect("a plan");
    assert_eq!((sweep.variants(), sweep.runs().len(), open(&sweep).len()), (2, 4, 4));
    do_all(&sweep);
    for run in sweep.runs() {
        let row =
            fs::read_to_string(home.out().join("rows").join(format!("{}.json", run.key))).expect("a row");
        let hash = alone(&home.0.join("road.osm"), [1500.0, 3000.0][run.variant], run.seed);
        assert!(row.contains(&hash), "{row}: {hash}");
    }
    let swept = sweep.finish().expect("it is written").expect("all are done");
    assert!(swept.runs.exists() && swept.variants.exists());
    assert!(swept.text.contains("demand.vehicles_per_hour=3000 "), "{}", swept.text);
}

#[test]
fn a_sweep_goes_on_and_a_damaged_row_is_done_again() {
    let home = Home::new();
    let sweep = home.begin(PLAN).expect("a plan");
    let first = open(&sweep)[0].clone();
    Worker::of(Arc::clone(&sweep)).run(&first).expect("it runs");
    assert_eq!(sweep.finish().expect("rows are read"), Err(3));
    let again = Sweep::begun(&home.out()).expect("it was begun");
    assert_eq!(open(&again), open(&sweep));
    do_all(&sweep);
    let whole = sweep.finish().expect("it is written").expect("all are done");
    let table = fs::read(&whole.runs).expect("it is there");
    let row = home.rows()[0].clone();
    let text = fs::read_to_string(&row).expect("a row");
    for damaged in ["", "{}", &text[..text.len() - 1]] {
        fs::write(&row, damaged).expect("it is written");
        assert_eq!(open(&sweep).len(), 1);
        do_all(&sweep);
    }
    fs::write(home.out().join("rows/0.1-2.partial"), "half").expect("it is written");
    let again = sweep.finish().expect("it is written").expect("all are done");
    assert_eq!(fs::read(again.runs).expect("it is there"), table);
    assert_eq!(home.rows().len(), 4);
}

#[test]
fn parts_that_know_nothing_of_each_other_make_the_same_table() {
    let (whole, parts) = (Home::new(), Home::new());
    // The path of the map is no part of what a run depends on.
    let sweep = whole.begin(PLAN).expect("a plan");
    do_all(&sweep);
    let table = |it: &Sweep| fs::read(it.finish().expect("it is written").expect("all are done").runs);
    for part in ["1/3", "2/3", "3/3"] {
        let sweep = parts.begin(PLAN).expect("a plan");
        let mut worker = Worker::of(Arc::clone(&sweep));
        let keys = sweep.open_keys(part.parse().expect("a part")).expect("the folder is there");
        keys.iter().for_each(|it| worker.run(it).expect("it runs"));
    }
    assert_eq!(table(&parts.begin(PLAN).expect("a plan")).ok(), table(&sweep).ok());
}

#[test]
fn what_is_in_the_folder_already_is_not_mixed_with_another_plan() {
    let home = Home::new();
    home.begin(PLAN).expect("a plan");
    let fault = home.begin(&PLAN.replace("1500", "1600")).err().expect("another plan");
    assert!(fault.to_string().contains("out: this folder has the sweep of another plan, "), "{fault}");
    let road = home.0.join("road.osm");
    let map = fs::read_to_string(&road).expect("a map");
    fs::write(&road, map + "\n").expect("it is written");
    let fault = home.begin(PLAN).err().expect("another map");
    assert!(fault.what.ends_with("road.osm has changed since this sweep was begun"), "{fault}");
    // A program that begins a run then has not seen the map before.
    let sweep = Arc::new(Sweep::begun(&home.out()).expect("it was begun"));
    let fault = Worker::of(Arc::clone(&sweep)).run(&open(&sweep)[0]).expect_err("another map");
    assert!(fault.what.starts_with("the map ") && fault.what.contains("has changed"), "{fault}");
    assert!(home.rows().is_empty());
}

#[test]
fn nothing_is_begun_if_one_variant_cannot_run() {
    let of_grid = |it: &str| format!("scenario = \"road.osm\"\n[grid]\n{it}\n");
    let cases = [
        (of_grid("demand.trucks = [0, 2]"), "plan.toml:3:8: a share of trucks of 2; choose 0 to 1"),
        (
            of_grid("demand.truks = [0]"),
            "plan.toml:3:8: unknown key \"truks\" in demand; did you mean \"trucks\"?",
        ),
        (
            of_grid("model = [\"mobbil\"]"),
            "plan.toml:3:1: model: unknown value \"mobbil\"; did you mean \"mobil\"?",
        ),
        (
            of_grid("model = [\"mcdm\", \"mcdm\"]"),
            "plan.toml:3:1: the variants model=mcdm and model=mcdm are the same; leave one of them out",
        ),
        (
            of_grid("styles.egoist = [1]"),
            "plan.toml:3:8: unknown style \"egoist\"; did you mean \"egoistic\"? (or give the path of a style file, FILE.toml)",
        ),
        (
            of_grid("obstacle.0.length_m = [5, 10]"),
            "plan.toml:3:12: the scenario has no obstacle; write obstacle in the scenario, and change it here",
        ),
        (
            "map = \"road.osm\"".to_owned(),
            "this is a scenario, but the plan of a sweep is expected; write a plan with scenario = ",
        ),
        ("seeds = 2".to_owned(), "plan.toml:1:1: the key \"scenario\" is missing; add it"),
    ];
    for (plan, expected) in cases {
        let home = Home::new();
        let fault = home.begin(&plan).err().expect(expected).to_string();
        assert!(fault.contains(expected), "{fault}");
        assert!(!home.out().exists());
    }
    for (plan, expected) in [
        ("scenario = \"nothing.osm\"\nseeds = 2", "plan.toml:1:1: "),
        ("scenario = \"nothing.toml\"\nseeds = 2", "plan.toml:1:1: "),
        ("scenario = \"road.osm\"\n[grid]\nmap = [\"road.osm\", \"nothing.osm\"]", "plan.toml:3:1: "),
    ] {
        let home = Home::new();
        let fault = home.begin(plan).err().expect(expected);
        let text = fault.to_string();
        assert!(text.contains(expected) && text.contains("nothing."), "{text}");
        assert_eq!(fault.kind, FaultKind::NotFound);
    }
    let home = Home::new();
    fs::remove_file(home.0.join("road.osm")).expect("it is there");
    let fault = home.begin(PLAN).err().expect("no map");
    assert!(
        fault.to_string().ends_with("road.osm: cannot be read: no such file or directory; check the path"),
        "{fault}"
    );
}

#[test]
fn a_style_file_is_found_from_the_plan_on() {
    let home = Home::new();
    let style = laneweave::style::built_in("egoistic").expect("a style").text.replace("egoistic", "mine");
    fs::write(home.0.join("mine.toml"), style).expect("it is written");
    let plan = "scenario = \"road.osm\"\n[[list]]\nrun.duration_s = 1\nstyles = { \"mine.toml\" = 1 }\n[[list]]\nrun.duration_s = 1\n";
    let sweep = home.begin(plan).expect("a plan");
    do_all(&sweep);
    assert!(sweep.finish().expect("it is written").is_ok());
}
