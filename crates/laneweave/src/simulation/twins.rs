//! Twins: simulations of one scenario that were the same up to a time, and differ by what one of them was given then.

use std::path::Path;

use laneweave_scenario::style::StyleTemplate;
use laneweave_scenario::{Fault, FaultKind, Script};

use super::Simulation;

impl Simulation {
    /// Becomes what `base`, a simulation of the same scenario, is now.
    ///
    /// # Errors
    /// If both are not of one scenario. Nothing changes then.
    pub fn take_state_of(&mut self, base: &Simulation) -> Result<(), Fault> {
        self.is_changed = true;
        self.prepared.take_state_of(&base.prepared).map_err(|error| {
            Fault::new("twin", error, "choose a simulation of the same scenario").of_kind(FaultKind::State)
        })
    }

    /// Draws all drivers anew from these styles with their weights, with the random numbers with which they were drawn
    /// before. Each driver goes on with what it is doing. The styles are those of the scenario, in their order; only
    /// their numbers may differ.
    ///
    /// # Errors
    /// If they are not, or if a distribution gives an invalid value.
    pub fn change_styles(&mut self, styles: &[(StyleTemplate, f64)]) -> Result<(), Fault> {
        self.is_changed = true;
        self.prepared.redraw_drivers(&self.scenario, styles, self.scenario.run.seed_of_drivers())
    }

    /// The commands in a file, or none; checked at the start of this simulation.
    ///
    /// # Errors
    /// If the file cannot be read, or a command in it is not possible.
    pub fn read_commands(&self, file: Option<&Path>) -> Result<Script, Fault> {
        Script::of_file(file, self.world())
    }

    /// Follows other commands from now on, which were read before.
    pub fn follow_commands(&mut self, commands: &Script) {
        self.is_changed = true;
        self.prepared.script = commands.clone().after(&self.prepared.script);
    }
}
