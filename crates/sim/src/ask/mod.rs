//! Questions about a world, which change nothing.

pub(crate) mod account;
pub(crate) mod queues;
pub(crate) mod standing;
