//! A simulation at its start again.

use laneweave_scenario::Fault;

use super::Simulation;

impl Simulation {
    /// Begins anew with another seed of all random numbers. The map, the styles and a recording are not read again, so
    /// this takes much less time than a new simulation, and comes to the same traffic. It takes least where a
    /// [`Template`](super::Template) has spawned the simulation: the drivers are then not drawn again, either.
    ///
    /// # Errors
    /// If drivers are drawn, and a distribution of a style gives an invalid value with this seed. Nothing changes then.
    ///
    /// ```no_run
    /// # fn main() -> Result<(), laneweave::Fault> {
    /// let mut simulation = laneweave::Simulation::from_file("scenarios/demo.toml")?;
    /// for seed in 1..=10 {
    ///     simulation.reset(seed)?;
    ///     simulation.run(600.0)?;
    /// }
    /// # Ok(())
    /// # }
    /// ```
    pub fn reset(&mut self, seed: u64) -> Result<(), Fault> {
        let has_begun = match &self.template {
            Some(template) => template.reset(&mut self.prepared, seed),
            None => {
                self.prepared.restart(&self.scenario, &self.origin, seed)?;
                false
            }
        };
        self.scenario.run.seed = seed;
        (self.is_commanded, self.is_changed) = (has_begun, has_begun);
        Ok(())
    }
}
