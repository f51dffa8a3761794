//! Run a scenario, write all its result files, and print a result.
#![expect(clippy::print_stdout, reason = "an example prints")]

use laneweave::{Fault, Simulation};

/// Ten minutes on a motorway with ramps.
pub fn main() -> Result<(), Fault> {
    let simulation = Simulation::builder("maps/ramps.osm")
        .vehicles_per_hour(4000.0)
        .style("aggressive", 1.0)
        .style("conservative", 3.0)
        .build()?;
    let out = std::env::temp_dir().join(format!("laneweave-example-{}", std::process::id()));
    let summary = simulation.run_to_results(&out)?;
    println!("{} vehicles changed lanes {} times", summary.entered, summary.lane_changes);
    println!("the report is {}", out.join("report.html").display());

    assert_eq!(summary.entered, summary.completed + summary.on_road);
    assert!(summary.lane_changes > 100 && summary.collisions == 0);
    assert!(out.join("summary.json").exists() && out.join("scenario.toml").exists());
    Ok(())
}
