//! The desired speeds that a fit finds in a recording of a part of a road.

use laneweave::Simulation;
use laneweave::models::Style;
use laneweave::scenario::Origin as Files;
use laneweave::sim::Navigator;
use laneweave_calibration::observe::{Options, Origin, observe};
use laneweave_recorded::Drone;
use laneweave_recordings::{Matched, clean};

use crate::replayed::set_up::of_style;

#[test]
fn who_follows_somebody_beyond_the_view_does_not_show_its_desired_speed() {
    // A kilometre of a motorway on which most drivers are held up: at the end of the view nobody is seen ahead of them.
    let scenario = of_style("motorway_2_lanes.osm", "conservative", 2500.0, 90.0);
    let mut simulation =
        Simulation::from_scenario(&scenario, &Files::default()).expect("the scenario is sound");
    (0..2000).for_each(|_| simulation.advance());
    let mut watch = simulation.drone_watch();
    for _ in 0..simulation.run_steps()[1] {
        simulation.advance();
        simulation.show(&mut watch);
    }
    let drone = Drone { above: [1000.0, 0.0], view: 1000.0, noise: 0.1, ..Drone::exact(10.0) };
    let recording = clean(drone.observe(&watch.into_recording())).0;
    let network = simulation.network();
    let matched = Matched::new(network, &recording);
    let style: Style = simulation.driver_parameters()[0].clone();
    let seen = observe(&matched, &Navigator::new(network), &Options::of(style), Origin::default());
    let seen = seen.expect("the style is sound");
    // Their factors are normal with mean 1 and deviation .08.
    let [mean, deviation] = seen.recordings[0].desired_logs;
    assert!(mean.abs() < 0.06, "{mean}");
    assert!((0.02..0.14).contains(&deviation), "{deviation}");
    let shown = seen.drivers.iter().filter(|it| it.desired.is_shown).count();
    assert!(shown > 0 && shown < seen.drivers.len(), "{shown} of {}", seen.drivers.len());
}
