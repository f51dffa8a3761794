//! A prepared scenario that runs: its steps, and its state as bytes.

use laneweave_sim::{CheckpointError, Setup, World, sealed, unsealed};

use super::prepare::{driving, equipped, unbuilt};
use super::{Origin, Prepared, Scenario};
use crate::fault::Fault;
use crate::script::State;
use crate::style::{Population, StyleTemplate};

impl Prepared {
    /// Gives the commands of the scenario that are due, and simulates a step.
    pub fn step(&mut self) {
        self.script.step(&mut self.world);
    }

    /// The same scenario at its start with another `seed`. The map, the styles and a recording are not read again.
    ///
    /// # Errors
    /// If a distribution of a style gives an invalid value with this seed. Nothing changes then.
    pub fn restart(&mut self, scenario: &Scenario, origin: &Origin, seed: u64) -> Result<(), Fault> {
        let drivers_seed = scenario.run.drivers_seed.unwrap_or(seed);
        let driver_parameters = Population::draw(&self.conditions.mixture, drivers_seed)?.driver_parameters;
        let setup = Setup { step: scenario.run.step_s, seed, threads: self.threads };
        let (network, demand) = (self.world.shared_network(), self.world.demand().clone());
        let world = World::new(network, driving(scenario, driver_parameters), demand, setup)
            .map_err(|error| unbuilt(scenario, origin, &error))?;
        self.world = equipped(world, self.conditions.warmup_steps, scenario, origin)?;
        self.script = self.script.restarted(seed);
        Ok(())
    }

    /// Draws the drivers anew from `mixture`, with the random numbers of `seed`, with which they were drawn before:
    /// each keeps its place, and goes on with what it is doing.
    ///
    /// # Errors
    /// If `mixture` has not the styles of the scenario, or a distribution gives an invalid value.
    pub fn redraw_drivers(
        &mut self,
        scenario: &Scenario,
        mixture: &[(StyleTemplate, f64)],
        seed: u64,
    ) -> Result<(), Fault> {
        let drivers = Population::draw(&self.conditions.mixture, seed)?.redrawn(mixture, seed)?;
        let changed = self.world.change_driver_parameters(driving(scenario, drivers));
        changed
            .map_err(|error| Fault::new("styles", error, "give the styles of the scenario, in their order"))
    }

    /// Becomes what `base` is now, with its commands.
    ///
    /// # Errors
    /// If both are not of one scenario. Nothing changes then.
    pub fn take_state_of(&mut self, base: &Prepared) -> Result<(), CheckpointError> {
        self.world.restore(&base.world.save()?)?;
        self.script = base.script.clone();
        Ok(())
    }

    /// Saves all that changes, as it is after the last step.
    ///
    /// # Errors
    /// None, as long as there is memory.
    pub fn save(&self) -> Result<Vec<u8>, CheckpointError> {
        let saved = (self.world.save()?, &self.script.state);
        postcard::to_allocvec(&saved).map(sealed).map_err(unreadable)
    }

    /// Restores the saved state of the same scenario.
    ///
    /// # Errors
    /// If the bytes are not such a state. Nothing changes then.
    pub fn restore(&mut self, saved: &[u8]) -> Result<(), CheckpointError> {
        let body = unsealed(saved)?;
        let (world, state): (Vec<u8>, State) = postcard::from_bytes(body).map_err(unreadable)?;
        if !state.fits(&self.script.state) {
            return Err(CheckpointError::Other("external vehicles or obstacles"));
        }
        self.world.restore(&world)?;
        self.script.state = state;
        Ok(())
    }
}

fn unreadable(error: postcard::Error) -> CheckpointError {
    CheckpointError::Unreadable(error.to_string())
}
