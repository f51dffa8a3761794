//! Saved states end with a hash, so that damage is found.

use xxhash_rust::xxh3::xxh3_64;

use crate::step::checkpoint::CheckpointError;

/// Length of the hash at the end [bytes].
const HASH: usize = 8;

/// The `bytes` of a state with their hash.
pub fn sealed(mut bytes: Vec<u8>) -> Vec<u8> {
    bytes.extend(xxh3_64(&bytes).to_le_bytes());
    bytes
}

/// The bytes of a `sealed` state without their hash.
///
/// # Errors
/// If they are damaged.
pub fn unsealed(sealed: &[u8]) -> Result<&[u8], CheckpointError> {
    let whole = sealed.split_last_chunk::<HASH>();
    let whole = whole.filter(|(body, hash)| xxh3_64(body).to_le_bytes() == **hash);
    whole.map(|it| it.0).ok_or_else(|| CheckpointError::Unreadable("it is damaged".into()))
}
