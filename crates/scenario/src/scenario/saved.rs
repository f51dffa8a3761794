//! A prepared scenario that runs: its steps, and its state as bytes.

use laneweave_sim::{CheckpointError, sealed, unsealed};

use super::Prepared;
use crate::script::State;

impl Prepared {
    /// Gives the commands of the scenario that are due, and simulates a step.
    pub fn step(&mut self) {
        self.script.step(&mut self.world);
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
            return Err(CheckpointError::Other("external vehicles"));
        }
        self.world.restore(&world)?;
        self.script.state = state;
        Ok(())
    }
}

fn unreadable(error: postcard::Error) -> CheckpointError {
    CheckpointError::Unreadable(error.to_string())
}
