//! The state of outputs, as bytes in a checkpoint.

use laneweave_scenario::Fault;
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::folder::CHECKPOINT;

/// The state as bytes.
pub(crate) fn pack(kept: &impl Serialize) -> Result<Vec<u8>, Fault> {
    postcard::to_allocvec(kept).map_err(|error| Fault::bug(CHECKPOINT, error))
}

/// The state from bytes.
pub(crate) fn unpack<T: DeserializeOwned>(bytes: &[u8]) -> Result<T, Fault> {
    postcard::from_bytes(bytes).map_err(|error| {
        Fault::new(
            CHECKPOINT,
            format!("not a checkpoint of this version: {error}"),
            "run again from the beginning, without --resume",
        )
    })
}
