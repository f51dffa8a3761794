//! Fit a style to a recording, and drive with it.
#![expect(clippy::print_stdout, reason = "an example prints")]

use std::fs::File;
use std::path::Path;

use laneweave::output::write_whole;
use laneweave::recordings::{Drone, interaction};
use laneweave::{Fault, Simulation};
use laneweave_studies::fit::Request;

const MAP: &str = "maps/motorway_2_lanes.osm";

/// A recording to read: traffic as a drone sees it, on one kilometre of a motorway.
fn record(path: &Path) -> Result<(), Fault> {
    let builder = Simulation::builder(MAP).vehicles_per_hour(2500.0).style("conservative", 1.0);
    let mut driven = builder.duration_s(240.0).build()?;
    driven.run(120.0)?;
    let mut watch = driven.drone_watch();
    while driven.time_s() < driven.end_s() {
        driven.advance();
        driven.show(&mut watch);
    }
    let drone = Drone { above: [1000.0, 0.0], view: 1000.0, noise: 0.1, ..Drone::exact(10.0) };
    let recording = drone.observe(&watch.into_recording());
    let refused = |error: std::io::Error| Fault::refused(path, "written", &error);
    interaction::write(&recording, &mut File::create(path).map_err(refused)?).map_err(refused)
}

/// Records, fits, and drives with what was found.
pub fn main() -> Result<(), Fault> {
    let file = |name: &str| {
        std::env::temp_dir().join(format!("laneweave-fit-example-{}-{name}", std::process::id()))
    };
    let (tracks, style) = (file("tracks.csv"), file("style.toml"));
    record(&tracks)?;

    // What the recording can tell, then the fit.
    let mut request = Request::new(vec![tracks.clone()]);
    request.map = Some(MAP.into());
    (request.draws, request.repetitions) = (10, 1);
    let observed = request.observe()?;
    println!("{}", observed.plan().to_text());
    let report = observed.fit()?;
    for weight in &report.weights {
        let [lower, upper] = weight.interval;
        println!("{}: {:.2}, {lower:.2} to {upper:.2}", weight.name, weight.estimate);
    }
    println!("it does not tell: {}", report.data.not_identified.join(", "));

    // The style drives.
    write_whole(&style, &report.styles[0].text)?;
    let builder = Simulation::builder(MAP).vehicles_per_hour(2500.0);
    let mut again = builder.style(style.display().to_string(), 1.0).duration_s(60.0).build()?;
    again.run(60.0)?;
    println!("{} drivers of the fitted style are on the road", again.on_road());

    assert!(report.data.events_used > 10 && again.on_road() > 20);
    assert!(report.data.not_identified.contains(&"route"));
    [tracks, style]
        .iter()
        .try_for_each(|it| std::fs::remove_file(it).map_err(|error| Fault::refused(it, "removed", &error)))
}
