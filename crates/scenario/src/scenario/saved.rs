//! A prepared scenario that runs: its steps, and its state as bytes.

use laneweave_sim::CheckpointError;
use xxhash_rust::xxh3::xxh3_64;

use super::Prepared;
use crate::script::State;

/// Length of the hash at the end [bytes].
const HASH: usize = 8;

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
        let mut bytes = postcard::to_allocvec(&saved).map_err(unreadable)?;
        bytes.extend(xxh3_64(&bytes).to_le_bytes());
        Ok(bytes)
    }

    /// Restores the saved state of the same scenario.
    ///
    /// # Errors
    /// If the bytes are not such a state. Nothing changes then.
    pub fn restore(&mut self, saved: &[u8]) -> Result<(), CheckpointError> {
        let whole = saved.split_last_chunk::<HASH>();
        let whole = whole.filter(|(body, hash)| xxh3_64(body).to_le_bytes() == **hash);
        let (body, _) = whole.ok_or_else(|| CheckpointError::Unreadable("it is damaged".into()))?;
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
