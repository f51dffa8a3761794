//! Write a style of your own, and let its drivers share a motorway with others.
#![expect(clippy::print_stdout, reason = "an example prints")]

use laneweave::{Fault, Simulation};

/// Drivers who want to drive 15 % faster than the limit, and follow closely. A key that is not given has its default.
const HASTY: &str = r#"
name = "hasty"
description = "Fast drivers who follow closely"
speed_factor = 1.15

[follow]
model = "idm"
time_gap = 0.8        # [s]

[change]
model = "mcdm"
theta = 0.112         # θ = 8 σ
sigma = 0.014         # σ: choice noise

[change.speed]
weight = 2.0
"#;

/// Half of the drivers are hasty, half of them are conservative.
pub fn main() -> Result<(), Fault> {
    let file = std::env::temp_dir().join(format!("laneweave-hasty-{}.toml", std::process::id()));
    std::fs::write(&file, HASTY).map_err(|error| Fault::refused(&file, "written", &error))?;
    let mut simulation = Simulation::builder("maps/motorway_3_lanes.osm")
        .vehicles_per_hour(2500.0)
        .style(file.display().to_string(), 1.0)
        .style("conservative", 1.0)
        .build()?;
    simulation.run(600.0)?;

    let vehicles = simulation.vehicles();
    let mean_speed = |style: &str| {
        let speeds: Vec<f64> =
            vehicles.iter().filter(|it| it.style == style).map(|it| it.speed_mps).collect();
        speeds.iter().sum::<f64>() / speeds.len() as f64
    };
    let [hasty, conservative] = ["hasty", "conservative"].map(mean_speed);
    println!(
        "hasty drivers drive at {:.0} km/h, conservative ones at {:.0}",
        3.6 * hasty,
        3.6 * conservative
    );

    assert!(hasty > conservative + 2.0);
    Ok(())
}
