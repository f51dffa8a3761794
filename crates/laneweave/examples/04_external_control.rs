//! Put a vehicle of your own into the traffic, and drive it.
#![expect(clippy::print_stdout, reason = "an example prints")]

use laneweave::{Class, Control, Event, Fault, Lateral, Longitudinal, NewVehicle, Side, Simulation};

/// A slow car on a motorway, which changes to the left lane: the traffic behind it queues.
pub fn main() -> Result<(), Fault> {
    let mut simulation =
        Simulation::builder("maps/motorway_2_lanes.osm").vehicles_per_hour(3000.0).build()?;
    let ego = simulation.insert(NewVehicle {
        lanelet: 5.into(),
        position_m: 50.0,
        speed_mps: 25.0,
        class: Class::Car,
        style: "conservative".into(),
        destination: Some(49.into()),
    })?;
    let (longitudinal, lateral) = (Longitudinal::Speed(20.0), Lateral::Change(Side::Left));
    simulation.control(ego, Control::Drive { longitudinal, lateral })?;

    let mut changes = Vec::new();
    while simulation.time_s() < 90.0 {
        for event in simulation.step() {
            if let Event::LaneChange(it) = event
                && it.vehicle == ego
            {
                println!(
                    "at {:.1} s it has changed from lanelet {} to {}",
                    it.time_s, it.from_lanelet, it.to_lanelet
                );
                changes.push(it);
            }
        }
    }
    let state =
        simulation.vehicle(ego).ok_or_else(|| Fault::new("ego", "it has left", "choose a longer map"))?;
    let behind =
        simulation.vehicles_on(state.lanelet)?.iter().filter(|it| it.position_m < state.position_m).count();
    println!(
        "it drives at {} m/s on lanelet {}, with {behind} vehicles behind it there",
        state.speed_mps, state.lanelet
    );

    assert!(changes.len() == 1 && changes[0].side == Side::Left && changes[0].is_completed);
    assert!(state.is_external && (state.speed_mps - 20.0).abs() < 1e-9 && behind > 0);

    // Its own driver drives it again, as fast as it likes.
    simulation.control(ego, Control::DRIVER)?;
    simulation.run(120.0)?;
    assert!(simulation.vehicle(ego).is_none_or(|it| !it.is_external && it.speed_mps > 20.0));
    Ok(())
}
