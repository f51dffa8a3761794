//! Observe a simulation, and count what happens in it.
#![expect(clippy::print_stdout, reason = "an example prints")]

use laneweave::{Event, Fault, LaneChangeKind, Observer, Simulation};

/// What is counted.
#[derive(Default)]
struct Counts {
    entered: usize,
    completed: usize,
    /// Completed lane changes: discretionary, and route-driven.
    lane_changes: [usize; 2],
    /// Sum of the times on the map of the completed trips [s].
    trip_time_s: f64,
}

impl Observer for Counts {
    fn observe(&mut self, _simulation: &Simulation, events: &[Event]) -> Result<(), Fault> {
        for event in events {
            match event {
                Event::Entered(_) => self.entered += 1,
                Event::Completed { duration_s, .. } => {
                    self.completed += 1;
                    self.trip_time_s += duration_s;
                }
                Event::LaneChange(it) if it.is_completed => {
                    self.lane_changes[usize::from(it.kind == LaneChangeKind::Route)] += 1;
                }
                _ => {}
            }
        }
        Ok(())
    }
}

/// Ten minutes of the demo. A closure is an observer, too.
pub fn main() -> Result<(), Fault> {
    let mut simulation = Simulation::from_file("scenarios/demo.toml")?;
    let (mut counts, mut most) = (Counts::default(), 0);
    let mut watch = |it: &Simulation, _: &[Event]| {
        most = most.max(it.on_road());
        Ok::<(), Fault>(())
    };
    simulation.observe(600.0, &mut [&mut counts, &mut watch])?;

    let Counts { entered, completed, lane_changes: [discretionary, route_driven], trip_time_s } = counts;
    println!("{entered} vehicles entered, {completed} completed their trip, at most {most} were on the road");
    println!("a trip took {:.0} s on average", trip_time_s / completed as f64);
    println!("lane changes: {discretionary} discretionary, {route_driven} route-driven");

    assert_eq!(entered, completed + simulation.vehicles().len());
    assert!(completed > 100 && discretionary > 100 && route_driven > 10);
    Ok(())
}
