//! Give commands during a run with all its result files, and repeat the run from them.
#![expect(clippy::print_stdout, reason = "an example prints")]

use laneweave::{Class, Control, Fault, Lateral, Longitudinal, NewVehicle, Simulation};

/// A motorway for two minutes.
fn builder() -> laneweave::Builder {
    Simulation::builder("maps/motorway_2_lanes.osm").vehicles_per_hour(2000.0).duration_s(120.0)
}

/// A truck breaks down after half a minute. The same happens again in a run without this program.
pub fn main() -> Result<(), Fault> {
    let out = std::env::temp_dir().join(format!("laneweave-commands-example-{}", std::process::id()));
    let mut broken_down = None;
    let summary = builder().build()?.run_to_results_with(out.join("first"), |it| -> Result<(), Fault> {
        if it.time_s() >= 30.0 && broken_down.is_none() {
            let (class, style) = (Class::Truck, "conservative".into());
            let truck = NewVehicle {
                lanelet: 5.into(),
                position_m: 60.0,
                speed_mps: 20.0,
                class,
                style,
                destination: None,
            };
            // Its place may not be free yet.
            if let Ok(id) = it.insert(truck) {
                let (longitudinal, lateral) = (Longitudinal::Speed(0.0), Lateral::Keep);
                it.control(id, Control::Drive { longitudinal, lateral })?;
                broken_down = Some(id);
            }
        }
        Ok(())
    })?;
    println!("with the truck the mean speed is {:.1} m/s", summary.mean_speed_mps.unwrap_or_default());

    let table = ["commands.parquet", "commands.csv"].map(|it| out.join("first").join(it));
    let table = table.into_iter().find(|it| it.exists());
    let again = builder().scenario(|it| it.commands = table).build()?;
    let repeated = again.run_to_results(out.join("again"))?;
    assert_eq!((summary.inserted, repeated.inserted), (1, 1));
    assert_eq!(repeated.state_hash, summary.state_hash);

    let undisturbed = builder().build()?.run_to_results(out.join("undisturbed"))?;
    assert!(undisturbed.mean_speed_mps > summary.mean_speed_mps);
    Ok(())
}
