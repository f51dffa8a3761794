//! Questions about a world. They change nothing.

pub(crate) mod account;
pub(crate) mod queues;
pub(crate) mod standing;
