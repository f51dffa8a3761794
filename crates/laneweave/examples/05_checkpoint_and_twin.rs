//! Save a simulation, and continue it twice: once unchanged, once with one thing changed.
#![expect(clippy::print_stdout, reason = "an example prints")]

use laneweave::{Fault, LightState, Simulation};

/// A town whose lights all show red for a minute, and its twin, in which they do not. All random numbers of the two
/// are the same, so the lights cause every difference.
pub fn main() -> Result<(), Fault> {
    let town = || Simulation::builder("maps/grid.osm").vehicles_per_hour(4000.0).seed(7).build();
    let mut simulation = town()?;
    simulation.run(300.0)?;
    let saved = simulation.save()?;

    let mut twin = town()?;
    twin.restore(&saved)?;
    assert_eq!(twin.state_hash(), simulation.state_hash());
    for light in twin.lights() {
        twin.set_light(light.id, Some(LightState::Red))?;
    }

    for it in [&mut simulation, &mut twin] {
        it.run(360.0)?;
    }
    let standing = |it: &Simulation| it.vehicles().iter().filter(|it| it.speed_mps < 0.1).count();
    let [usual, red] = [&simulation, &twin].map(standing);
    println!("a minute later {usual} vehicles stand; with all lights at red {red}");
    assert!(red > usual);

    // An unchanged twin stays the same to the last bit.
    let mut unchanged = town()?;
    unchanged.restore(&saved)?;
    unchanged.run(360.0)?;
    assert_eq!(unchanged.state_hash(), simulation.state_hash());
    assert_ne!(twin.state_hash(), simulation.state_hash());
    Ok(())
}
