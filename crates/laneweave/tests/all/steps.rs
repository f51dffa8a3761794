//! Longer steps change traffic little: delays and rates of lane changes at the default demand.

use laneweave::Simulation;
use laneweave::run::Run;
use laneweave_scenario::scenario::{Origin, Scenario};
use laneweave_test_data::{map, size};

/// Mean delay of a trip [s], and lane changes per vehicle and kilometre, over a few seeds.
fn traffic(name: &str, step_s: f64) -> [f64; 2] {
    let seeds = size().pick(3, 8);
    let of_seed = |seed: u64| {
        let mut scenario = Scenario::of_map(map(name));
        scenario.run.seed = seed;
        scenario.run.step_s = step_s;
        (scenario.run.warmup_s, scenario.run.duration_s) = (300.0, 1200.0);
        scenario.output.record_s = 0.0;
        let dir = std::env::temp_dir().join(format!("laneweave-steps-{}-{name}", std::process::id()));
        scenario.output.dir = dir.clone();
        let simulation = Simulation::from_scenario(&scenario, &Origin::default()).expect("it can be done");
        assert_eq!(simulation.step_warning(), None);
        let run = Run::of(simulation, "a test").expect("it can be done");
        let summary = run.complete(|_| true).expect("it can be done").summary;
        std::fs::remove_dir_all(&dir).expect("it can be done");
        [summary.mean_delay_s, summary.lane_changes_per_veh_km].map(|it| it.expect("vehicles drove"))
    };
    let all: Vec<[f64; 2]> = (1..=seeds).map(of_seed).collect();
    [0, 1].map(|number| all.iter().map(|it| it[number]).sum::<f64>() / all.len() as f64)
}

#[test]
fn steps_of_half_a_second_change_delays_and_rates_by_at_most_15_per_cent() {
    let few = ["motorway_3_lanes.osm", "priority.osm", "grid.osm"];
    let more = ["ramps.osm", "weaving.osm", "right_before_left.osm", "town.osm"];
    let names = few.iter().chain(size().pick(&[][..], &more));
    for name in names {
        let ([delay, rate], [coarse_delay, coarse_rate]) = (traffic(name, 0.1), traffic(name, 0.5));
        eprintln!("{name}: {delay:.1} and {coarse_delay:.1} s, {rate:.3} and {coarse_rate:.3}");
        assert!((coarse_delay / delay - 1.0).abs() < 0.15, "{name}: {delay} and {coarse_delay} s");
        assert!((coarse_rate - rate).abs() <= 0.15 * rate, "{name}: {rate} and {coarse_rate}");
    }
}

#[test]
fn who_waits_at_a_stop_is_looked_at_when_others_are_given_their_turn_however_long_the_steps() {
    // Half a step more before each driver would add 40 % to the delays.
    let [[delay, _], [coarse, _]] = [0.1, 0.5].map(|it| traffic("all_way_stop.osm", it));
    assert!((coarse / delay - 1.0).abs() < 0.25, "{delay} and {coarse} s");
}
