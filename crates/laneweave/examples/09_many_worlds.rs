//! Step many simulations of one scenario together, and drive a vehicle in each, as programs that learn to drive do.
#![expect(clippy::print_stdout, reason = "an example prints")]

use laneweave::{Control, Fault, Fleet, Lateral, Longitudinal, SIGHT_COLUMNS, Simulation, VehicleId};

/// The others that an own vehicle sees.
const NEAREST: usize = 6;
/// Numbers for each vehicle.
const ROW: usize = SIGHT_COLUMNS.len();

/// Sixteen merges. In each a vehicle keeps 40 m behind the centre of whoever is ahead in its lane.
pub fn main() -> Result<(), Fault> {
    let template = Simulation::builder("maps/on_ramp.osm").vehicles_per_hour(2400.0).template()?;
    let mut fleet = Fleet::new(&template, 1..=16, 2)?;
    fleet.step(300);
    // The vehicle that entered last.
    let last = |it: &Simulation| it.vehicles().last().map_or(0, |it| it.id);
    let egos: Vec<VehicleId> = fleet.simulations().iter().map(last).collect();

    let mut sight = vec![0.0; fleet.len() * (1 + NEAREST) * ROW];
    for _ in 0..20 {
        fleet.sight(&egos, NEAREST, &mut sight)?;
        let mut controls = Vec::new();
        for (number, seen) in sight.chunks_exact((1 + NEAREST) * ROW).enumerate() {
            let (own, others) = seen.split_at(ROW);
            // What has left the road sees nothing, not even itself.
            if own[0] == 1.0 {
                let ahead = others.chunks_exact(ROW).filter(|it| it[1] > 0.0 && it[2].abs() < 1.5);
                let gap = ahead.map(|it| f64::from(it[1])).fold(1000.0, f64::min);
                let longitudinal = Longitudinal::Speed((20.0 + 0.2 * (gap - 40.0)).clamp(5.0, 25.0));
                controls.push((
                    number,
                    egos[number],
                    Control::Drive { longitudinal, lateral: Lateral::Keep },
                ));
            }
        }
        fleet.control(&controls)?;
        fleet.step(5);
    }
    let there = fleet.simulations().iter().zip(&egos).filter(|(it, ego)| it.view(**ego).is_some()).count();
    println!("after ten seconds {there} of {} own vehicles are on the road", fleet.len());
    assert!(there > 0);

    // An episode is over: its simulation begins anew with another seed, in microseconds.
    fleet.reset(0, 100)?;
    assert_eq!(fleet.simulations()[0].time_s(), 0.0);
    Ok(())
}
