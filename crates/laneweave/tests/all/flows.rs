//! The table `flows` agrees with the distances that vehicles drove.

use std::collections::HashMap;

use laneweave::Simulation;
use laneweave::run::Run;
use laneweave_scenario::scenario::{Origin, Scenario, TableFormat};

/// Time of all vehicles on the lanelets [s], and their distance there [m], from the rows of the table; the same from
/// the summary; and the number of completed trips.
fn totals(map: &str, demand: f64, every: u32) -> ([f64; 2], [f64; 2], f64) {
    let path = laneweave_test_data::map(map);
    let mut scenario = Scenario::of_map(path);
    scenario.demand.vehicles_per_hour = Some(demand);
    (scenario.run.warmup_s, scenario.run.duration_s) = (60.0, 200.0);
    let dir = std::env::temp_dir().join(format!("laneweave-flows-{}-{map}", std::process::id()));
    scenario.output.dir = dir.clone();
    scenario.output.format = TableFormat::Csv;
    (scenario.output.record_s, scenario.output.flows_s) = (0.0, f64::from(every) * 0.1);
    let simulation = Simulation::from_scenario(&scenario, &Origin::default()).expect("it can be done");
    let lengths: HashMap<String, f64> =
        simulation.network().lanelets.iter().map(|it| (it.id.to_string(), it.length())).collect();
    let run = Run::of(simulation, "a test").expect("it can be done");
    let summary = run.complete(|_| true).expect("it can be done").summary;
    let table = std::fs::read_to_string(dir.join("flows.csv")).expect("it can be done");
    std::fs::remove_dir_all(&dir).expect("it can be done");
    let mut lines = table.lines();
    assert_eq!(lines.next(), Some("from_s,to_s,lanelet,flow_veh_h,density_veh_km,speed_mps"));
    let (mut sums, mut rows, mut until) = ([0.0; 2], 0, 60.0);
    for line in lines {
        let cells: Vec<&str> = line.split(',').collect();
        let number = |place: usize| cells[place].parse::<f64>().expect("it can be done");
        let size = lengths[cells[2]] * (number(1) - number(0));
        let [time, distance] = [size * number(4) / 1000.0, size * number(3) / 3600.0];
        match cells[5] {
            "" => assert_eq!([time, distance], [0.0, 0.0]),
            speed => assert!((speed.parse::<f64>().expect("it can be done") * time - distance).abs() < 1e-6),
        }
        sums = [sums[0] + time, sums[1] + distance];
        until = number(1);
        rows += 1;
    }
    assert_eq!(until, 260.0);
    assert_eq!(rows, lengths.len() * 2000_usize.div_ceil(every as usize));
    (sums, [summary.updates as f64 * 0.1, 1000.0 * summary.veh_km], summary.completed as f64)
}

#[test]
fn times_and_ways_add_up_to_what_was_driven() {
    // If intervals are 30 s long, the last one is shorter.
    for (map, demand, every) in [("ramps.osm", 4000.0, 300), ("grid.osm", 4000.0, 600)] {
        let (table, counted, left) = totals(map, demand, every);
        // Vehicles that left ended their last step beyond the road; a stop within a step causes an error of a few
        // centimetres.
        let missing = [counted[0] - table[0], counted[1] - table[1]];
        assert!(left > 50.0 && (0.0..0.1 * left).contains(&missing[0]), "{map}: {missing:?} of {counted:?}");
        assert!((0.0..4.0 * left).contains(&missing[1]), "{map}: {missing:?} of {counted:?}, {left} left");
    }
}
