//! Vehicles that touch each other are reported with their time and place: in the table `incidents`, and the first in
//! the summary.

use std::fs;
use std::path::PathBuf;
use std::sync::atomic::{AtomicU32, Ordering};

use laneweave::Simulation;
use laneweave::checkpoint;
use laneweave::output::Summary;
use laneweave::run::{self, Resumed};
use laneweave_scenario::scenario::{Origin, Scenario, TableFormat};
use laneweave_sim::{Class, Placement};

/// A run of half a minute on two lanes, with only the vehicles that the test places there; in a temporary folder.
struct Run {
    scenario: Scenario,
}

impl Run {
    fn new() -> Run {
        static NUMBER: AtomicU32 = AtomicU32::new(0);
        let number = NUMBER.fetch_add(1, Ordering::Relaxed);
        let dir = std::env::temp_dir().join(format!("laneweave-incidents-{}-{number}", std::process::id()));
        fs::create_dir_all(&dir).expect("a folder");
        let map = laneweave_test_data::map("motorway_2_lanes.osm");
        let mut scenario = Scenario::of_map(map);
        scenario.demand.vehicles_per_hour = Some(0.0);
        scenario.run.duration_s = 30.0;
        scenario.output.dir = dir.clone();
        scenario.output.format = TableFormat::Csv;
        scenario.output.record_s = 0.0;
        scenario.output.checkpoint_s = 10.0;
        Run { scenario }
    }

    /// Two cars, the second with its front 2 m within the first; and a third far ahead.
    fn simulation(&self) -> Simulation {
        let simulation = Simulation::from_scenario(&self.scenario, &Origin::default());
        let mut simulation = simulation.expect("the map is sound");
        let chain = simulation.network().entrances[0].chains[0];
        for x in [102.5, 100.0, 500.0] {
            simulation
                .place(Placement {
                    chain,
                    x,
                    speed: 20.0,
                    class: Class::Car,
                    parameters: 0,
                    destination: None,
                })
                .expect("it fits on the road");
        }
        simulation
    }

    /// Continues from the last checkpoint, if there is one, up to `end` [s]; if that is before its end, the run is
    /// interrupted.
    fn until(&self, end: f64) -> Option<(Summary, Vec<PathBuf>)> {
        let (scenario, origin) = (&self.scenario, Origin::default());
        let run = if scenario.output.dir.join(checkpoint::FILE).exists() {
            match run::resume(scenario, &origin).expect("it is whole") {
                Resumed::Run(run) => *run,
                Resumed::Complete(summary) => panic!("it has ended: {summary}"),
            }
        } else {
            run::Run::of(self.simulation(), "a test").expect("the folder is there")
        };
        let done = run.complete(|it| it.time_s() < end).expect("it can be written");
        (!done.summary.interrupted).then_some((done.summary, done.files))
    }

    fn report(&self) -> String {
        let dir = &self.scenario.output.dir;
        let text = fs::read_to_string(dir.join("report.html")).expect("the report is there");
        // The name of the folder is all in which two runs may differ.
        text.replace(&dir.display().to_string(), "out")
    }

    fn table(&self) -> String {
        fs::read_to_string(self.scenario.output.dir.join("incidents.csv")).expect("the table is there")
    }
}

impl Drop for Run {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.scenario.output.dir);
    }
}

#[test]
fn the_table_of_incidents_has_a_row_for_each_with_both_vehicles_and_the_place() {
    let run = Run::new();
    let (summary, files) = run.until(f64::INFINITY).expect("it ends");
    assert!(files.iter().any(|it| it.ends_with("incidents.csv")), "{files:?}");
    assert_eq!((summary.collisions, summary.overlaps), (1, 0));
    let table = run.table();
    let lines: Vec<&str> = table.lines().collect();
    let [head, row] = lines[..] else { panic!("{table}") };
    assert_eq!(
        head,
        "time_s,kind,vehicle,other_vehicle,class,other_class,style,other_style,lanelet,other_lanelet,position_m,\
         other_position_m,x_m,y_m,speed_mps,other_speed_mps,depth_m"
    );
    let cells: Vec<&str> = row.split(',').collect();
    assert_eq!(cells[..6], ["0.0", "collision", "0", "1", "car", "car"]);
    assert_eq!(cells[6], cells[7]);
    assert_eq!(cells[8], cells[9]);
    assert_eq!(cells[10..12], ["102.5", "100.0"]);
    assert_eq!(cells[14..16], ["20.0", "20.0"]);
    let number = |it: usize| cells[it].parse::<f64>().expect("a number");
    // Cars are 4.5 m long, and 1.8 m wide: less than the 2 m along the road.
    assert!((number(16) - 1.8).abs() < 1e-6, "{row}");
}

#[test]
fn incidents_before_a_checkpoint_are_in_the_table_of_a_run_that_was_resumed() {
    let (undisturbed, broken_off) = (Run::new(), Run::new());
    let (expected, _) = undisturbed.until(f64::INFINITY).expect("it ends");
    assert!(broken_off.until(15.0).is_none());
    let (summary, _) = broken_off.until(f64::INFINITY).expect("it ends");
    assert_eq!(summary.state_hash, expected.state_hash);
    assert_eq!(summary.first_incident, expected.first_incident);
    assert_eq!(broken_off.table(), undisturbed.table());
    assert_eq!(broken_off.report(), undisturbed.report());
    assert_eq!(undisturbed.table().lines().count(), 2);
}

#[test]
fn where_nobody_touches_anybody_the_table_has_its_head_alone() {
    let mut run = Run::new();
    run.scenario.run.warmup_s = 10.0;
    let (summary, _) = run.until(f64::INFINITY).expect("it ends");
    // Events of the warm-up do not count.
    assert_eq!((summary.incidents, summary.first_incident), (0, None));
    assert_eq!(run.table().lines().count(), 1);
    let text = summary.to_text(&[], &[]);
    assert!(!run.report().contains("Incidents: "));
    assert!(text.contains("0 missed turns, 0 lost\n") && !text.contains("first incident"), "{text}");
}

#[test]
fn the_summary_names_the_first_incident_with_its_place() {
    let run = Run::new();
    let (summary, _) = run.until(f64::INFINITY).expect("it ends");
    assert_eq!(summary.incidents, 1);
    let first = summary.first_incident.expect("there is one");
    assert_eq!((first.time_s, first.kind, first.vehicles), (0.0, "collision", [0, 1]));
    let lanelet = run.table().lines().nth(1).and_then(|it| it.split(',').nth(8).map(String::from));
    assert_eq!(Some(first.lanelet.to_string()), lanelet);
    let told =
        format!("  first incident   collision at 0 s on lanelet {}, vehicles 0 and 1\n", first.lanelet);
    assert!(summary.to_text(&[], &[]).contains(&told));
}

#[test]
fn the_report_names_the_first_place_and_lists_the_first_incidents() {
    let run = Run::new();
    let (summary, _) = run.until(f64::INFINITY).expect("it ends");
    let (first, report) = (summary.first_incident.expect("there is one"), run.report());
    let told =
        format!("first {}; the table incidents lists all of them; this should not happen", first.to_text());
    assert!(report.contains(&told), "{told}");
    assert!(report.contains("Incidents: the first 1 of 1, as in the table incidents."));
    let lanelets = format!("<td data-name=\"lanelets\">{0} and {0}</td>", first.lanelet);
    assert!(report.contains(&lanelets), "{lanelets}");
    for cell in ["\"vehicles\">0 and 1<", "\"speeds [km/h]\">72.0 and 72.0<", "class=\"number\">1.80<"] {
        assert!(report.contains(cell), "{cell}");
    }
}

#[test]
fn the_report_has_a_map_with_the_place_of_each_collision() {
    let run = Run::new();
    run.until(f64::INFINITY).expect("it ends");
    let (report, table) = (run.report(), run.table());
    assert!(
        report.contains("Collisions and overlaps on the map") && report.contains(">collision (1)</text>")
    );
    let cells: Vec<&str> = table.lines().nth(1).expect("a row").split(',').collect();
    let [x, y] = [12, 13].map(|it| cells[it].parse::<f64>().expect("a number"));
    let row = format!("%0Acollision,{},{x:.1},{y:.1},time%20%5Bs%5D,0%0A", cells[8]);
    assert!(report.contains(&row), "{row}");
}
