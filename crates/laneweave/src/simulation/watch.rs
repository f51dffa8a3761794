//! What watches the traffic of a simulation: after every step it is shown what happened.

use laneweave_recorded::Watch;
use laneweave_results::output::{Boxes, ShortTrips, Traces};
use laneweave_sim::World;

use super::Simulation;

/// Something that watches the traffic, step by step.
pub trait Watcher {
    /// Sees the traffic after a step.
    #[doc(hidden)]
    fn see(&mut self, world: &World);
}

impl Watcher for Boxes {
    fn see(&mut self, world: &World) {
        self.observe(world);
    }
}

impl Watcher for ShortTrips {
    fn see(&mut self, world: &World) {
        self.observe(world);
    }
}

impl Watcher for Traces {
    fn see(&mut self, world: &World) {
        self.observe(world);
    }
}

impl Watcher for Watch {
    fn see(&mut self, world: &World) {
        Watch::see(self, world);
    }
}

impl Simulation {
    /// Shows the traffic after a step to `watcher`.
    pub fn show(&self, watcher: &mut impl Watcher) {
        watcher.see(self.world());
    }

    /// Densities, flows and lane changes, by Edie's definitions, over the measured time of the run.
    pub fn boxes(&self) -> Boxes {
        let [begin, duration] = self.run_steps().map(|it| f64::from(it) * self.step_s());
        Boxes::new(self.world(), begin, duration)
    }

    /// The vehicles over time on up to `number` slow lanes without a common part, those with the largest expected
    /// distance driven first, from now on for `duration` [s].
    pub fn traces(&self, number: usize, duration: f64) -> Vec<Traces> {
        Traces::most_driven(number, self.world(), &self.prepared.conditions.origins, self.time_s(), duration)
    }

    /// The positions of all vehicles, as a drone sees them from now on.
    pub fn drone_watch(&self) -> Watch {
        Watch::from_now(self.world())
    }
}
